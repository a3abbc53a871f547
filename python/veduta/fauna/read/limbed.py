"""An animal with limbs in silhouettes: its cycle, its figure in every frame, the parts it has."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from veduta.fauna.document.plan import BodyPlan
from veduta.fauna.motion.figure import Floats, figure_of
from veduta.fauna.read.basis import Basis, FitLooks, cycle_basis, spline_basis
from veduta.fauna.read.fit import Fit, Fitted
from veduta.fauna.read.laid_on import Shown
from veduta.fauna.read.nearer import Nearer
from veduta.fauna.read.sides import sides_told
from veduta.fauna.read.silhouettes import Masks
from veduta.fauna.read.starts import Start, StartLooks, best_start, legs_together
from veduta.fauna.read.travel import travelled
from veduta.fauna.read.windows import Windows, middles_of, repeat_of, windows_of


@dataclass(frozen=True)
class LimbedLooks:
    """The stages of a fit."""

    coarse_cells: int = 48
    fine_cells: int = 88
    soft: tuple[float, ...] = (0.025, 0.012)
    """Edges of the soft silhouettes, in lengths: from coarse to fine."""
    steps: tuple[int, ...] = (40, 60)
    start_harmonics: int = 2
    """With more of them legs hide in the body at first, and stay there."""
    cycle_tries: tuple[float, ...] = (0.97, 1.0, 1.03)
    """Of the cycle that was found; the best is between them."""
    gain: float = 0.004
    """An optional part is kept where the loss falls by this share."""
    travels: float = 0.25
    """An animal that moves over the ground by so many of its silhouettes' widths looks there."""
    fit: FitLooks = field(default_factory=FitLooks)
    start: StartLooks = field(default_factory=StartLooks)


@dataclass(frozen=True, eq=False)
class LimbedSeen:
    """fitted: the figure in the frames. windows: what it was fitted to. cycle: frames of a stride,
    None: none was found. cycle_score: how well silhouettes repeat, 0..1. missing: optional parts
    that the silhouettes do not show. frames: (t,) their numbers. nearer: what the pictures told of
    near and far legs, pair by pair.
    """

    fitted: Fitted
    frames: Floats
    windows: Windows
    cycle: float | None
    cycle_score: float
    missing: tuple[str, ...]
    nearer: tuple[Nearer, ...] = ()


def fit_limbed(
    masks: Masks, frames: NDArray[np.int64], plan: BodyPlan, looks: LimbedLooks,
    heard: Callable[[], None], pins: Mapping[str, Floats] | None = None,
    pictures: NDArray[np.uint8] | None = None, trust: Mapping[str, Floats] | None = None,
    shown: Shown | None = None, ways: Floats | None = None,
) -> LimbedSeen:  # fmt: skip
    """The figure of a plan in silhouettes (t, h, w) of the numbered frames.

    pins: (t, 2) px by joint, where somebody has marked it; NaN elsewhere. trust: (t,) by joint, how
    much each mark counts, if not 1. shown: of each frame that cuts the animal (h, w) what it shows,
    None of the others. ways: (t,) of an animal that turns round, 1 where it looks to the right, -1
    to the left. pictures: (t, h, w, 3) of the frames: they tell near legs from far ones, and how
    the ground goes by.
    """
    optional = {part.name for part in plan.parts if part.optional}
    number = frames.astype(np.float64)
    middle = middles_of(masks, shown)
    coarse = windows_of(masks, looks.coarse_cells, middle, shown).marked(pins or {}, trust or {})
    if ways is not None:
        coarse = coarse.turned_where(ways)
    top = plan.view == "top"
    repeats = repeat_of(coarse, top=top)
    cycle, score = None, 0.0
    if repeats is not None:
        # Of a symmetrical gait silhouettes look the same after half a cycle, but from above.
        step = float(np.median(np.diff(number)))
        cycle, score = (1.0 if top else 2.0) * repeats[0] * step, repeats[1]
    basis = _basis(number, cycle, looks.fit, looks.start_harmonics)
    figure = figure_of(plan, optional)
    tried = _ways(travelled(masks, middle, pictures)) if ways is None else (1.0,)
    start = best_start(figure, coarse, number, basis, looks.fit, looks.start, tried, heard)
    if cycle is not None:
        start, cycle = _with_cycle(start, number, cycle, looks, heard)
    fine = windows_of(masks, looks.fine_cells, middle, shown).marked(pins or {}, trust or {})
    if ways is not None:
        fine = fine.turned_where(ways)
    if start.fit.windows.faces < 0.0:
        fine = fine.mirrored()
    if cycle is not None:
        start = legs_together(start, fine, looks.start, heard)
    fit = Fit(figure, fine, start.fit.basis, looks.fit, number)
    numbers, scale = start.numbers, start.px_per_length
    for soft, steps in zip(looks.soft, looks.steps, strict=True):
        numbers, _ = fit.improve(numbers, scale, soft, steps, heard)
    fit, numbers, missing = _grown(fit, numbers, scale, plan, looks, heard)
    fitted = fit.fitted(numbers, scale, looks.soft[-1])
    sided, nearer = sides_told(fit, numbers, fitted, pictures)
    if sided is not numbers:
        fitted = fit.fitted(sided, scale, looks.soft[-1])
    return LimbedSeen(fitted, number, fine, cycle, score, missing, nearer)


def _basis(
    frames: Floats, cycle: float | None, looks: FitLooks, harmonics: int | None = None
) -> Basis:
    if cycle is None:
        return spline_basis(frames, looks)
    return cycle_basis(frames, cycle, looks, harmonics)


def _ways(gone: float) -> tuple[float, ...]:
    """Which ways it may look: where it goes, if it does."""
    return (float(np.sign(gone)),) if abs(gone) > LimbedLooks().travels else (1.0, -1.0)


def _with_cycle(
    start: Start, frames: Floats, cycle: float, looks: LimbedLooks, heard: Callable[[], None]
) -> tuple[Start, float]:
    """The fit with the cycle at which its loss is least: a parabola through three tries."""
    losses = []
    for share in looks.cycle_tries:
        fit = Fit(
            start.fit.figure, start.fit.windows,
            cycle_basis(frames, cycle * share, looks.fit, looks.start_harmonics), looks.fit, frames,
        )  # fmt: skip
        _, loss = fit.improve(
            start.numbers, start.px_per_length, looks.start.soft, looks.start.steps, heard
        )
        losses.append(loss)
    fine = np.linspace(looks.cycle_tries[0] - 0.02, looks.cycle_tries[-1] + 0.02, 141)
    curve = np.polyval(np.polyfit(looks.cycle_tries, losses, 2), fine)
    best = cycle * float(fine[int(curve.argmin())])
    fit = Fit(
        start.fit.figure, start.fit.windows, cycle_basis(frames, best, looks.fit), looks.fit, frames
    )
    numbers = start.fit.moved_to(fit, start.numbers)
    numbers, loss = fit.improve(
        numbers, start.px_per_length, looks.start.soft, looks.start.steps, heard
    )
    return Start(fit, numbers, start.px_per_length, loss), best


def _grown(
    fit: Fit, numbers: Floats, scale: float, plan: BodyPlan, looks: LimbedLooks,
    heard: Callable[[], None],
) -> tuple[Fit, Floats, tuple[str, ...]]:  # fmt: skip
    """With the optional parts that the silhouettes show."""
    soft = looks.soft[-1]
    missing = [part.name for part in plan.parts if part.optional]
    before = float(fit.loss(numbers, scale, soft)[2].mean())
    for name in tuple(missing):
        rest = [other for other in missing if other != name]
        larger = Fit(figure_of(plan, rest), fit.windows, fit.basis, fit.looks, fit.frames)
        begun = fit.moved_to(larger, numbers)
        tried, _ = larger.improve(begun, scale, soft, 12, heard)
        # What the rest of the figure gains by more steps is no gain of the part.
        alone, _ = fit.improve(numbers, scale, soft, 12, heard)
        base = float(fit.loss(alone, scale, soft)[2].mean())
        after = float(larger.loss(tried, scale, soft)[2].mean())
        if after < base * (1.0 - looks.gain):
            fit, numbers, before, missing = larger, tried, after, rest
        elif base < before:
            numbers, before = alone, base
    return fit, numbers, tuple(missing)
