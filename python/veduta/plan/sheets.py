"""The cleaned drawings beside the document: `sheet-1.png` is that of `storeys[0]`.

Where one is missing or of another size, a blank sheet stands for it: the house does not need it.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.imaging.read import read_image
from veduta.plan.document import PlanDocument, Sheet
from veduta.run.errors import InputError

Pixels = NDArray[np.uint8]
_MOST_PX = 50_000_000
"""A blank sheet has at most so many pixels; its size stands in a file that anybody may edit."""


def sheet_name(index: int) -> str:
    """The file of `storeys[index]`."""
    return f"sheet-{index + 1}.png"


def load_sheets(folder: Path, document: PlanDocument) -> tuple[list[Pixels], list[str]]:
    """The (h, w, 3) cleaned drawings, and what is to be said of those that are missing."""
    sheets: list[Pixels] = []
    notes: list[str] = []
    for index, storey in enumerate(document.storeys):
        pixels, note = _load(folder / sheet_name(index), storey.sheet)
        sheets.append(pixels)
        notes += [note] if note else []
    return sheets, notes


def _load(path: Path, sheet: Sheet) -> tuple[Pixels, str | None]:
    size = (sheet.height_px, sheet.width_px)
    if not path.is_file():
        return _blank(path, size), f"{path.name} is missing: overlay.png has a blank sheet"
    pixels = read_image(path).pixels
    if pixels.shape[:2] != size:
        found = f"{pixels.shape[1]} x {pixels.shape[0]}"
        note = f"{path.name} has {found} px, not those of the document: a blank sheet is shown"
        return _blank(path, size), note
    return pixels, None


def _blank(path: Path, size: Sequence[int]) -> Pixels:
    if min(size) < 1 or size[0] * size[1] > _MOST_PX:
        raise InputError(
            path,
            f"is missing, and the document gives it {size[1]} x {size[0]} px",
            "Mend width_px and height_px of the sheet, or put the file there.",
        )
    return np.full((size[0], size[1], 3), 255, dtype=np.uint8)
