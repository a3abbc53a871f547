"""Sheets to look at: the photo, the photo with what was found, and both label images."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from facade_measures import accuracy, confusion
from facade_reading import Reading
from facade_truth import IGNORED, Labelled, Labels
from numpy.typing import NDArray
from PIL import Image

from veduta.facade.document import CLASSES
from veduta.facade.outputs import COLOURS
from veduta.facade.overlay import overlay


def write_sheet(path: Path, example: Labelled, reading: Reading) -> None:
    """Photo with what was found, found labels, true labels, and what is wrong (red)."""
    with Image.open(example.image) as image:
        photo = np.asarray(image.convert("RGB"))
    found, true = _coloured(reading.labels), _coloured(example.labels)
    drawn = photo if reading.document is None else overlay(reading.document, photo)
    wrong = (photo * 0.5).astype(np.uint8)
    wrong[_wrong(reading.labels, example.labels)] = (220, 40, 40)
    sheet = Image.fromarray(np.hstack([_fitted(drawn, photo), found, true, wrong]))
    sheet.save(path, quality=88)
    print(f"{path.name}: accuracy {accuracy(confusion(reading.labels, example.labels)):.3f}")


def _wrong(found: Labels, true: Labels) -> NDArray[np.bool_]:
    merged = np.where(found == CLASSES.index("chimney"), CLASSES.index("roof"), found)
    return np.asarray((merged != true) & (true != IGNORED))


def _coloured(labels: Labels) -> NDArray[np.uint8]:
    palette = np.zeros((256, 3), np.uint8)
    palette[: len(CLASSES)] = [COLOURS[name] for name in CLASSES]
    return palette[labels]


def _fitted(picture: NDArray[np.uint8], like: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """The picture at the height of another; the drawn photo has a legend beside it."""
    height = like.shape[0]
    size = (round(picture.shape[1] * height / picture.shape[0]), height)
    return np.asarray(Image.fromarray(picture).resize(size), np.uint8)
