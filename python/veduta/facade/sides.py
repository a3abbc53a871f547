"""Where the building ends to the left and right, and where the street begins.

The paper takes an image that holds one facade and nothing else. A photo from the street also holds
neighbours, sky beside the house, pavement, and what lies outside of the photo.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.facade.evidence import Evidence, Float, blur_line
from veduta.facade.extent import Skyline, ridge_row
from veduta.run.errors import NotFoundError

_BANDS = 8
_BINS = 64
# Reach of the comparison to each side and least width of a building, as shares of the height.
_REACH = 0.2
_NARROWEST = 0.2
# Chroma steps between two walls that, with a step of the roof line (as a share of the height), tell
# two buildings apart; and chroma steps that do so alone. On 45 pictures of single facades
# neither is reached.
_OTHER_WALL, _OTHER_ROOF = 15.0, 0.033
_SURELY_OTHER_WALL = 25.0
# Where the roof line lies on one level up to a column and on another from there, less is enough if
# the wall changes from top to bottom: the lower quartile of its bands' chroma steps (on 80 pictures
# of single facades at most 6.7 where the levels are so far apart), and how far apart the levels
# are, as a share of the height.
_OTHER_ALL_DOWN, _OTHER_LEVEL = 8.0, 0.06
# Share of a column's rows below the roof line that must be photo, not outside of it.
_SEEN = 0.85
# Vertical edges of the street's rows, as a share of the facade's, and its least height.
_STREET_EDGES = 0.33
_STREET = 0.03
_SMOOTH = 3.0
# Least height and width of what is left, as a share of the picture's height.
_LEAST = 0.1


@dataclass(frozen=True)
class Sides:
    """Columns `left` to `right` and rows up to `bottom` (analysis pixels) hold the facade."""

    left: int
    right: int
    bottom: int
    reasons: tuple[str, ...] = ()


def find_sides(evidence: Evidence, skyline: Skyline) -> Sides:
    """Cut off neighbours, sky and unseen parts at the sides, and the street below."""
    reasons = []
    seen = _seen(evidence, skyline)
    cuts = _cuts(evidence, skyline) & seen
    left, right = _main_part(seen, cuts, round(_NARROWEST * evidence.height))
    if not seen.any():
        reasons.append("sides: no column is mostly building and photo, so all of it is read")
    if left > 0 or right < evidence.width:
        share = 100 * (right - left) / evidence.width
        taken = f"the building takes {share:.0f} % of the picture's width"
        reasons.append(f"sides: {taken}; what is left and right of it was not read")
    bottom = _street(evidence, skyline, left, right)
    if min(bottom - skyline.level, right - left) < _LEAST * evidence.height:
        raise NotFoundError(
            "a facade",
            "next to nothing of the picture is a building that the photo shows",
            "Give a photo in which the whole facade is seen, or its --corners.",
        )
    if bottom < evidence.height:
        share = 100 * bottom / evidence.height
        reasons.append(
            f"ground: the street begins {share:.0f} % down the picture, and was not read"
        )
    return Sides(left, right, bottom, tuple(reasons))


def whole(evidence: Evidence) -> Sides:
    """All of a picture whose borders somebody has named: that is the facade."""
    return Sides(0, evidence.width, evidence.height)


def crop(evidence: Evidence, skyline: Skyline, sides: Sides) -> tuple[Evidence, Skyline]:
    """The part of both that holds the facade; columns then count from `sides.left`."""
    part = np.s_[: sides.bottom, sides.left : sides.right]
    rows = skyline.rows[sides.left : sides.right]
    inner = Evidence(
        evidence.px_per_rectified,
        evidence.lab[part],
        evidence.gx[part],
        evidence.gy[part],
        evidence.valid[part],
    )
    return inner, Skyline(rows, ridge_row(rows, inner.valid), skyline.reason)


def _seen(evidence: Evidence, skyline: Skyline) -> NDArray[np.bool_]:
    """Columns (w,) that hold building and are mostly inside the photo."""
    rows = np.arange(evidence.height)[:, None]
    below = rows >= np.maximum(skyline.rows, skyline.level)[None]
    share = (evidence.valid & below).sum(0) / np.maximum(below.sum(0), 1)
    return np.asarray((share >= _SEEN) & (skyline.rows < 0.45 * evidence.height), bool)


def _cuts(evidence: Evidence, skyline: Skyline) -> NDArray[np.bool_]:
    """Columns (w,) at which one building ends and another begins are False."""
    reach = max(3, round(_REACH * evidence.height))
    bands = _wall_steps(evidence, skyline, reach)
    # A shop or a shadow does not end a building.
    wall = np.median(bands, axis=0)
    roof = np.abs(_steps(skyline.rows[None].astype(np.float64), reach)[0])
    # The step of the roof line may lie a little beside the change of the wall.
    roof = cv2.dilate(roof.reshape(1, -1), np.ones((1, reach // 2 * 2 + 1))).ravel()
    both = np.minimum(wall / _OTHER_WALL, roof / (_OTHER_ROOF * evidence.height))
    levels = two_levels(skyline.rows, evidence.valid, reach) / (_OTHER_LEVEL * evidence.height)
    all_down = np.minimum(np.percentile(bands, 25, axis=0) / _OTHER_ALL_DOWN, levels)
    keep = np.ones(evidence.width, bool)
    # One after the other: where the levels part, the steps of wall and roof may peak elsewhere.
    for apart in (np.maximum(both, wall / _SURELY_OTHER_WALL), all_down):
        # Too little to compare is left beside the edges of the picture.
        apart[: reach // 4] = apart[-(reach // 4) :] = 0.0
        # The border is where the wall changes most; what parts it may peak a little beside that.
        apart[wall < cv2.dilate(wall.reshape(1, -1), np.ones((1, 7))).ravel()] = 0.0
        for x in np.flatnonzero(apart > 1):
            near = slice(max(0, x - reach), x + reach + 1)
            if apart[x] >= apart[near].max() and keep[near].all():
                keep[x] = False
    return keep


def _steps(values: NDArray[np.float64], reach: int) -> NDArray[np.float64]:
    """Median of the `reach` columns to the right minus that of those to the left, (k, w)."""
    padded = np.pad(values, ((0, 0), (reach, reach)), mode="edge")
    windows = np.lib.stride_tricks.sliding_window_view(padded, reach, axis=1)
    middle = np.median(windows, axis=-1)
    return np.asarray(middle[:, reach : reach + values.shape[1]] - middle[:, : values.shape[1]])


def two_levels(
    rows: NDArray[np.int64], valid: NDArray[np.bool_], reach: int
) -> NDArray[np.float64]:
    """How many rows part the roof line left of each column from that to the right (w,).

    Rows (w,) on either side within `reach` are wholly above those of the other side, but for a
    tenth of them: so chimneys, dormers and gables part nothing. Where the photo (`valid`, (h, w))
    ends before the sky the roof may be at any height above, so no such column is the lower one.
    """
    lower = np.where(rows > valid.argmax(0) + 1, rows, 0)
    top, foot = _running(rows, reach, 90), _running(lower, reach, 10)
    # Windows are counted by their first column: those that end before a column, and from it on.
    count = len(rows)
    right_lower = foot[reach:][:count] - top[:count]
    left_lower = foot[:count] - top[reach:][:count]
    return np.asarray(np.maximum(0.0, np.maximum(right_lower, left_lower)), np.float64)


def _running(rows: NDArray[np.int64], reach: int, share: int) -> NDArray[np.float64]:
    """Percentile of each `reach` columns, the outermost repeated outwards (w + reach + 1,)."""
    padded = np.pad(rows, reach, mode="edge")
    windows = np.lib.stride_tricks.sliding_window_view(padded, reach)
    return np.asarray(np.percentile(windows, share, axis=1), np.float64)


def _wall_steps(evidence: Evidence, skyline: Skyline, reach: int) -> NDArray[np.float64]:
    """How far the wall to the left of each column is from that to the right, chroma steps.

    The earth mover's distance between the chroma of the plain pixels within `reach` on either
    side, as for roof and wall, (bands, w) in bands of rows from the ridge down.
    """
    plain = (np.abs(evidence.gx) < _SMOOTH) & (np.abs(evidence.gy) < _SMOOTH) & evidence.valid
    edges = np.linspace(skyline.level, evidence.height, _BANDS + 1).astype(int)
    steps = np.zeros((_BANDS, evidence.width))
    for band, (top, bottom) in enumerate(pairwise(edges)):
        for channel in (1, 2):
            values = evidence.lab[top:bottom, :, channel]
            counts = _column_histograms(values, plain[top:bottom])
            left, right = _both_sides(counts, reach)
            known = np.minimum(left.sum(-1), right.sum(-1)) > 0.1 * reach * (bottom - top)
            moved = np.abs(_share(left) - _share(right)).sum(-1) * (256 / _BINS)
            steps[band] += 1.5 * np.where(known, moved, 0.0)
    return steps


def _column_histograms(values: Float, plain: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Histograms (w, bins) of the plain pixels of each column."""
    width = values.shape[1]
    bins = np.clip(values / 256 * _BINS, 0, _BINS - 1).astype(np.int64)
    flat = (np.arange(width) * _BINS + bins)[plain]
    return np.bincount(flat, minlength=width * _BINS).reshape(width, _BINS).astype(np.float64)


def _both_sides(
    counts: NDArray[np.float64], reach: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Sums (w, bins) over the `reach` columns before each column, and over those from it on."""
    width = len(counts)
    running = np.zeros((width + 1, counts.shape[1]))
    np.cumsum(counts, axis=0, out=running[1:])
    at = np.arange(width)
    return (
        running[at] - running[np.maximum(at - reach, 0)],
        running[np.minimum(at + reach, width)] - running[at],
    )


def _share(counts: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.asarray(np.cumsum(counts, -1) / np.maximum(counts.sum(-1, keepdims=True), 1))


def _main_part(seen: NDArray[np.bool_], keep: NDArray[np.bool_], narrowest: int) -> tuple[int, int]:
    """The widest run of columns without a cut; one about the middle counts twice."""
    width = len(seen)
    inside = seen & keep
    if not inside.any():
        return 0, width
    ends = np.flatnonzero(np.diff(np.concatenate([[0], inside.astype(int), [0]])))
    runs = [(int(a), int(b)) for a, b in ends.reshape(-1, 2)]
    best = max(runs, key=lambda r: (r[1] - r[0]) * (2 if r[0] <= width // 2 < r[1] else 1))
    if best[1] - best[0] < narrowest:
        return 0, width
    # A sliver beside the picture's edge is not a neighbour.
    sliver = narrowest // 8
    left = 0 if best[0] <= sliver and seen[: best[0]].all() else best[0]
    right = width if best[1] >= width - sliver and seen[best[1] :].all() else best[1]
    return left, right


def _street(evidence: Evidence, skyline: Skyline, left: int, right: int) -> int:
    """Row at which the street begins: from there down hardly anything stands upright."""
    part = np.s_[:, left:right]
    valid = evidence.valid[part]
    share = np.maximum(valid.sum(1), 1)
    upright = blur_line((np.abs(evidence.gx[part]) * valid).sum(1) / share, 0.004 * evidence.height)
    usual = float(np.median(upright[skyline.level :]))
    low = (upright < _STREET_EDGES * usual) | (valid.sum(1) < 0.5 * (right - left))
    row = evidence.height
    while row > 0 and low[row - 1]:
        row -= 1
    return row if evidence.height - row >= _STREET * evidence.height else evidence.height
