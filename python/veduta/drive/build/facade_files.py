"""The facade planes as files: a metric picture of each, which `veduta facade` takes, and a list."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from PIL import Image

from veduta.drive.build.outcome import Outcome

FACADES, LIST = "facades", "facades.json"
_JPEG_QUALITY = 92


def write_facades(outcomes: Sequence[Outcome], folder: Path) -> int:
    """How many planes there are; where there are none no folder is made.

    `facades.json` says of each where it stands (m, world), and of its picture how many metres a
    pixel has and how much of it no image shows; `<name>-invented.png` is white there.
    """
    rows: list[dict[str, object]] = []
    for outcome in outcomes:
        for name, plane, picture in outcome.planes:
            row: dict[str, object] = {
                "name": name, "segment": outcome.segment.id,
                "left_m": plane.left.round(4).tolist(), "right_m": plane.right.round(4).tolist(),
                "width_m": round(plane.width_m, 4), "height_m": round(plane.height_m, 4),
                "named": list(plane.named),
            }  # fmt: skip
            if picture is not None:
                folder.mkdir(exist_ok=True)
                file = folder / f"{name}.jpg"
                Image.fromarray(picture.pixels).save(file, quality=_JPEG_QUALITY)
                mask = Image.fromarray((picture.invented * np.uint8(255)).astype(np.uint8))
                mask.save(folder / f"{name}-invented.png")
                row |= {
                    "picture": file.name, "metres_per_px": picture.metres_per_px,
                    "seen_in_no_image": round(float(picture.invented.mean()), 4),
                }  # fmt: skip
            rows.append(row)
    if rows:
        folder.mkdir(exist_ok=True)
        text = json.dumps({"facades": rows}, indent=1)
        (folder / LIST).write_text(text + "\n", encoding="utf-8")
    return len(rows)
