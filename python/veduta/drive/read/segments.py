"""The driven path in quasi-linear pieces, to both sides (section 3.1)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage
from scipy.spatial import cKDTree

from veduta.drive.document.model import DriveSegment

_GAP_COLUMNS = 9
SIDES: tuple[Literal["left"], Literal["right"]] = ("left", "right")


@dataclass(frozen=True)
class SegmentParameters:
    """Thresholds of the cuts.

    still_m: a sweep so near to the last one is of a stop: one is kept. heading_m: the heading is
    that of a stretch so long. deep_m: the critical distance ds / sin(dtheta) must exceed this, the
    usual depth of facades. shortest_m: shorter pieces are left out. longest_m: longer ones are cut
    (100 m in the paper), within `search_m` of their middle, where the fewest points are above
    street level. again_m, again_rad, again_share: a piece so near to an earlier one, in its
    direction, over so much of its length is another pass.
    """

    still_m: float = 0.15
    heading_m: float = 2.0
    deep_m: float = 18.0
    outer_m: float = 8.0
    """Radius of a turn away from the facade below which a piece is not quasi-linear either."""
    shortest_m: float = 4.0
    longest_m: float = 100.0
    search_m: float = 20.0
    again_m: float = 4.0
    again_rad: float = 0.5
    again_share: float = 0.7


def driven_line(
    path: NDArray[np.float64],
    spacing_m: float,
    ahead_m: float,
    parameters: SegmentParameters | None = None,
) -> NDArray[np.float64]:
    """(c, 3) equally spaced positions along a path (s, 3), straight on by `ahead_m` at its end.

    Full scans look ahead: beyond the end of the path a street was seen as well.
    """
    chosen = parameters or SegmentParameters()
    kept = [0]
    for row in range(1, len(path)):
        if np.linalg.norm(path[row, :2] - path[kept[-1], :2]) > chosen.still_m:
            kept.append(row)
    moved = path[kept]
    if len(moved) < 2:
        return moved[:1]
    heading = moved[-1] - moved[max(len(moved) - 4, 0)]
    heading = heading / np.linalg.norm(heading)
    if ahead_m > 0.0:
        end = moved[-1] + ahead_m * np.array([heading[0], heading[1], 0.0])
        moved = np.vstack([moved, end])
    station = np.concatenate(
        [[0.0], np.cumsum(np.linalg.norm(np.diff(moved[:, :2], axis=0), axis=1))]
    )
    at = np.arange(0.0, station[-1], spacing_m)
    line = np.stack([np.interp(at, station, moved[:, axis]) for axis in range(3)], axis=1)
    return _smooth(line, chosen.heading_m / 2.0 / spacing_m)


def _smooth(line: NDArray[np.float64], sigma: float) -> NDArray[np.float64]:
    """A Gaussian mean along a line that goes on straight beyond its ends."""
    pad = min(int(np.ceil(4 * sigma)), len(line) - 1)
    before, after = 2 * line[0] - line[pad:0:-1], 2 * line[-1] - line[-2 : -pad - 2 : -1]
    longer = np.concatenate([before, line, after])
    smooth = ndimage.gaussian_filter1d(longer, sigma, axis=0, mode="nearest")
    return np.asarray(smooth[pad : pad + len(line)], dtype=np.float64)


def cut_segments(
    line: NDArray[np.float64],
    spacing_m: float,
    counts: NDArray[np.int64] | None = None,
    parameters: SegmentParameters | None = None,
) -> list[DriveSegment]:
    """Pieces of a line (c, 3) to both sides. counts: (c,) scan points above street level."""
    chosen = parameters or SegmentParameters()
    step = np.gradient(line[:, :2], axis=0)
    heading = np.unwrap(np.arctan2(step[:, 1], step[:, 0]))
    turn = np.gradient(heading) / spacing_m
    found: list[DriveSegment] = []
    for side in SIDES:
        towards = turn if side == "left" else -turn
        # ds / sin(dtheta) for a small turn is 1 over the turn per metre.
        straight = (towards < 1.0 / chosen.deep_m) & (towards > -1.0 / chosen.outer_m)
        label, _ = ndimage.label(straight)
        for piece in ndimage.find_objects(label):
            first, last = piece[0].start, piece[0].stop
            for begin, end, why in _cut_long(first, last, spacing_m, counts, chosen):
                found.append(_segment(side, line, begin, end, len(found), why, spacing_m, chosen))
    return _without_repeats(found, chosen)


def _cut_long(
    first: int,
    last: int,
    spacing_m: float,
    counts: NDArray[np.int64] | None,
    chosen: SegmentParameters,
) -> list[tuple[int, int, str]]:
    if (last - first) * spacing_m <= chosen.longest_m:
        return [(first, last, "between two turns, or the ends of the path")]
    middle = (first + last) // 2
    reach = int(chosen.search_m / spacing_m)
    low, high = max(middle - reach, first + 1), min(middle + reach, last - 1)
    if counts is None:
        cut, why = middle, "cut in its middle: longer than 100 m"
    else:
        # Single scans miss: the mean of a few metres tells a gap.
        mean = ndimage.uniform_filter1d(counts[low:high].astype(float), _GAP_COLUMNS)
        cut = low + int(np.argmin(mean))
        why = "cut where the fewest points stand above the street: longer than 100 m"
    halves = _cut_long(first, cut, spacing_m, counts, chosen)
    halves += _cut_long(cut, last, spacing_m, counts, chosen)
    return [(begin, end, why) for begin, end, _ in halves]


def _segment(
    side: Literal["left", "right"],
    line: NDArray[np.float64],
    begin: int,
    end: int,
    number: int,
    why: str,
    spacing_m: float,
    chosen: SegmentParameters,
) -> DriveSegment:
    length = (end - begin) * spacing_m
    short = length < chosen.shortest_m or end - begin < 2
    points = line[begin : max(end, begin + 2)]
    return DriveSegment(
        id=f"{side}-{number + 1:03d}",
        side=side,
        line=[(round(x, 4), round(y, 4), round(z, 4)) for x, y, z in points.tolist()],
        fate="leave-out" if short else "build",
        reason=f"only {length:.1f} m long" if short else why,
    )


def _without_repeats(segments: list[DriveSegment], chosen: SegmentParameters) -> list[DriveSegment]:
    """Of several passes of one street side the longest is kept; of equal ones the first."""
    by_length = sorted(range(len(segments)), key=lambda row: -len(segments[row].line))
    kept: list[tuple[str, NDArray[np.float64], NDArray[np.float64]]] = []
    found = list(segments)
    for row in by_length:
        segment = segments[row]
        if segment.fate != "build":
            continue
        flat = np.array(segment.line)[:, :2]
        along = np.gradient(flat, axis=0)
        along /= np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-9)
        away = np.stack([-along[:, 1], along[:, 0]], axis=1)
        away *= 1.0 if segment.side == "left" else -1.0
        again = next((name for name, *other in kept if _passes(flat, away, other, chosen)), None)
        if again is None:
            kept.append((segment.id, flat, away))
        else:
            told = {"fate": "leave-out", "reason": f"another pass of {again}"}
            found[row] = segment.model_copy(update=told)
    return found


def _passes(
    flat: NDArray[np.float64],
    away: NDArray[np.float64],
    other: list[NDArray[np.float64]],
    chosen: SegmentParameters,
) -> bool:
    """Whether a piece (n, 2), looked at outwards (n, 2), goes along another one."""
    place, direction = other
    distance, nearest = cKDTree(place).query(flat)
    alike = (direction[nearest] * away).sum(axis=1) > np.cos(chosen.again_rad)
    share = ((distance < chosen.again_m) & alike).mean()
    return bool(share > chosen.again_share)
