"""Masks: which pixels of a photo are looked at for features.

A mask is a PNG of the size of the upright photo: black pixels hide what lies under them (people,
cars, leaves), and all others show it. It is named after its photo: `hall.png` or `hall.jpg.png` for
`hall.jpg`, the latter as COLMAP has it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.imaging.read import MAX_FILE_BYTES, read_image
from veduta.photos.intake.source import Source
from veduta.run.digests import input_digest
from veduta.run.errors import InputError

SUFFIX = ".png"
MOST_NAMED = 5


@dataclass(frozen=True)
class Mask:
    """A file that may be a mask."""

    path: Path
    sha256: str


def masks_in(folder: Path) -> tuple[Mask, ...]:
    """The masks of a folder, in the order of their names; InputError where it has none."""
    if not folder.is_dir():
        fault = "is a file, not a folder" if folder.exists() else "does not exist"
        raise InputError(folder, fault, "Name the folder of the masks (PNG) with --masks.")
    found = []
    for path in sorted(folder.iterdir()):
        if path.suffix.lower() != SUFFIX or path.name.startswith("."):
            continue
        found.append(Mask(path, input_digest(path, MAX_FILE_BYTES)))
    if not found:
        remedy = "Name them after the photos: hall.png or hall.jpg.png for hall.jpg."
        raise InputError(folder, "holds no masks (PNG)", remedy)
    return tuple(found)


def with_masks(
    sources: Sequence[Source], masks: Sequence[Mask]
) -> tuple[tuple[Source, ...], tuple[str, ...]]:
    """The photos with their masks, and what is to be told of those that have no counterpart.

    InputError where two masks are named after one photo.
    """
    by_name = {mask.path.name.lower(): mask for mask in masks}
    found, used, bare = [], set(), []
    for source in sources:
        stem = Path(source.name).stem.lower()
        names = [f"{source.name.lower()}{SUFFIX}", f"{stem}{SUFFIX}"]
        own = [by_name[name] for name in dict.fromkeys(names) if name in by_name]
        if len(own) > 1:
            raise InputError(
                own[1].path, f"is a second mask of {source.name}", f"Remove it, or {own[0].path}."
            )
        if not own:
            bare.append(source.name)
            found.append(source)
            continue
        used.add(own[0].path)
        found.append(replace(source, mask=own[0].path, mask_sha256=own[0].sha256))
    lone = [mask.path.name for mask in masks if mask.path not in used]
    notes = []
    if masks and bare:
        notes.append(f"{_counted(bare, 'photo')} without a mask: all of it is looked at")
    if lone:
        notes.append(f"{_counted(lone, 'mask')} without a photo: not used")
    return tuple(found), tuple(notes)


def read_mask(mask: Path, photo: str, size_px: tuple[int, int]) -> NDArray[np.bool_]:
    """(h, w) True where the photo is looked at; InputError where it has another size.

    size_px: width and height of the upright photo.
    """
    pixels = read_image(mask).pixels
    height, width = pixels.shape[:2]
    if (width, height) != size_px:
        raise InputError(
            mask,
            f"is {width} x {height} px, and its photo {photo} {size_px[0]} x {size_px[1]} px",
            "Save the mask in the size of its photo, seen upright.",
        )
    return np.asarray(pixels.any(axis=2), dtype=np.bool_)


def shown_at(shown: NDArray[np.bool_], places_px: NDArray[np.float32]) -> NDArray[np.bool_]:
    """(k,) whether (k, 2) places, x right and y down, lie in pixels that are looked at."""
    height, width = shown.shape
    columns = np.clip(places_px[:, 0].astype(np.int64), 0, width - 1)
    rows = np.clip(places_px[:, 1].astype(np.int64), 0, height - 1)
    found: NDArray[np.bool_] = shown[rows, columns]
    return found


def _counted(names: Sequence[str], what: str) -> str:
    """So many of them, and the first ones by name."""
    shown = ", ".join(names[:MOST_NAMED]) + (" ..." if len(names) > MOST_NAMED else "")
    return f"{len(names)} {what}{'s' if len(names) > 1 else ''} ({shown})"
