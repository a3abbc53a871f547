"""The walking cat: a model from its side alone, judged from sides that it has not seen."""

from __future__ import annotations

import os
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray
from record import Value
from scipy.spatial.transform import Rotation

from veduta.fauna.build.limbed import BuiltLimbed, build_limbed
from veduta.fauna.document.limbed import LimbedAnimal
from veduta.fauna.document.plan import load_plan
from veduta.fauna.document.schema import Source
from veduta.fauna.options import FaunaOptions
from veduta.fauna.read.limbed import LimbedLooks, fit_limbed
from veduta.fauna.read.limbed_document import described_limbs, scaled_animal

Floats = NDArray[np.float64]
Row = dict[str, Value]
DATA = Path(os.environ.get("VEDUTA_DATA", Path(__file__).parents[3] / "shared" / "data"))
SIZE, SCALE = (360, 480), 3.0
"""The drawn frames, and pixels for a unit of the meshes."""
CYCLE = 34.0
"""The 35th mesh is the first one again."""


def fitted_cat() -> LimbedAnimal:
    """The cat from its left side."""
    meshes, triangles = _meshes(DATA / "animals" / "walking-cat" / "OBJ")
    masks = np.stack([silhouette(_side(mesh), triangles) for mesh in meshes])
    plan = load_plan("quadruped")
    seen = fit_limbed(masks, np.arange(len(masks)), plan, LimbedLooks(), lambda: None)
    source = Source(file="", sha256="", frames=len(masks), used=len(masks))
    return described_limbs(seen, plan, "cat", source, 0.04, np.ones(1), FaunaOptions())


def cat_rows() -> list[Row]:
    """All that is measured with the cat; nothing where the data is not there."""
    folder = DATA / "animals" / "walking-cat" / "OBJ"
    if not folder.is_dir():
        return []
    meshes, triangles = _meshes(folder)
    masks = np.stack([silhouette(_side(mesh), triangles) for mesh in meshes])
    plan = load_plan("quadruped")
    seen = fit_limbed(masks, np.arange(len(masks)), plan, LimbedLooks(), lambda: None)
    source = Source(file="", sha256="", frames=len(masks), used=len(masks))
    animal = described_limbs(seen, plan, "cat", source, 0.04, np.ones(1), FaunaOptions())
    built = build_limbed(animal)
    unit = scaled_animal(seen, plan, 0.04).unit_px
    joints = seen.windows.in_picture(seen.fitted.joints(), seen.fitted.px_per_length)
    hip = joints[:, seen.fitted.figure.names.index("hip")]
    rows: list[Row] = []
    views = {"the side that was given": 0.0, "30 degrees off": 30.0, "60 degrees off": 60.0,
             "the front": 90.0}  # fmt: skip
    for name, turn in views.items():
        found = []
        for k in range(0, len(meshes), 3):
            mine = _placed(built, k, hip[k], unit, seen.windows.faces)
            pair = [
                silhouette(_from(points, turn), faces)
                for points, faces in (
                    (mine, built.mesh.triangles.astype(np.int64)),
                    (_in_view(meshes[k]), triangles),
                )
            ]
            found.append((pair[0] & pair[1]).sum() / max((pair[0] | pair[1]).sum(), 1))
        bound = "0.8" if turn else ""
        what = f"cat: IoU of the posed surface with the meshes, from {name}"
        rows.append({"what": what, "value": float(np.median(found)),
                     "worst clip": float(np.min(found)), "bound": bound})  # fmt: skip
    down = np.array(animal.poses.down, dtype=np.bool_)
    rows.append({"what": "cat: frames in which the chart of a foot is right",
                 "value": _chart(down, _standing(meshes)), "bound": "0.95"})  # fmt: skip
    off = 1.0 if seen.cycle is None else abs(seen.cycle / CYCLE - 1.0)
    rows.append({"what": "cat: cycle off by", "value": off, "bound": "0.03"})
    slides = max((stride.slides for stride in built.strides), default=1.0)
    rows.append({"what": "cat: a standing foot in the clip slides or sinks (lengths)",
                 "value": slides, "bound": "0.01"})  # fmt: skip
    return rows


def silhouette(points: Floats, triangles: NDArray[np.int64]) -> NDArray[np.bool_]:
    """(h, w) what triangles cover, seen along z. points: (v, 3) px, y down."""
    canvas = np.zeros(SIZE, np.uint8)
    corners = np.round((points[:, :2] - 0.5) * 16).astype(np.int32)[triangles]
    for corner in corners:
        cv2.fillConvexPoly(canvas, corner, 1, shift=4)
    return canvas.astype(np.bool_)


def _meshes(folder: Path) -> tuple[Floats, NDArray[np.int64]]:
    positions: list[list[list[float]]] = []
    triangles: list[list[int]] = []
    for path in sorted(folder.glob("*.obj")):
        lines = [line.split() for line in path.read_text().splitlines()]
        positions.append([[float(x) for x in line[1:4]] for line in lines if line[:1] == ["v"]])
        if not triangles:
            faces = [[int(t.split("/")[0]) - 1 for t in line[1:]] for line in lines
                     if line[:1] == ["f"]]  # fmt: skip
            triangles = [[f[0], f[k], f[k + 1]] for f in faces for k in range(1, len(f) - 1)]
    return np.array(positions), np.array(triangles, dtype=np.int64)


def _in_view(mesh: Floats) -> Floats:
    """(v, 3) px of the side view: to the left forwards, down, and away from the camera."""
    return np.stack(
        [
            0.5 * SIZE[1] - SCALE * mesh[:, 2],
            0.75 * SIZE[0] - SCALE * mesh[:, 1],
            -SCALE * (mesh[:, 0] - mesh[:, 0].mean()),
        ],
        axis=1,
    )


_side = _in_view


def _from(points: Floats, degrees: float) -> Floats:
    """Turned about the upright through the picture's middle."""
    middle = np.array([0.5 * SIZE[1], 0.0, 0.0])
    turn = Rotation.from_euler("y", degrees, degrees=True).as_matrix()
    return np.asarray((points - middle) @ turn.T + middle)


def _placed(built: BuiltLimbed, key: int, hip: Floats, unit: float, faces: float) -> Floats:
    """(v, 3) the posed skin as `_in_view` has the mesh; the hip where the fit has it."""
    mesh, clip = built.mesh, next(c for c in built.mesh.clips if c.name == "footage")
    if mesh.skin is None:
        raise SystemExit("the model has no skin")
    world = np.zeros((len(mesh.skin.names), 4, 4))
    for joint, parent in enumerate(mesh.skin.parent):
        own = np.eye(4)
        own[:3, :3] = Rotation.from_quat(clip.rotations_xyzw[key, joint]).as_matrix()
        own[:3, 3] = clip.translations_m[key, joint]
        world[joint] = own if parent < 0 else world[parent] @ own
    moved = world @ np.linalg.inv(mesh.skin.rest)
    homogeneous = np.column_stack([mesh.positions_m, np.ones(len(mesh.positions_m))])
    points = np.zeros((len(mesh.positions_m), 3))
    for column in range(4):
        each = np.einsum("vij,vj->vi", moved[mesh.skin.joints[:, column]], homogeneous)
        points += mesh.skin.weights[:, column, None] * each[:, :3]
    away = (points - world[1][:3, 3]) / built.bones.length_m * unit
    return np.stack([hip[0] + faces * away[:, 0], hip[1] - away[:, 2], -faces * away[:, 1]], axis=1)


def _standing(meshes: Floats) -> NDArray[np.bool_]:
    """(t, 4) front left and right, hind left and right: a paw's lowest vertex is on the ground."""
    usual = meshes.mean(axis=0)
    columns = []
    for front in (True, False):
        for left in (True, False):
            # A paw's vertices are low on the whole; its leg swings about its shoulder or hip.
            paw = (
                (usual[:, 1] < 9.0) & ((usual[:, 2] > 0.0) == front) & ((usual[:, 0] > 0.0) == left)
            )
            low = meshes[:, paw, 1].min(axis=1)
            columns.append(low < np.percentile(low, 30) + 1.0)
    return np.stack(columns, axis=1)


def _chart(mine: NDArray[np.bool_], truth: NDArray[np.bool_]) -> float:
    """The share of the frames in which feet are told right; each pair whichever way fits better."""
    right = []
    for pair in (slice(0, 2), slice(2, 4)):
        same, other = (truth[:, pair], truth[:, pair][:, ::-1])
        right.append(max(float((mine[:, pair] == one).mean()) for one in (same, other)))
    return float(np.mean(right))
