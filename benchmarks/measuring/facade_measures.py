"""Measures of found labels and windows against true ones."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from facade_truth import IGNORED, Boxes, Labels
from numpy.typing import NDArray

from veduta.facade.document import CLASSES

Counts = NDArray[np.int64]
"""(classes, classes) pixels: row true, column found."""
_ROOF, _CHIMNEY = CLASSES.index("roof"), CLASSES.index("chimney")


def confusion(found: Labels, true: Labels) -> Counts:
    """Pixels by true and found class; a found chimney is roof, what the truth leaves open is out.

    Labels are the places in the document's classes.
    """
    n = len(CLASSES)
    merged = np.where(found == _CHIMNEY, _ROOF, found).astype(np.int64)
    known = true != IGNORED
    pairs = true[known].astype(np.int64) * n + merged[known]
    return np.bincount(pairs, minlength=n * n).reshape(n, n).astype(np.int64)


def accuracy(counts: Counts) -> float:
    """Share of the pixels whose class is right."""
    return float(np.trace(counts) / max(1, counts.sum()))


@dataclass(frozen=True)
class ClassRow:
    """One true class: shares (0..1), and what its pixels are most often taken for instead."""

    name: str
    share: float
    recall: float
    precision: float
    iou: float
    taken_for: str


def class_table(counts: Counts) -> list[ClassRow]:
    """A row for each class that is true anywhere."""
    rows = []
    for i, name in enumerate(CLASSES):
        true, found, right = counts[i].sum(), counts[:, i].sum(), counts[i, i]
        if not true:
            continue
        wrong = counts[i].copy()
        wrong[i] = 0
        order = [j for j in np.argsort(-wrong, kind="stable")[:3] if wrong[j] >= 0.02 * true]
        rows.append(
            ClassRow(
                name=name,
                share=float(true / counts.sum()),
                recall=float(right / true),
                precision=float(right / found) if found else 0.0,
                iou=float(right / (true + found - right)),
                taken_for=", ".join(f"{CLASSES[j]} {wrong[j] / true:.2f}" for j in order),
            )
        )
    return rows


@dataclass(frozen=True)
class Matches:
    """How many windows there are, how many were found, and how many of these are right."""

    true: int
    found: int
    matched: int

    def __add__(self, other: Matches) -> Matches:
        return Matches(
            self.true + other.true, self.found + other.found, self.matched + other.matched
        )

    @property
    def precision(self) -> float:
        """Share of the found that are right."""
        return self.matched / self.found if self.found else 0.0

    @property
    def recall(self) -> float:
        """Share of the true that were found."""
        return self.matched / self.true if self.true else 0.0

    @property
    def f1(self) -> float:
        """Harmonic mean of precision and recall."""
        return 2 * self.matched / (self.true + self.found) if self.true + self.found else 0.0


def overlaps(found: Boxes, true: Boxes) -> NDArray[np.float64]:
    """Intersection over union of every found with every true box, (found, true)."""
    low = np.maximum(found[:, None, :2], true[None, :, :2])
    high = np.minimum(found[:, None, 2:], true[None, :, 2:])
    shared = np.clip(high - low, 0, None).prod(-1)
    areas = [(boxes[:, 2:] - boxes[:, :2]).prod(-1) for boxes in (found, true)]
    return np.asarray(shared / np.maximum(areas[0][:, None] + areas[1][None] - shared, 1e-9))


def match(found: Boxes, true: Boxes, least: float = 0.5) -> Matches:
    """One to one, greedily: the best overlap of all first, down to `least`."""
    table = overlaps(found, true)
    matched = 0
    while table.size and table.max() >= least:
        i, j = np.unravel_index(int(table.argmax()), table.shape)
        table[i, :] = table[:, j] = -1
        matched += 1
    return Matches(len(true), len(found), matched)
