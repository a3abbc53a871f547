"""The rotations between the views of one key position (section 3.6)."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

from veduta.walk.build.local_model import LocalModel
from veduta.walk.build.matches import match_features

Matrix = NDArray[np.float64]


@dataclass(frozen=True)
class TurnLimits:
    """limit_rad: how far a match may be off a rotation. fewest: matches for a rotation. draws: of
    two matches, in search of it. share: least part of the matches that agree. huber_rad: beyond it
    an error counts linearly. seed: of the draws.
    """

    limit_rad: float = 0.004
    fewest: int = 15
    draws: int = 400
    share: float = 0.2
    huber_rad: float = 0.001
    seed: int = 5


@dataclass(frozen=True, eq=False)
class Turns:
    """front: the number of the view that the others turn from. front_from_view: (n, 3, 3), NaN for
    views that have nothing in common with the others. matches: all that agree. off_rad: root mean
    square of what is left between them.
    """

    front: int
    front_from_view: Matrix
    matches: int
    off_rad: float

    @property
    def found(self) -> NDArray[np.bool_]:
        """(n,) which views have a rotation."""
        return np.asarray(np.isfinite(self.front_from_view[:, 0, 0]))


@dataclass(frozen=True, eq=False)
class _Link:
    """Rays (n, 3) of two views that are the same; first = turn @ second."""

    first: int
    second: int
    rays_first: Matrix
    rays_second: Matrix
    turn: Matrix


def find_turns(models: list[LocalModel], limits: TurnLimits = TurnLimits()) -> Turns:
    """The views turned onto that one from which the others are fewest steps away."""
    links = [
        link
        for first, second in combinations(range(len(models)), 2)
        if (link := _link(models, first, second, limits)) is not None
    ]
    front = _front(len(models), links)
    start = _chained(len(models), front, links)
    known = [n for n in range(len(models)) if n in start]
    used = [link for link in links if link.first in start and link.second in start]
    turns = np.full((len(models), 3, 3), np.nan)
    if not used:
        turns[front] = np.eye(3)
        return Turns(front, turns, 0, 0.0)
    turns[known], errors = _adjusted(known, front, start, used, limits)
    off = float(np.sqrt((errors**2).sum(axis=1).mean()))
    return Turns(front, turns, len(errors), off)


def _link(
    models: list[LocalModel], first: int, second: int, limits: TurnLimits
) -> _Link | None:
    matches = match_features(models[first], models[second])
    if len(matches) < limits.fewest:
        return None
    own, other = _rays(models[first], matches.first), _rays(models[second], matches.second)
    rng = np.random.default_rng(limits.seed)
    best = np.zeros(len(matches), dtype=bool)
    for _ in range(limits.draws):
        pair = rng.choice(len(matches), 2, replace=False)
        agree = _off(own, other, turn_between(own[pair], other[pair])) < limits.limit_rad
        if agree.sum() > best.sum():
            best = agree
    if best.sum() < max(limits.fewest, limits.share * len(matches)):
        return None
    turn = turn_between(own[best], other[best])
    best = _off(own, other, turn) < limits.limit_rad
    return _Link(first, second, own[best], other[best], turn_between(own[best], other[best]))


def _rays(model: LocalModel, pixels: Matrix) -> Matrix:
    rays = model.screen.points(pixels, np.ones(len(pixels)))
    return np.asarray(rays / np.linalg.norm(rays, axis=1, keepdims=True))


def _off(own: Matrix, other: Matrix, turn: Matrix) -> Matrix:
    """(n,) the angles that are left."""
    return np.asarray(np.linalg.norm(own - other @ turn.T, axis=1))


def turn_between(own: Matrix, other: Matrix) -> Matrix:
    """(3, 3) the rotation that takes the second (n, 3) unit rays nearest to the first (Kabsch)."""
    left, _, right = np.linalg.svd(own.T @ other)
    sign = np.sign(np.linalg.det(left @ right))
    return np.asarray(left @ np.diag([1.0, 1.0, sign]) @ right)


def _front(count: int, links: list[_Link]) -> int:
    """In the middle of the others: the fewest links from the one that is farthest."""
    steps = np.full((count, count), np.inf)
    np.fill_diagonal(steps, 0.0)
    for link in links:
        steps[link.first, link.second] = steps[link.second, link.first] = 1.0
    for middle in range(count):
        steps = np.minimum(steps, steps[:, [middle]] + steps[[middle]])
    reached = np.isfinite(steps).sum(axis=1)
    far = np.where(np.isfinite(steps), steps, 0.0).sum(axis=1)
    order = np.lexsort((np.abs(np.arange(count) - count // 2), far, -reached))
    return int(order[0])


def _chained(count: int, front: int, links: list[_Link]) -> dict[int, Matrix]:
    """front_from_view along the links with the most matches."""
    found = {front: np.eye(3)}
    for _ in range(count):
        ends = [one for one in links if (one.first in found) != (one.second in found)]
        if not ends:
            break
        best = max(ends, key=lambda one: len(one.rays_first))
        if best.first in found:
            found[best.second] = found[best.first] @ best.turn
        else:
            found[best.first] = found[best.second] @ best.turn.T
    return found


def _adjusted(
    known: list[int], front: int, start: dict[int, Matrix], links: list[_Link], limits: TurnLimits
) -> tuple[Matrix, Matrix]:
    """All rotations at once, over all matches; and what is left, (n, 3)."""
    free = [n for n in known if n != front]

    def turns_of(vector: Matrix) -> dict[int, Matrix]:
        changes = Rotation.from_rotvec(vector.reshape(-1, 3)).as_matrix()
        changed = {n: change @ start[n] for n, change in zip(free, changes, strict=True)}
        return {front: start[front]} | changed

    def errors_of(vector: Matrix) -> Matrix:
        turns = turns_of(vector)
        return np.concatenate(
            [one.rays_first @ turns[one.first].T - one.rays_second @ turns[one.second].T for one in links]
        )

    def residuals(vector: Matrix) -> Matrix:
        return errors_of(vector).ravel()

    start_at = np.zeros(3 * len(free))
    found = least_squares(residuals, start_at, loss="huber", f_scale=limits.huber_rad)
    turns = turns_of(found.x)
    return np.array([turns[n] for n in known]), errors_of(found.x)
