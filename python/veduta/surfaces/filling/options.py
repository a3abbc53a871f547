"""Thresholds of filling."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class FillParameters:
    """How holes are filled.

    bridge_px: gaps of a row or column up to this are filled by interpolation where both ends are
    smooth and alike (section 7.3 of the paper: without the length, a wall's smooth ends would be
    joined over a hidden window). alike, smooth: difference of the ends, and standard deviation
    around them (of 255). coarsest_px: the longest side of the level on which all offsets are
    looked at. shortest: offset (share of that side) below which a surface is like itself anyway.
    offsets: that are followed to finer levels. tried: on the coarsest. windows_px: sides of the
    windows, largest first; a smaller one serves where the larger fits worse than `good` (root mean
    square, of 255). known: share of a source window that must be known. different: larger
    differences count as this (outliers). faith: weight of how well a whole facade repeats by an
    offset, in shares of a window. rounds: on each level; coarsest_rounds: on the coarsest, where
    nothing is known of its offsets. around_px: side of the square in which `smooth` is looked at.
    overlap, help: shares of the known pixels that an offset leads to known ones, and of the hole
    that it fills, at least. most_holes: beyond this number small ones are one together. guessed:
    weight of a pixel that was filled on a coarser level, beside a known one. light: larger
    differences (of 255) beside a hole are of things, not of light.
    """

    bridge_px: int = 9
    alike: float = 12.0
    smooth: float = 6.0
    coarsest_px: int = 80
    shortest: float = 0.06
    offsets: int = 32
    tried: int = 500
    windows_px: tuple[int, ...] = (25, 13, 9)
    good: float = 14.0
    known: float = 0.9
    different: float = 80.0
    faith: float = 0.15
    rounds: int = 2
    coarsest_rounds: int = 6
    around_px: int = 5
    overlap: float = 0.1
    help: float = 0.1
    most_holes: int = 400
    guessed: float = 0.35
    light: float = 30.0


@dataclass(frozen=True)
class RepeatParameters:
    """How one of several known offsets is chosen for each place.

    longest_px: the longer side of the small copy. around: how far around a place its likeness is
    looked at, in shares of `reach_px` (a storey, say): near, and far where nothing is known near.
    far_weight: of the far in the likeness. different: larger differences (of 255) count as this.
    faith: the weight of how well the whole picture repeats by an offset, in shares of a known
    surrounding. guessed: weight of what was filled the round before. rounds: how often is chosen
    anew. steady: in shares of `reach_px`, over which one offset is kept. refine_px: by how much an
    offset may be off at full size. largest: holes that give steps of their own. smooth: in shares
    of `reach_px`, how far an interpolation is good. strip: in the same, the rows above a hole that
    are carried down into it. lower: the mean square error (of 255) that these get a strip further
    down. sharp: how much the likeliest of all ways outweighs the others: the power of the inverse
    of their errors. outlier: larger differences (of 255) count as this where an offset is moved by
    a few pixels; better: the share of the difference at which it is better by more than chance.
    telea_px: radius of the interpolation. beside, carried: mean square errors (of 255) of the
    interpolation right beside what is known, and of what is carried down by nothing. Chosen on
    four synthetic facades, of seeds 0 to 3.
    """

    longest_px: int = 256
    around: tuple[float, float] = (0.12, 0.4)
    far_weight: float = 0.15
    different: float = 70.0
    faith: float = 0.05
    guessed: float = 0.25
    rounds: int = 2
    steady: float = 0.06
    refine_px: int = 2
    largest: int = 12
    smooth: float = 0.1
    strip: float = 0.25
    lower: float = 120.0
    sharp: float = 2.0
    outlier: float = 60.0
    better: float = 0.97
    telea_px: int = 5
    beside: float = 30.0
    carried: float = 60.0
