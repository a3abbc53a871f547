"""Where a fit begins: which way the animal looks, and where in its stride each pair of legs is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import islice, product

import numpy as np
from numpy.typing import NDArray

from veduta.fauna.motion.figure import Figure, Floats, Limb, posed
from veduta.fauna.read.basis import Basis, FitLooks
from veduta.fauna.read.drawn import drawn_figure
from veduta.fauna.read.fit import Fit
from veduta.fauna.read.windows import Windows


@dataclass(frozen=True)
class StartLooks:
    """What is tried."""

    phases: int = 4
    """Of half a stride, for the front and for the hind legs each."""
    steps: int = 12
    soft: float = 0.04
    """Edge of the soft silhouette, in lengths."""
    frames: int = 12
    """In which starts are compared."""
    best: int = 4
    """So many starts are tried with the tail held otherwise."""
    tail_turns_rad: tuple[float, ...] = (-0.8, -0.4, 0.0, 0.5, 1.0)
    more_steps: int = 40
    again_steps: int = 15
    """Of legs that are begun anew."""
    choices: int = 64
    """Of phases of all pairs of legs, at most: of seven pairs and more the first ones."""
    together: int = 3
    """So many of them go on, with edges so sharp, for so many steps each."""
    sharper: tuple[float, ...] = (0.025, 0.012)
    sharper_steps: int = 20
    gain: float = 0.005
    """They are kept where the loss is less by this share."""
    stride_rad: float = 0.4
    """How far a leg swings at first."""
    bend_rad: float = 0.35


@dataclass(frozen=True, eq=False)
class Start:
    """A fit and its numbers, the windows as it looks at them, and the scale of its lengths."""

    fit: Fit
    numbers: Floats
    px_per_length: float
    loss: float


def scale_of(figure: Figure, windows: Windows) -> float:
    """Pixels in a length: the figure at rest covers as much as the silhouettes do."""
    joints = posed(figure, np.zeros((1, 2)), figure.rest[None], figure.length, figure.apart).joints[
        0
    ]
    cells = 200.0
    flipped = (joints - joints.mean(axis=0)) * np.array([1.0, -1.0]) * cells + 300.0
    covers = drawn_figure(figure, flipped, figure.deep * cells, (600, 600)).sum() / cells**2
    whole = np.isfinite(windows.shares).all(axis=(1, 2))
    shares = windows.shares[whole] if whole.any() else np.nan_to_num(windows.shares)
    area = float(np.median(shares.sum(axis=(1, 2)))) * windows.cell_px**2
    return float(np.sqrt(area / covers))


def best_start(
    figure: Figure, windows: Windows, frames: Floats, basis: Basis, looks: FitLooks,
    tries: StartLooks, faces: tuple[float, ...], heard: Callable[[], None],
) -> Start:  # fmt: skip
    """The best of starts with several phases of the legs, for each way that it may look.

    Phases are told apart in a few of the frames; the best of them are tried with the tail held
    otherwise, too, and the best of those goes on.
    """
    scale = scale_of(figure, windows)
    few = _few(len(frames), tries.frames)
    found: list[Start] = []
    for way in faces:
        seen = windows if way == windows.faces else windows.mirrored()
        fit = Fit(figure, seen.of(few), basis.of(few), looks, frames[few])
        for front, hind in _phases(tries.phases, fit):
            found.append(_tried(fit, _begin(fit, front, hind, tries), scale, tries, heard))
    found.sort(key=lambda start: start.loss)
    otherwise = [
        _tried(start.fit, held, scale, tries, heard)
        for start in found[: tries.best]
        for held in _tails_held(start.fit, start.numbers, tries)
    ]
    best = min([*found[: tries.best], *otherwise], key=lambda start: start.loss)
    seen = windows if best.fit.windows.faces == windows.faces else windows.mirrored()
    fit = Fit(figure, seen, basis, looks, frames)
    numbers = best.fit.moved_to(fit, best.numbers)
    numbers, loss = fit.improve(numbers, scale, tries.soft, tries.more_steps, heard)
    return Start(fit, numbers, scale, loss)


def _tried(
    fit: Fit, numbers: Floats, scale: float, tries: StartLooks, heard: Callable[[], None]
) -> Start:
    heard()
    numbers, loss = fit.improve(numbers, scale, tries.soft, tries.steps)
    return Start(fit, numbers, scale, loss)


def _tails_held(fit: Fit, numbers: Floats, tries: StartLooks) -> list[Floats]:
    """The numbers with what swings by itself stretched, and turned up or down where it begins."""
    figure = fit.figure
    swinging = [limb for limb in figure.limbs if limb.part.swings and limb.side == "middle"]
    held: list[Floats] = []
    for limb in swinging:
        rows = {int(segment): row for row, segment in enumerate(fit.groups)}
        for turn in tries.tail_turns_rad:
            other = numbers.copy()
            shares = fit.part(other, "shares")
            for place, segment in enumerate(limb.segments):
                shares[rows[segment]] = 0.0
                if place == 0:
                    shares[rows[segment], 0] = turn / fit.spread[rows[segment], 0]
            fit.part(other, "length")[list(limb.segments)] = 0.0
            fit.part(other, "deep")[list(limb.joints)] = 0.0
            held.append(other)
    return held


def _phases(count: int, fit: Fit) -> list[tuple[float, float]]:
    """Of front and hind legs; from the side half a cycle later looks the same, if nobody has marked
    which leg is which.
    """
    if not fit.basis.shared:
        return [(0.0, 0.0)]
    half = np.arange(count) * _span(fit) / count
    return [(float(front), float(hind)) for front in half for hind in half]


def _span(fit: Fit) -> float:
    """The share of a stride in which phases look different."""
    told = fit.top or any(name.endswith("_left") for name in fit.pinned)
    return 1.0 if told else 0.5


def _begin(fit: Fit, front: float, hind: float, tries: StartLooks) -> Floats:
    """Numbers of the plan's shape at the silhouettes' middle, its legs swinging."""
    figure, numbers = fit.figure, np.zeros(fit.size)
    root = fit.part(numbers, "root")
    joints = posed(figure, np.zeros((1, 2)), figure.rest[None], figure.length, figure.apart).joints[
        0
    ]
    middle = 0.5 * (joints[figure.start] + joints[figure.end])
    weight = figure.length * (figure.deep[figure.start] + figure.deep[figure.end])
    root[:] = -(weight @ middle) / weight.sum() / 0.1
    if not fit.basis.shared:
        return numbers
    shares = fit.part(numbers, "shares")
    rows = {segment: row for row, segment in enumerate(fit.groups)}
    body_x = joints[list(figure.limbs[0].joints), 0].mean()
    for limb in figure.feet():
        if limb.segments[0] in rows:
            phase = front if joints[limb.joints[0], 0] > body_x else hind
            _swing(fit, shares, limb, phase, tries)
    return numbers


def _swing(fit: Fit, shares: Floats, limb: Limb, phase: float, tries: StartLooks) -> None:
    """Lets a limb swing at a phase, and do nothing else, in place."""
    rows = {int(segment): row for row, segment in enumerate(fit.groups)}
    order = (fit.basis.near.shape[1] - 1) // 2
    for place, segment in enumerate(limb.segments):
        row = rows[segment]
        shares[row] = 0.0
        if place > 1:
            continue
        swing = tries.stride_rad if place == 0 else tries.bend_rad
        turn = 2.0 * np.pi * (phase + 0.25 * place)
        size = swing / fit.basis.spread[1]
        shares[row, 1] = size * np.cos(turn)
        shares[row, 1 + order] = size * np.sin(turn)


def legs_together(
    start: Start, fine: Windows, tries: StartLooks, heard: Callable[[], None]
) -> Start:
    """The start with all pairs of legs begun anew at once, where they cover more so.

    A leg that once swings where nothing is seldom finds back by itself: not while another pair
    covers its place, nor while its length has grown to cover what it should not. So all of them
    begin at each choice of phases, in the plan's shape, in a few of the frames. The best go on in
    fine windows with ever sharper edges: soft ones cover two legs as well the wrong way round.
    """
    fit, scale = start.fit, start.px_per_length
    legs = _own_legs(fit) if fit.basis.shared else []
    if not legs:
        return start
    rows = _few(len(fit.frames), tries.frames)
    less = Fit(fit.figure, fit.windows.of(rows), fit.basis.of(rows), fit.looks, fit.frames[rows])
    begun = fit.moved_to(less, start.numbers)
    found: list[tuple[float, Floats]] = []
    every = product(_phases_of(len(legs), tries, fit), repeat=len(legs))
    for phases in islice(every, tries.choices):
        numbers = begun.copy()
        for limb, phase in zip(legs, phases, strict=True):
            _as_planned(less, numbers, limb)
            _swing(less, less.part(numbers, "shares"), limb, phase, tries)
        numbers, loss = less.improve(numbers, scale, tries.soft, tries.again_steps, heard)
        found.append((loss, numbers))
    found.sort(key=lambda one: one[0])
    sharp = Fit(fit.figure, fine.of(rows), less.basis, fit.looks, less.frames)
    tried = [begun, *(numbers for _, numbers in found[: tries.together])]
    losses = []
    for number, numbers in enumerate(tried):
        for soft in tries.sharper:
            numbers, loss = sharp.improve(numbers, scale, soft, tries.sharper_steps, heard)
        tried[number] = numbers
        losses.append(loss)
    best = int(np.argmin(losses))
    if best == 0 or losses[best] > losses[0] * (1.0 - tries.gain):
        return start
    return Start(fit, less.moved_to(fit, tried[best]), scale, losses[best])


def _own_legs(fit: Fit) -> list[Limb]:
    """Of each pair the one whose numbers both have."""
    own = {int(segment) for segment in fit.groups}
    return [limb for limb in fit.figure.feet() if limb.segments[0] in own]


def _phases_of(pairs: int, tries: StartLooks, fit: Fit) -> list[float]:
    """Of one pair of legs: of many pairs fewer, so that the choices stay within their bound."""
    count = min(tries.phases, max(2, int(tries.choices ** (1.0 / max(pairs, 1)) + 1e-9)))
    return [_span(fit) * number / count for number in range(count)]


def _as_planned(fit: Fit, numbers: Floats, limb: Limb) -> None:
    """Gives a limb the plan's lengths and thickness again, in place."""
    fit.part(numbers, "length")[fit.twin_segment[list(limb.segments)]] = 0.0
    fit.part(numbers, "deep")[fit.twin_joint[list(limb.joints[1:])]] = 0.0


def _few(count: int, frames: int) -> NDArray[np.int64]:
    return np.unique(np.linspace(0, count - 1, frames).round().astype(np.int64))
