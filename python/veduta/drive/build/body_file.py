"""The houses behind the facades as CityJSON, level of detail 2."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from veduta.drive.build.bodies import Body
from veduta.formats.cityjson_solids import CityDocument, CityFace, closes
from veduta.place.semantics import Provenance
from veduta.run.atomic import write_bytes

BUILDINGS = "buildings.city.json"
_SURFACES: dict[str, tuple[str, Provenance]] = {
    "front": ("WallSurface", Provenance.MEASURED),
    "roof": ("RoofSurface", Provenance.MEASURED),
    "ground": ("GroundSurface", Provenance.INFERRED),
    "left": ("WallSurface", Provenance.INFERRED),
    "right": ("WallSurface", Provenance.INFERRED),
    "back": ("WallSurface", Provenance.INFERRED),
}


def write_bodies(
    bodies: Sequence[Body],
    path: Path,
    title: str,
    crs: str | None,
    origin_m: tuple[float, float, float],
) -> list[str]:
    """Write those that close; the names of those that do not, which are left out.

    origin_m: of the frame of the bodies in the CRS. Without any body there is no file.
    """
    shift = np.array(origin_m)
    shaped = [(one, [(kind, corners + shift) for kind, corners in one.faces()]) for one in bodies]
    sound = [closes([[corners] for _, corners in faces]) for _, faces in shaped]
    closed = [one for one, good in zip(shaped, sound, strict=True) if good]
    open_ = [one.name for one, good in zip(bodies, sound, strict=True) if not good]
    if not closed:
        return open_
    corners = np.concatenate([face for _, faces in closed for _, face in faces])
    low, high = corners.min(axis=0), corners.max(axis=0)
    city = CityDocument(title, low, lod="2", crs=crs)
    for body, faces in closed:
        keys = [f"{kind}-{row}" if kind == "roof" else kind for row, (kind, _) in enumerate(faces)]
        surfaces = {
            key: {"type": _SURFACES[kind][0], "provenance": _SURFACES[kind][1].value}
            for key, (kind, _) in zip(keys, faces, strict=True)
        }
        shell = [CityFace([face], key) for key, (_, face) in zip(keys, faces, strict=True)]
        told = {
            "measuredHeight": round(float(body.profile[:, 1].max()), 3),
            "roofOff_m": round(body.off_m, 3),
        }
        city.add(body.name, "Building", attributes=told, geometry=[city.solid([shell], surfaces)])
    write_bytes(path, city.content(low.tolist(), high.tolist()))
    return open_
