"""Fans of treads: lines that run to one newel, at even angles.

Lines that run slantwise vote by pairs for the place where they meet. Around each such place the ink
is looked at in polar coordinates: a tread is a direction that is inked over most of the radii.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from itertools import pairwise

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from veduta.plan.stairs.probe import INKED, Probe, Spot

LEAST_PIECE = 0.022
"""Of slanted lines, as a share of the longer side of all that is drawn."""
MOST_WIDTH = 0.25
"""Of a flight; a share, too."""
TREAD = (0.005, 0.06)
"""In the middle of the flight; a share, too."""
MOST_PIECES = 300
SLANT_RAD = math.radians(8.0)
APART_RAD = math.radians(8.0)
MEET_PX = 3.0
MOST_NEWELS = 80
MOST_LOOKED = 800
"""So many places are looked at for them."""
TURN_RAD = (math.radians(9.0), math.radians(48.0))
"""From tread to tread."""
EVEN = 0.22
LEAST_TREADS = 3
LEAST_RADIUS_PX = 12.0
LEAST_SPIRAL_RAD = math.radians(150.0)
SNAP_RAD = math.radians(13.0)
RADII = (0.3, 0.9)
BARE = 0.45
"""Between treads less than this is inked."""
GAP = 0.09
"""A tread may be broken over such a share by an arrow that is drawn in a gap, or by damage."""


@dataclass(frozen=True)
class Fan:
    """Treads about a newel. angles: (n,) of their edges from +x to +y, rising; radius_px: of the
    flight's width, at a right angle to walls; `round`: it ends in an arc, not at walls.
    """

    newel: Spot
    angles: NDArray[np.float64]
    radius_px: float
    round: bool
    score: float

    @property
    def sweep(self) -> float:
        """Through which angle it turns."""
        return float(self.angles[-1] - self.angles[0])


def find_fans(ink: NDArray[np.bool_], probe: Probe) -> list[Fan]:
    """All that look like fans in the (h, w) mask of ink, the best first."""
    pieces = _slanted(ink, probe)
    found = []
    for newel in _meetings(pieces, probe):
        fan = _fan(newel, pieces, probe)
        if fan is not None:
            found.append(fan)
    found.sort(key=lambda one: -one.score * len(one.angles))
    kept: list[Fan] = []
    for fan in found:
        if all(np.hypot(*(fan.newel - one.newel)) > one.radius_px for one in kept):
            kept.append(fan)
    return kept


def _slanted(ink: NDArray[np.bool_], probe: Probe) -> NDArray[np.float64]:
    """(n, 2, 2) the ends of pieces of slanted lines, the longest first (LSD)."""
    thin = (ink & ~(probe.solid > 0)).astype(np.uint8) * 255
    lines = cv2.createLineSegmentDetector().detect(thin)[0]
    # OpenCV has None for no lines.
    ends = np.reshape(() if lines is None else lines, (-1, 2, 2)).astype(np.float64)
    ways = ends[:, 1] - ends[:, 0]
    lengths = np.hypot(*ways.T)
    angle = np.abs(np.arctan2(ways[:, 1], ways[:, 0])) % (math.pi / 2)
    slanted = np.minimum(angle, math.pi / 2 - angle) > SLANT_RAD
    kept = np.flatnonzero(slanted & (lengths >= LEAST_PIECE * probe.extent_px))
    order: NDArray[np.float64] = ends[kept[np.argsort(-lengths[kept])]][:MOST_PIECES]
    return order


def _meetings(pieces: NDArray[np.float64], probe: Probe) -> list[Spot]:
    """Where two slanted pieces meet beyond their nearer ends, those that most agree on first."""
    if len(pieces) < 2:
        return []
    first, second = np.triu_indices(len(pieces), 1)
    start, way = pieces[:, 0], pieces[:, 1] - pieces[:, 0]
    way = way / np.hypot(*way.T)[:, None]
    cross = way[first, 0] * way[second, 1] - way[first, 1] * way[second, 0]
    apart = np.abs(cross) > math.sin(APART_RAD)
    first, second, cross = first[apart], second[apart], cross[apart]
    to = start[second] - start[first]
    along = (to[:, 0] * way[second, 1] - to[:, 1] * way[second, 0]) / cross
    places = start[first] + along[:, None] * way[first]
    fits = _leads_to(places, pieces[first], probe) & _leads_to(places, pieces[second], probe)
    places = places[fits]
    if not len(places):
        return []
    tree = KDTree(places)
    # All lists at once would grow with the fourth power of the lines that meet in one place.
    counts = tree.query_ball_point(places, MEET_PX, return_length=True)
    found: list[Spot] = []
    looked = 0
    for row in np.argsort(-counts, kind="stable"):
        if _is_beside(places[row], found):
            continue
        place = places[tree.query_ball_point(places[row], MEET_PX)].mean(axis=0)
        if not _is_beside(place, found):
            found.append(place)
        looked += 1
        if len(found) == MOST_NEWELS or looked == MOST_LOOKED:
            break
    return found


def _is_beside(place: Spot, others: list[Spot]) -> bool:
    return any(np.hypot(*(place - one)) <= MEET_PX for one in others)


def _leads_to(
    places: NDArray[np.float64], pieces: NDArray[np.float64], probe: Probe
) -> NDArray[np.bool_]:
    """(n,) whether a piece runs to a place, and begins no further from it than a flight is wide."""
    away = np.hypot(*(pieces - places[:, None]).transpose(2, 0, 1))
    near, far = away.min(axis=1), away.max(axis=1)
    length = np.hypot(*(pieces[:, 1] - pieces[:, 0]).T)
    outside = far + MEET_PX >= length
    return np.asarray(outside & (far < MOST_WIDTH * probe.extent_px) & (near < 0.75 * far))


def _fan(newel: Spot, pieces: NDArray[np.float64], probe: Probe) -> Fan | None:
    """The treads around a place; None where there are too few."""
    way = pieces[:, 1] - pieces[:, 0]
    way = way / np.hypot(*way.T)[:, None]
    to = pieces[:, 0] - newel
    aside = np.abs(to[:, 0] * way[:, 1] - to[:, 1] * way[:, 0])
    away = np.hypot(*(pieces - newel).transpose(2, 0, 1))
    own = (aside < MEET_PX) & _leads_to(np.tile(newel, (len(pieces), 1)), pieces, probe)
    if own.sum() < 2:
        return None
    outer = pieces[own][np.arange(own.sum()), away[own].argmax(axis=1)] - newel
    angles = np.arctan2(outer[:, 1], outer[:, 0])
    most = MOST_WIDTH * probe.extent_px
    gap = GAP * float(away[own].max()) + 2.0
    far = np.array([_reach(newel, angle, most, gap, probe) for angle in angles])
    square = far * np.maximum(np.abs(np.cos(angles)), np.abs(np.sin(angles)))
    best: Fan | None = None
    for radius, is_round in ((float(np.median(square)), False), (float(np.median(far)), True)):
        fan = _about(newel, radius, probe, is_round=is_round)
        if fan is not None and (best is None or fan.score > best.score):
            best = fan
    return best


def _reach(newel: Spot, angle: float, most: float, gap: float, probe: Probe) -> float:
    way = np.array([math.cos(angle), math.sin(angle)])
    return probe.reach(newel, way, most, gap)


def _about(newel: Spot, radius: float, probe: Probe, *, is_round: bool) -> Fan | None:
    """The longest run of directions, evenly apart, that are inked."""
    if radius < LEAST_RADIUS_PX:
        return None
    count = max(360, math.ceil(2.0 * math.pi * radius))
    per = count / (2.0 * math.pi)
    radii = np.arange(RADII[0] * radius, RADII[1] * radius, 1.0)
    ways = _ways(np.arange(count) / per)
    share = probe.at(newel + radii[None, :, None] * ways[:, None]).mean(axis=1)
    widest = (2.0 * probe.line_px + 6.0) / (RADII[0] * radius) * per
    run = _even_run(_from_widest_gap(_peaks(share, widest), count) / per)
    if len(run) - 1 < LEAST_TREADS:
        return None
    going_px = float(run[-1] - run[0]) / (len(run) - 1) * radius / 2.0
    sized = TREAD[0] * probe.extent_px <= going_px <= TREAD[1] * probe.extent_px
    if not sized or _between(share, run * per) > BARE:
        return None
    inked = float(share[np.round(run * per).astype(int) % count].mean())
    if is_round:
        return _rounded(Fan(newel, run, radius, True, inked), probe)
    settled = _settled(run)
    return None if settled is None else Fan(newel, settled, radius, False, inked)


def _from_widest_gap(peaks: NDArray[np.float64], count: int) -> NDArray[np.float64]:
    """Directions from one that has no other for long before it, rising beyond a full turn."""
    if len(peaks) < 2:
        return peaks
    gaps = np.diff(np.append(peaks, peaks[0] + count))
    first = (int(np.argmax(gaps)) + 1) % len(peaks)
    return np.concatenate([peaks[first:], peaks[:first] + count])


def _between(share: NDArray[np.float32], run: NDArray[np.float64]) -> float:
    """How much is inked between treads, away from their edges."""
    places = [
        np.arange(int(a + 0.3 * (b - a)), int(b - 0.3 * (b - a)) + 1) for a, b in pairwise(run)
    ]
    return float(share[np.concatenate(places) % len(share)].mean())


def _rounded(fan: Fan, probe: Probe) -> Fan | None:
    """With the radius at which lines run from tread to tread around it; None without such."""
    if fan.sweep < LEAST_SPIRAL_RAD or fan.sweep > 2.0 * math.pi:
        return None
    tried = np.arange(0.7 * fan.radius_px, 1.25 * fan.radius_px, 1.0)
    share = np.linspace(0.1, 0.9, 12)[:, None]
    ways = _ways(fan.angles)
    chords = np.concatenate([here + share * (there - here) for here, there in pairwise(ways)])
    arcs = chords / np.hypot(*chords.T)[:, None]
    inked = np.array(
        [
            max(probe.at(fan.newel + radius * line).mean() for line in (chords, arcs))
            for radius in tried
        ]
    )
    if inked.max() < INKED:
        return None
    best = tried[inked > 0.97 * inked.max()].mean()
    return replace(fan, radius_px=float(best), score=min(fan.score, float(inked.max())))


def _ways(angles: NDArray[np.float64]) -> NDArray[np.float64]:
    """(n, 2) unit vectors."""
    return np.stack([np.cos(angles), np.sin(angles)], axis=1)


def _peaks(share: NDArray[np.float32], widest: float) -> NDArray[np.float64]:
    """Where the share is high over a narrow angle, as numbers of directions."""
    # No peak is cut in two where directions begin to be counted.
    shift = int(np.argmin(share))
    values = np.roll(share, -shift)
    edges = np.diff(np.pad((values >= INKED).astype(np.int8), 1))
    found = []
    for start, end in zip(np.flatnonzero(edges == 1), np.flatnonzero(edges == -1), strict=True):
        if end - start <= widest:
            weight = values[start:end] - INKED + 0.05
            middle = float(np.average(np.arange(start, end), weights=weight))
            found.append((middle + shift) % len(share))
    return np.sort(np.array(found))


def _even_run(peaks: NDArray[np.float64]) -> NDArray[np.float64]:
    """The longest series of directions that are evenly apart."""
    best: list[float] = []
    gaps = np.diff(peaks)
    for first in range(len(gaps)):
        if not TURN_RAD[0] <= gaps[first] <= TURN_RAD[1]:
            continue
        run = [peaks[first], peaks[first + 1]]
        for number in range(first + 1, len(gaps)):
            usual = (run[-1] - run[0]) / (len(run) - 1)
            if abs(gaps[number] - usual) > max(EVEN * usual, math.radians(4.0)):
                break
            run.append(peaks[number + 1])
        best = run if len(run) > len(best) else best
    return np.array(best)


def _settled(angles: NDArray[np.float64]) -> NDArray[np.float64] | None:
    """A quarter or a half turn between walls begins and ends at right angles to them.

    None where it does not, or where a line beside an end would then be too near or too far for a
    tread: that run is not the stairs.
    """
    quarter = math.pi / 2
    ends = np.round(angles[[0, -1]] / quarter) * quarter
    turns = round((ends[1] - ends[0]) / quarter)
    if turns not in (1, 2) or np.abs(angles[[0, -1]] - ends).max() > SNAP_RAD:
        return None
    settled = np.concatenate([ends[:1], angles[1:-1], ends[1:]])
    gaps = np.diff(settled)
    return settled if TURN_RAD[0] <= gaps.min() and gaps.max() <= TURN_RAD[1] else None
