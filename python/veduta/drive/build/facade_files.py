"""The facade planes as files: a metric picture of each, which `veduta facade` takes, and a list."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from PIL import Image

from veduta.drive.build.facade_planes import FacadePlane, Orthophoto

FACADES, LIST = "facades", "facades.json"
_JPEG_QUALITY = 92


Row = dict[str, object]


def write_facade(
    name: str, segment: str, plane: FacadePlane, picture: Orthophoto | None, folder: Path
) -> Row:
    """Write the picture of a plane, where there is one, and what `facades.json` says of it: where
    it stands (m, world), how many metres a pixel has, and how much of it no image shows;
    `<name>-invented.png` is white there.
    """
    row: Row = {
        "name": name, "segment": segment,
        "left_m": plane.left.round(4).tolist(), "right_m": plane.right.round(4).tolist(),
        "width_m": round(plane.width_m, 4), "height_m": round(plane.height_m, 4),
        "named": list(plane.named),
    }  # fmt: skip
    if picture is None:
        return row
    folder.mkdir(exist_ok=True)
    file = folder / f"{name}.jpg"
    Image.fromarray(picture.pixels).save(file, quality=_JPEG_QUALITY)
    mask = Image.fromarray((picture.invented * np.uint8(255)).astype(np.uint8))
    mask.save(folder / f"{name}-invented.png")
    return row | {
        "picture": file.name, "metres_per_px": picture.metres_per_px,
        "seen_in_no_image": round(float(picture.invented.mean()), 4),
    }  # fmt: skip


def write_facade_list(rows: Sequence[Row], folder: Path) -> int:
    """How many planes there are; where there are none no folder is made."""
    if rows:
        folder.mkdir(exist_ok=True)
        text = json.dumps({"facades": list(rows)}, indent=1)
        (folder / LIST).write_text(text + "\n", encoding="utf-8")
    return len(rows)
