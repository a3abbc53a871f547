"""All that is known of the photos of a street, as plain JSON: `truth.json`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.synthetic.camera import Camera
from veduta.synthetic.streets.house import Street
from veduta.synthetic.streets.walls import TrueWall


def truth_json(
    street: Street,
    names: Sequence[str],
    cameras: Sequence[Camera],
    gps_m: NDArray[np.float64],
    walls: Sequence[TrueWall],
    held_back: Sequence[str] = (),
) -> dict[str, Any]:
    """Lengths in metres about `origin_m` in `crs`; x east, y north, z up.

    gps_m: (n, 3) what the receivers say, in the same frame. held_back: names of photos that are
    not among those to reconstruct from.
    """
    return {
        "seed": street.seed,
        "crs": street.crs,
        "origin_m": list(street.origin_m),
        "photos": [
            _photo(name, camera, gps, name in held_back)
            for name, camera, gps in zip(names, cameras, gps_m, strict=True)
        ],
        "houses": [
            {
                "id": house.id,
                "outline_m": house.outline_m.tolist(),
                "base_m": house.base_m,
                "top_m": house.top_m,
            }
            for house in (*street.houses, *street.others)
        ],
        "walls": [
            {
                "id": wall.id,
                "house": wall.house,
                "start_m": wall.start_m.tolist(),
                "end_m": wall.end_m.tolist(),
                "bottom_m": wall.bottom_m,
                "top_m": wall.top_m,
                "outward": wall.outward.tolist(),
                "seen_m": wall.seen_m,
                "seen_from_m": wall.seen_from_m,
                "seen_to_m": wall.seen_to_m,
            }
            for wall in walls
        ],
    }


def _photo(
    name: str, camera: Camera, gps_m: NDArray[np.float64], held_back: bool
) -> dict[str, Any]:
    return {
        "name": name,
        "held_back": held_back,
        "width_px": camera.width_px,
        "height_px": camera.height_px,
        "focal_px": camera.focal_px,
        "centre_px": list(camera.centre_px),
        "distortion": asdict(camera.distortion),
        "cam_from_world": camera.cam_from_world.tolist(),
        "position_m": camera.position_m.tolist(),
        "gps_m": gps_m.tolist(),
    }
