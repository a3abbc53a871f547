"""Exposure levelled: a gain of each view and channel, so that what two views share has one colour."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.walk.rig import Image

Gains = NDArray[np.float64]


@dataclass(frozen=True)
class LevelLimits:
    """dark, bright: channel values beyond which nothing is said (noise, saturation). fewest: pixels
    for a comparison. rest: how firmly a gain is held at 1 (one comparison counts 1): exposure that
    drifts along a long path is evened out locally and not carried along. most: largest gain.
    """

    dark: float = 12.0
    bright: float = 243.0
    fewest: int = 200
    rest: float = 0.02
    most: float = 2.5


@dataclass(frozen=True)
class Compared:
    """Two views beside one another. ratio: (3,) by how much the second is brighter (a factor)."""

    first: int
    second: int
    ratio: tuple[float, float, float]


def compare_colours(
    one: NDArray[np.floating] | Image, other: NDArray[np.floating] | Image,
    limits: LevelLimits = LevelLimits(),
) -> tuple[float, float, float] | None:  # fmt: skip
    """How much brighter the second (n, 3) colours are: the middle ratio of each channel.

    None where too few are neither dark nor saturated.
    """
    values = np.stack([one, other]).astype(np.float64)
    usable = ((values > limits.dark) & (values < limits.bright)).all(axis=(0, 2))
    if usable.sum() < limits.fewest:
        return None
    ratio = np.exp(np.median(np.log(values[1, usable] / values[0, usable]), axis=0))
    return float(ratio[0]), float(ratio[1]), float(ratio[2])


def level_gains(
    count: int, compared: list[Compared], limits: LevelLimits = LevelLimits()
) -> Gains:
    """(count, 3) factors that make the views alike, by least squares in the logarithm."""
    rows = np.zeros((len(compared) + count, count))
    wanted = np.zeros((len(rows), 3))
    for number, one in enumerate(compared):
        rows[number, one.first], rows[number, one.second] = 1.0, -1.0
        wanted[number] = np.log(one.ratio)
    rows[len(compared) :] = np.eye(count) * np.sqrt(limits.rest)
    gains = np.exp(np.linalg.lstsq(rows, wanted, rcond=None)[0])
    return np.asarray(np.clip(gains, 1.0 / limits.most, limits.most))


def levelled(image: Image, gain: Gains) -> Image:
    """The picture times its gain (3,)."""
    if np.abs(gain - 1.0).max() < 1e-3:
        return image
    return np.clip(np.round(image * gain), 0, 255).astype(np.uint8)
