"""What an animal can do on its way, and how smooth its path is: the thresholds of all steps."""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass(frozen=True)
class SmoothLimits:
    """Of the curve along a planned way; chosen by eye on drawn terrains."""

    rounds: int = 7
    """So often it is made half as smooth before it is given up."""
    smoothed: float = 2.0
    """The way's steps are smoothed over so many body lengths before the spline."""
    near: float = 0.35
    """It passes the points that it was asked to go through so near at least, in body lengths."""
    footing: float = 0.25
    """Heights along it are smoothed over so many body lengths: noise moves feet, not bodies."""


@dataclass(frozen=True)
class CornerLimits:
    """Of corners in which an animal turns on the spot; chosen by eye."""

    sharpest_deg: float = 100.0
    """Where a way turns by more, on a body length, no curve is as one would walk it."""
    room: float = 0.5
    """A body turns in a circle of so many lengths."""


@dataclass(frozen=True)
class RoundLimits:
    """Of a round that nobody asked for."""

    across: float = 12.0
    """It is so many body lengths across at most."""
    corners: int = 6


@dataclass(frozen=True)
class PathLimits:
    """What an animal can do, and what it avoids."""

    slope_deg: float = 35.0
    """It goes up and down no steeper than so."""
    half_width: float = 0.15
    """It keeps so far from obstacles, in body lengths."""
    step: float = 0.05
    """Heights that vary by so much along an edge, in body lengths, count as much as its length."""
    coarse: int = 4
    """Cells of the first plan of a large terrain, along a side."""
    large: int = 60_000
    """A terrain of more cells is planned so."""
    corridor: int = 6
    """Half the width of the corridor, in large cells."""
    smooth: SmoothLimits = field(default_factory=SmoothLimits)
    corner: CornerLimits = field(default_factory=CornerLimits)
    round: RoundLimits = field(default_factory=RoundLimits)
