"""Labelled facades of the real data: their labels in the document's classes, and what follows.

Labels are (h, w) uint8 at the size of the image, the place of the class in the document's
`CLASSES`; a chimney counts as roof, and what the truth leaves open is `IGNORED`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray
from PIL import Image
from scipy import ndimage

from veduta.facade.document import CLASSES, FacadeClass

Labels = NDArray[np.uint8]
Boxes = NDArray[np.float64]
"""(n, 4): left, top, right, bottom in pixels."""

IGNORED = 255
WINDOW = CLASSES.index("window")
SPECK_PX = 30
"""Components of fewer pixels are slivers that a balcony left of a window."""

_ECP: dict[tuple[int, int, int], FacadeClass] = {
    (255, 0, 0): "window",
    (255, 255, 0): "wall",
    (128, 0, 255): "balcony",
    (255, 128, 0): "door",
    (0, 0, 255): "roof",
    (128, 128, 128): "roof",  # chimney
    (128, 255, 255): "sky",
    (0, 255, 0): "shop",
}
# The set's numbers from 1: background, facade, window, door, cornice, sill, balcony, blind, deco,
# molding, pillar, shop. Blinds (shutters too) lie on windows and beside them: left open.
_CMP: tuple[FacadeClass | None, ...] = (
    None, "wall", "window", "door", "wall", "wall", "balcony", None, "wall", "wall", "wall", "shop",
)  # fmt: skip
_ARTDECO: tuple[FacadeClass, ...] = ("door", "shop", "balcony", "window", "wall", "sky", "roof")
# Least step between the lower edges of two rows of windows, part of the image height. The 80
# facades are five to seven storeys high; their nearest true rows are 0.08 apart.
_ROW_STEP = 0.06
# In storeys: windows that end nearer to the image's lower border are the ground floor's own.
_GROUND = 0.75


@dataclass(frozen=True)
class Labelled:
    """An image and its true labels."""

    name: str
    image: Path
    labels: Labels


def ecp(data: Path, split: str) -> list[Labelled]:
    """The facades of a split (`train` or `val`) of facades/ecp."""
    folder = data / "facades/ecp"
    lines = (line.split() for line in (folder / "split.txt").read_text().splitlines())
    names = {first: rest for first, *rest in lines}[split]
    return [
        Labelled(
            name,
            folder / f"images/{name}.jpg",
            ecp_labels(np.asarray(Image.open(folder / f"masks/{name}.png").convert("RGB"))),
        )
        for name in names
    ]


def ecp_labels(mask: NDArray[np.uint8]) -> Labels:
    """Labels of an (h, w, 3) colour mask."""
    labels = np.full(mask.shape[:2], IGNORED, np.uint8)
    for colour, name in _ECP.items():
        labels[(mask == colour).all(-1)] = CLASSES.index(name)
    return labels


def artdeco(data: Path) -> list[Labelled]:
    """The facades of facades/artdeco."""
    folder = data / "facades/artdeco"
    paths = sorted(folder.glob("images/*.jpg"), key=lambda p: int(p.stem.rpartition("_")[2]))
    found = []
    for path in paths:
        with Image.open(path) as image:
            size = image.size
        indices = np.loadtxt(folder / f"labels/{path.stem}.txt", dtype=np.int64)
        found.append(Labelled(path.stem, path, resized(artdeco_labels(indices), size)))
    return found


def cmp(data: Path) -> list[Labelled]:
    """Every third picture of facades/cmp."""
    paths = sorted((data / "facades/cmp").glob("cmp_b*.png"))
    kept = [path for path in paths if int(path.stem.removeprefix("cmp_b")) % 3 == 2]
    return [Labelled(p.stem, p.with_suffix(".jpg"), cmp_picture_labels(p)) for p in kept]


def cmp_picture_labels(path: Path) -> Labels:
    """Labels of one picture of facades/cmp."""
    return cmp_labels(_indices(path.with_suffix(".png")))


def _indices(path: Path) -> NDArray[np.int64]:
    with Image.open(path) as image:
        return np.asarray(image, np.int64)


def cmp_labels(indices: NDArray[np.int64]) -> Labels:
    """Labels of an (h, w) image of the set's own numbers; sky and roof are not told apart in it."""
    places = [IGNORED if name is None else CLASSES.index(name) for name in _CMP]
    return np.array([IGNORED, *places], np.uint8)[indices]


def artdeco_labels(indices: NDArray[np.int64]) -> Labels:
    """Labels of an (h, w) grid of the set's own indices, -1 for what it leaves open."""
    table = np.array([*(CLASSES.index(name) for name in _ARTDECO), IGNORED], np.uint8)
    return table[indices]


def resized(labels: Labels, size: tuple[int, int]) -> Labels:
    """Labels at another (width, height), each pixel that of its nearest."""
    if labels.shape[1::-1] == size:
        return labels
    return np.asarray(cv2.resize(labels, size, interpolation=cv2.INTER_NEAREST_EXACT), np.uint8)


def components(labels: Labels, label: int, least_px: int = 1) -> Boxes:
    """Bounding boxes of the connected components (4 neighbours) of one class."""
    marked, _ = ndimage.label(labels == label)
    sizes = np.bincount(marked.ravel())[1:]
    boxes = [
        (s[1].start, s[0].start, s[1].stop, s[0].stop)
        for s, size in zip(ndimage.find_objects(marked), sizes, strict=True)
        if size >= least_px
    ]
    return np.array(boxes, np.float64).reshape(-1, 4)


def true_storeys(labels: Labels) -> int:
    """The ground floor and the rows of windows between it and the eaves.

    The eaves are the last row of pixels with more roof than wall and balcony. Windows whose middle
    is below it are parted into rows by their lower edges; a row that ends nearer to the image's
    lower border than 0.75 of the median step between rows is the ground floor's own.
    """
    return 1 + len(window_rows(labels))


def window_rows(labels: Labels) -> list[float]:
    """The median lower edge of the windows of each floor above the ground floor, from above."""
    height = len(labels)
    rows = _rows_of_windows(components(labels, WINDOW, SPECK_PX), _eaves(labels), height)
    if len(rows) > 1 and height - rows[-1] < _GROUND * np.median(np.diff(rows)):
        rows = rows[:-1]
    return rows


def _eaves(labels: Labels) -> int:
    roof = (labels == CLASSES.index("roof")).sum(1)
    front = np.isin(labels, [CLASSES.index("wall"), CLASSES.index("balcony")]).sum(1)
    above = np.flatnonzero(roof > front)
    return int(above[-1]) + 1 if len(above) else 0


def _rows_of_windows(windows: Boxes, eaves: int, height: int) -> list[float]:
    """The median lower edge of each row, from the eaves down."""
    below = windows[windows[:, [1, 3]].mean(1) > eaves]
    if not len(below):
        return []
    edges = np.sort(below[:, 3])
    cuts = [0, *(np.flatnonzero(np.diff(edges) > _ROW_STEP * height) + 1).tolist(), len(edges)]
    return [float(np.median(edges[a:b])) for a, b in pairwise(cuts)]


def position_template(examples: Sequence[Labelled], size: tuple[int, int] = (300, 560)) -> Labels:
    """The most frequent label at each place of labels that are brought to one (width, height)."""
    votes = np.zeros((len(CLASSES), size[1], size[0]), np.int64)
    for example in examples:
        labels = resized(example.labels, size)
        for label in range(len(CLASSES)):
            votes[label] += labels == label
    return np.asarray(votes.argmax(0), np.uint8)


def horizontal_bands(labels: Labels, classes: Sequence[FacadeClass] = CLASSES) -> Labels:
    """Each row all of the one of `classes` that is most frequent in its truth."""
    allowed = [CLASSES.index(name) for name in classes]
    counts = np.stack([(labels == label).sum(1) for label in allowed])
    best = np.array(allowed, np.uint8)[counts.argmax(0)]
    return np.repeat(best[:, None], labels.shape[1], axis=1)
