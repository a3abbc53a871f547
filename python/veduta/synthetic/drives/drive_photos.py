"""The images of a whole drive, as files beside its tables."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pyarrow
import pyarrow.parquet
from numpy.typing import NDArray
from PIL import Image

from veduta.synthetic.drives.fronts import Fronts
from veduta.synthetic.drives.made_photos import overcast, photograph_made
from veduta.synthetic.drives.made_street import MadeStreet
from veduta.synthetic.drives.photograph import StreetCamera, StreetPhoto, photograph
from veduta.synthetic.drives.scan import TruckOptions, poses_at
from veduta.synthetic.drives.street import Street

_TOML = """
[camera]
table = "images.parquet"
# To the left: x of the camera forward, y down, z to the left.
vehicle_from_camera = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, -1.0, 0.0, {height}]
width_px = {width_px}
height_px = {height_px}
focal_px = [{focal}, {focal}]
centre_px = [{middle_x}, {middle_y}]
"""
_QUALITY = 93


@dataclass(frozen=True, eq=False)
class Taken:
    """One image: its name, the times (s) when it was taken and that are told, its truth."""

    name: str
    time_s: float
    told_s: float
    photo: StreetPhoto


def take_photos(
    street: Street | MadeStreet,
    fronts: Fronts | None,
    truck: TruckOptions,
    camera: StreetCamera,
    seed: int,
    part_m: tuple[float, float] | None = None,
) -> Iterator[Taken]:
    """One after the other along the street, or a part of it. fronts: what those of a street of
    boxes look like; a made street's houses have their own looks, so that it needs none.
    """
    light = overcast(seed)
    random = np.random.default_rng((seed, 5))
    low, high = part_m or (0.0, street.length_m)
    for number, y in enumerate(np.arange(low, high, camera.spacing_m).tolist()):
        pose = poses_at(np.array([y]), truck, street.way)[0]
        time_s = y / truck.speed_m_s
        told = time_s + camera.jitter_s * float(random.normal())
        if isinstance(street, MadeStreet):
            photo = photograph_made(street, camera, pose, light, random)
        else:
            photo = photograph(street, fronts or Fronts(street, seed), camera, pose, random)
        yield Taken(f"{number:05d}", time_s, told, photo)


def write_photos(taken: Iterator[Taken], camera: StreetCamera, folder: Path) -> NDArray[np.float64]:
    """Into a folder with a `drive.toml`, which learns of the camera; (n,) the true times (s)."""
    names, told, true = [], [], []
    for one in taken:
        names.append(f"{one.name}.jpg")
        told.append(one.told_s)
        true.append(one.time_s)
        Image.fromarray(one.photo.pixels).save(folder / names[-1], quality=_QUALITY)
    rows = pyarrow.table({"time_s": told, "file": names})
    pyarrow.parquet.write_table(rows, folder / "images.parquet")
    toml = folder / "drive.toml"
    text = _TOML.format(
        height=camera.height_m, width_px=camera.width_px, height_px=camera.height_px,
        focal=camera.focal_px, middle_x=camera.width_px / 2, middle_y=camera.height_px / 2,
    )  # fmt: skip
    toml.write_text(toml.read_text(encoding="utf-8") + text, encoding="utf-8")
    return np.array(true)
