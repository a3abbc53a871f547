"""The houses behind the facades as a part of the place: roofs, sides and backs.

Their fronts are left out: the facades of the drive stand there.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from veduta.drive.build.bodies import Body
from veduta.place.features import feature_table
from veduta.place.material import Material
from veduta.place.mesh import Mesh
from veduta.place.semantics import Provenance, SemanticClass

HOUSES = "houses"
Floats = NDArray[np.float64]
_WALL = Material("walls behind the facade", (0.74, 0.72, 0.69))
_ROOF = Material("roof", (0.46, 0.36, 0.32))


def houses_mesh(bodies: Sequence[Body], middle: Floats) -> Mesh:
    """All bodies (one at least) about an origin `middle` (3,); a roof and walls of each have names."""
    corners: list[Floats] = []
    triangles: list[NDArray[np.int64]] = []
    feature: list[NDArray[np.int32]] = []
    rows: list[tuple[SemanticClass, Provenance, str]] = []
    count = 0
    for body in bodies:
        rows.append((SemanticClass.WALL, Provenance.INFERRED, f"{body.name} sides and back"))
        rows.append((SemanticClass.ROOF, Provenance.MEASURED, f"{body.name} roof"))
        for kind, face in body.faces():
            if kind in ("ground", "front"):
                continue
            pieces = _upright_pieces(face, kind) if kind in ("left", "right") else [face]
            for piece in pieces:
                corners.append(piece)
                triangles.append(_FAN[: len(piece) - 2] + count)
                feature.append(np.full(len(piece) - 2, len(rows) - (1 if kind == "roof" else 2), np.int32))
                count += len(piece)
    owner = np.concatenate(feature)
    return Mesh(
        id=HOUSES,
        positions_m=(np.concatenate(corners) - middle).astype(np.float32),
        triangles=np.concatenate(triangles).astype(np.uint32),
        features=feature_table(HOUSES, rows),
        materials=(_WALL, _ROOF),
        triangle_feature=owner,
        triangle_material=np.asarray(owner % 2, dtype=np.int32),
    )


_FAN = np.array([[0, 1, 2], [0, 2, 3]])


def _upright_pieces(section: Floats, kind: str) -> list[Floats]:
    """A side (k + 2, 3) cut below each corner of its roof, so that each piece is convex."""
    profile = section if kind == "left" else section[::-1]
    roof, feet = profile[1:-1], profile[[0, -1]]
    away = np.linalg.norm(roof[:, :2] - feet[0, :2], axis=1)
    share = away / max(float(away[-1]), 1e-9)
    below = feet[0] + share[:, None] * (feet[1] - feet[0])
    pieces = [
        np.stack([below[row], roof[row], roof[row + 1], below[row + 1]])
        for row in range(len(roof) - 1)
    ]
    return pieces if kind == "left" else [piece[::-1] for piece in pieces]
