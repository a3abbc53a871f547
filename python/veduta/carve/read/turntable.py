"""`--turntable`: how far an object has turned in each photo of one camera, from its silhouettes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from veduta.carve.read.turning import (
    Floats,
    Mask,
    Misses,
    Outlines,
    Table,
    held,
    misses,
    outlines_of,
)
from veduta.run.errors import InputError, NotFoundError
from veduta.run.progress import StepProgress, no_progress

GLOBALS = 4
"""Numbers of a table besides its angles: log focal length, tilt, roll, aside."""


@dataclass(frozen=True)
class TurntableRule:
    """How the angles are looked for.

    largest_px: the photos' larger side while looking. points: on each outline. coarse_px,
    coarse_photos, coarse_points: the same where one looks where to start. tilts_deg: of the camera,
    to start with; rolls_deg: a camera may lie on its side. kept_starts: of all, that are followed.
    rounds: of least squares at most. robust_px: from where a miss counts less. still: of two
    silhouettes' union, below which their difference is nothing. most_cut: share of the photos
    that may cut the object. unsure_deg: a deviation of an angle
    beyond which nothing is known. poor_px: misses (root mean square, px of the photos looked at)
    beyond which this was no turntable. uneven_px: the same beyond which turns that were taken as
    even may not be: true ones leave 0.5 px, ones that are 4.5 degrees off 1.5 px and more.
    """

    largest_px: int = 480
    points: int = 48
    coarse_px: int = 240
    coarse_photos: int = 12
    coarse_points: int = 24
    tilts_deg: tuple[float, ...] = (3.0, 15.0, 35.0, 60.0)
    rolls_deg: tuple[float, ...] = (0.0, 90.0, -90.0)
    kept_starts: int = 4
    rounds: int = 40
    robust_px: float = 2.0
    still: float = 0.01
    most_cut: float = 0.34
    unsure_deg: float = 10.0
    poor_px: float = 4.0
    uneven_px: float = 1.0


@dataclass(frozen=True)
class Focal:
    """A camera's focal length (px), and by what share it may be wrong (of its logarithm)."""

    px: float
    share: float


@dataclass(frozen=True, eq=False)
class Found:
    """table: of photos at full size. deviations: (n,) rad, how sure each angle is; NaN where they
    were taken as even, not found. miss_px: root mean square of what the outlines' rays miss, px at
    full size.
    """

    table: Table
    deviations: Floats
    miss_px: float


def find_turns(
    masks: Sequence[Mask],
    focal: Focal,
    *,
    even: bool = False,
    rule: TurntableRule | None = None,
    progress: StepProgress = no_progress,
) -> Found:
    """The table of silhouettes (h, w) whose object turns by a part of one turn each time.

    even: by the same part each time, and once round. InputError where the photos cannot be of one
    camera, or cut the object; NotFoundError where they do not say how far it turned.
    """
    rule = rule or TurntableRule()
    _refuse(masks, rule, even=even)
    start = _start(masks, focal, rule, progress, even=even)
    lines, factor = outlines_of(masks, rule.points, rule.largest_px)
    table = replace(start, focal_px=start.focal_px * factor)
    fit = _Fit(lines, table, Focal(focal.px * factor, focal.share), rule, even=even)
    fit.run(rule.rounds, lambda share: progress("turntable", 0.5 + 0.5 * share))
    found = Found(
        replace(fit.table, focal_px=fit.table.focal_px / factor),
        fit.deviations(),
        fit.miss_px() / factor,
    )
    _refuse_unsure(found, fit.miss_px(), rule)
    return found


def seem_uneven(found: Found, size: tuple[int, int], rule: TurntableRule | None = None) -> bool:
    """Whether turns that were taken as even leave the outlines further apart than rounding does.

    size: of the photos (px).
    """
    rule = rule or TurntableRule()
    factor = min(1.0, rule.largest_px / max(size))
    return bool(np.isnan(found.deviations).all()) and found.miss_px * factor > rule.uneven_px


def _refuse(masks: Sequence[Mask], rule: TurntableRule, *, even: bool) -> None:
    if len({mask.shape for mask in masks}) > 1:
        fault = "the photos have several sizes, but a turntable has one camera"
        raise InputError("--turntable", fault, "Give the photos of one camera, uncropped.")
    cut = [
        mask[0].any() or mask[-1].any() or mask[:, 0].any() or mask[:, -1].any() for mask in masks
    ]
    if sum(cut) > rule.most_cut * len(masks):
        fault = f"the object leaves {sum(cut)} of {len(masks)} photos"
        raise InputError("--turntable", fault, "Give photos that show all of it.")
    some = masks[:: max(1, len(masks) // 6)]
    changes = [
        float((one ^ other).sum()) / max(float((one | other).sum()), 1.0)
        for one in some
        for other in some
    ]
    if max(changes) < rule.still and not even:
        raise NotFoundError(
            "how far the object turned",
            f"its silhouettes differ by {max(changes):.1%} at most: it stands still, or is as round"
            " as a vase",
            "Add --even-turns where the turns are the same, or put it on a printed marker board"
            " (--board).",
        )


def _refuse_unsure(found: Found, miss_px: float, rule: TurntableRule) -> None:
    remedy = (
        "Check that the camera stood still, and that the photos' names are in the order in which"
        " the object turned once round; or put it on a printed marker board (--board)."
    )
    if miss_px > rule.poor_px:
        reason = f"its outlines miss each other by {found.miss_px:.1f} px under the best angles"
        raise NotFoundError("how far the object turned", reason, remedy)
    unsure = float(np.degrees(found.deviations.max()))
    if unsure > rule.unsure_deg:
        reason = f"its silhouettes leave an angle open by {unsure:.0f} degrees"
        raise NotFoundError("how far the object turned", reason, remedy)


def _start(
    masks: Sequence[Mask], focal: Focal, rule: TurntableRule, progress: StepProgress, *, even: bool
) -> Table:
    """The best of several tilts, rolls and directions, photos evenly round one turn at first."""
    count = len(masks)
    chosen = np.unique(
        np.linspace(0, count - 1, min(count, rule.coarse_photos)).round().astype(int)
    )
    lines, factor = outlines_of([masks[n] for n in chosen], rule.coarse_points, rule.coarse_px)
    small = Focal(focal.px * factor, focal.share)
    round_once = 2.0 * np.pi * np.arange(count + 1) / count
    tried: list[tuple[float, int, Table]] = []
    starts = 2 * len(rule.tilts_deg) * len(rule.rolls_deg)
    for roll in np.radians(rule.rolls_deg):
        aside = _aside(lines, float(roll)) / small.px
        for tilt in np.radians(rule.tilts_deg):
            for sign in (1.0, -1.0):
                angles = sign * round_once[chosen]
                one = Table(small.px, float(tilt), float(roll), aside, angles)
                tried.append((_cost(misses(one, lines, 32, 1).miss_px, rule), len(tried), one))
                progress("turntable", 0.1 * len(tried) / starts)
    followed: list[tuple[float, int, Table]] = []

    def told(fits: int, share: float) -> None:
        progress("turntable", 0.1 + 0.4 * (fits + share) / rule.kept_starts)

    for _, number, one in sorted(tried, key=lambda one: one[:2])[: rule.kept_starts]:
        fit = _Fit(lines, one, small, rule, even=even)
        fit.run(rule.rounds // 2, partial(told, len(followed)))
        followed.append((fit.cost, number, fit.table))
        told(len(followed), 0.0)
    best = min(followed, key=lambda one: one[:2])[2]
    # The photos between those that were looked at: evenly between them.
    direction = float(np.sign(best.angles[-1]))
    known, angles = round_once[chosen], best.angles
    last = angles[-1] + direction * (round_once[-1] - known[-1])
    between = np.interp(round_once[:-1], [*known, round_once[-1]], [*angles, last])
    return replace(best, focal_px=best.focal_px / factor, angles=between)


def _aside(lines: Outlines, roll: float) -> float:
    """Px from the photo's middle to the axis: the middle of all outlines, across the axis."""
    across = lines.points @ np.array([np.cos(roll), np.sin(roll)])
    return float((across.min() + across.max()) / 2.0)


def _cost(miss: Floats, rule: TurntableRule) -> float:
    over = np.maximum(miss, 0.0) / rule.robust_px
    return float(np.log1p(np.square(over)).mean())


class _Fit:
    """Least squares over a table, by Levenberg and Marquardt."""

    def __init__(
        self, lines: Outlines, table: Table, focal: Focal, rule: TurntableRule, *, even: bool
    ) -> None:
        self.lines, self.table, self.focal, self.rule = lines, table, focal, rule
        self.free = GLOBALS if even else GLOBALS + len(table.angles) - 1
        self.found = misses(table, lines)
        self.cost = self._cost_of(table, self.found)
        self.damping = 1e-2

    def run(self, rounds: int, tell: Callable[[float], None] = lambda _: None) -> None:
        """Until nothing gets better."""
        for number in range(rounds):
            before = self.cost
            if not self._step() or before - self.cost < 1e-4 * before:
                break
            tell((number + 1) / rounds)

    def miss_px(self) -> float:
        """Root mean square of the misses."""
        return float(np.sqrt(np.square(np.maximum(self.found.miss_px, 0.0)).mean()))

    def deviations(self) -> Floats:
        """(n,) rad of the angles, the first of which is 0 by choice; NaN where they are even."""
        if self.free == GLOBALS:
            return np.full(len(self.table.angles), np.nan)
        # A ray that comes just within would miss if its photo turned: it holds the angle, too.
        near = self.found.miss_px > -1.0
        slopes = self._slopes()
        normal = slopes.T @ (slopes * (0.5 * near)[:, None])
        spread = np.linalg.pinv(normal, hermitian=True)
        noise = max(self.miss_px(), 0.3)
        own = np.sqrt(np.maximum(np.diag(spread)[GLOBALS:], 0.0)) * noise
        return np.concatenate([[0.0], own])

    def _cost_of(self, table: Table, found: Misses) -> float:
        return _cost(found.miss_px, self.rule) + self._prior(table) ** 2 / len(self.lines.of)

    def _prior(self, table: Table) -> float:
        return float(np.log(table.focal_px / self.focal.px)) / self.focal.share

    def _step(self) -> bool:
        normal, right = self._normal()
        for _ in range(6):
            damped = normal + self.damping * np.diag(np.diag(normal) + 1e-6 * np.trace(normal))
            step = np.zeros(GLOBALS + len(self.table.angles) - 1)
            step[: self.free] = np.linalg.solve(damped, -right)
            moved = _moved(self.table, step)
            found = misses(moved, self.lines)
            cost = self._cost_of(moved, found)
            if cost < self.cost:
                self.table, self.found, self.cost = moved, found, cost
                self.damping = max(self.damping / 4.0, 1e-6)
                return True
            self.damping *= 5.0
        return False

    def _normal(self) -> tuple[Floats, Floats]:
        """The normal equations about the table as it is."""
        miss = np.maximum(self.found.miss_px, 0.0)
        counts = (miss > 0.0) / (1.0 + np.square(miss / self.rule.robust_px))
        slopes = self._slopes()[:, : self.free]
        normal = slopes.T @ (slopes * counts[:, None])
        right = slopes.T @ (counts * miss)
        scale = self.rule.robust_px**2
        normal[0, 0] += scale / self.focal.share**2
        right[0] += scale * self._prior(self.table) / self.focal.share
        return normal, right

    def _slopes(self) -> Floats:
        """(m, 4 + n - 1) how the misses change with each number, while the same silhouettes hold
        the rays off.
        """
        table, lines, found = self.table, self.lines, self.found
        count = len(table.angles)
        slopes = np.zeros((len(lines.of), GLOBALS + count))
        rows = np.arange(len(lines.of))
        small = 1e-3
        for which in range(2):
            weight = found.weights[:, which]
            for number in range(GLOBALS):
                one = np.zeros(GLOBALS + count - 1)
                one[number] = small
                more = held(_moved(table, one), lines, found, which)
                less = held(_moved(table, -one), lines, found, which)
                slopes[:, number] += weight * (more - less) / (2.0 * small)
            more = held(table, lines, found, which, small)
            less = held(table, lines, found, which, -small)
            turned = weight * (more - less) / (2.0 * small)
            np.add.at(slopes, (rows, GLOBALS + found.photos[:, which]), turned)
            np.add.at(slopes, (rows, GLOBALS + lines.of), -turned)
        return np.delete(slopes, GLOBALS, axis=1)


def _moved(table: Table, step: NDArray[np.float64]) -> Table:
    """The table with a step of all its numbers taken; the first angle stays."""
    return Table(
        table.focal_px * float(np.exp(np.clip(step[0], -0.5, 0.5))),
        table.tilt + float(step[1]),
        table.roll + float(step[2]),
        table.aside + float(step[3]),
        table.angles + np.concatenate([[0.0], step[GLOBALS:]]),
    )
