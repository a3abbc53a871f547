"""The figure of a body plan fitted to silhouettes: one shape, and its pose through time."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize

from veduta.fauna.motion.figure import Figure, Floats, Ints, back_through, posed
from veduta.fauna.read.basis import Basis, FitLooks, as_many
from veduta.fauna.read.occupancy import Cover, cover
from veduta.fauna.read.windows import Windows

_ROOT = 0.1
"""The root's numbers are in so many lengths: about as much as a step changes them."""


@dataclass(frozen=True, eq=False)
class Fitted:
    """A figure in its frames; lengths are those of the plan times px_per_length pixels.

    root: (t, 2). angles: (t, s). length: (s,). deep: (j,). apart: (m, 2). numbers: all that the fit
    chose, as `Fit.fitted` takes it. loss: (t,).
    """

    figure: Figure
    px_per_length: float
    root: Floats
    angles: Floats
    length: Floats
    deep: Floats
    apart: Floats
    numbers: Floats
    loss: Floats

    def joints(self) -> Floats:
        """(t, j, 2) from the windows' middles, in lengths."""
        return posed(self.figure, self.root, self.angles, self.length, self.apart).joints


class Fit:
    """The numbers of a fit, each in its own standard deviations, and the loss of them."""

    def __init__(
        self, figure: Figure, windows: Windows, basis: Basis, looks: FitLooks, frames: Floats
    ) -> None:
        self.frames, self.weights = frames, windows.weights()
        self.pinned = [name for name in windows.pins if name in figure.names]
        every = np.ones(len(windows.shares))
        self.trust = (
            np.stack([windows.trust.get(name, every) for name in self.pinned], axis=1)
            if (self.pinned)
            else np.ones((len(every), 0))
        )
        self.pinned_joints = [figure.names.index(name) for name in self.pinned]
        self.figure, self.windows, self.basis, self.looks = figure, windows, basis, looks
        self.far = np.array([figure.limbs[n].side == "right" for n in figure.limb])
        twin = _twins(figure)
        self.twin_segment, self.twin_joint, self.twin_limb = twin
        top = bool(figure.feet()) and _seen_from_above(figure)
        self.sign = np.where(self.far & top, -1.0, 1.0)
        self.top = top
        own = self.twin_segment if basis.shared else np.arange(len(figure.start))
        self.groups, self.group = np.unique(own, return_inverse=True)
        stiff = np.array([figure.limbs[n].part.stiff for n in figure.limb])
        hangs = np.array([figure.limbs[n].part.swings for n in figure.limb])
        spread = np.tile(basis.spread, (len(self.groups), 1))
        spread[:, 1:] *= np.where(hangs, looks.hanging, 1.0)[self.groups, None]
        place = np.zeros(len(figure.start))
        for limb in figure.limbs:
            if limb.part.ground:
                place[list(limb.segments)] = np.arange(len(limb.segments))
        spread[:, 1:] *= (1.0 + looks.freer * place)[self.groups, None]
        self.spread = spread / stiff[self.groups, None]
        count = len(windows.shares)
        hung = np.array([looks.hung if limb.part.ground else 1.0 for limb in figure.limbs])
        self.apart = looks.apart * np.stack([hung, np.ones(len(hung))], axis=1)
        sizes = {
            "root": (count, 2), "length": (len(figure.start),), "deep": (len(figure.deep),),
            "apart": (len(figure.limbs), 2), "aside": (len(figure.limbs), 2),
            "shares": (len(self.groups), basis.near.shape[1]), "size": (1,),
        }  # fmt: skip
        self.slots: dict[str, tuple[slice, tuple[int, ...]]] = {}
        at = 0
        for name, shape in sizes.items():
            size = int(np.prod(shape))
            self.slots[name] = (slice(at, at + size), shape)
            at += size
        self.size = at

    def part(self, numbers: Floats, name: str) -> Floats:
        """A view of the numbers of one kind."""
        place, shape = self.slots[name]
        return numbers[place].reshape(shape)

    def unpacked(self, numbers: Floats) -> tuple[Floats, Floats, Floats, Floats, Floats]:
        """root, angles, length, deep, apart of a vector of numbers."""
        looks, figure = self.looks, self.figure
        size = self._size(numbers)
        length = np.exp(looks.length * self.part(numbers, "length")[self.twin_segment])
        deep = np.exp(looks.deep * self.part(numbers, "deep")[self.twin_joint])
        own = self.apart * self.part(numbers, "apart")[self.twin_limb]
        right = np.array([limb.side == "right" for limb in figure.limbs])
        if self.top:
            own = np.where(right[:, None], own * np.array([1.0, -1.0]), own)
        else:
            aside = 0.5 * self.apart * self.part(numbers, "aside")[self.twin_limb]
            own = own + np.where(right[:, None], aside, 0.0)
        swing = (self.part(numbers, "shares") * self.spread)[self.group]
        angles = np.where(self.far, self.basis.far @ swing.T, self.basis.near @ swing.T)
        angles = figure.rest + self.sign * angles
        return (
            _ROOT * self.part(numbers, "root"), angles, size * figure.length * length,
            size * figure.deep * deep, size * (figure.apart + own),
        )  # fmt: skip

    def _size(self, numbers: Floats) -> float:
        """How much larger than the plan the animal is in the lengths of the start."""
        return float(np.exp(self.looks.size * self.part(numbers, "size")[0]))

    def loss(
        self, numbers: Floats, px_per_length: float, soft: float
    ) -> tuple[float, Floats, Floats]:
        """The mean loss, its gradient, and (t,) that of the silhouettes alone."""
        root, angles, length, deep, apart = self.unpacked(numbers)
        pose = posed(self.figure, root, angles, length, apart)
        seen = cover(
            self.figure, pose.joints, deep, self.windows.places(px_per_length),
            self.windows.flat(), self.weights, soft,
        )  # fmt: skip
        count = len(root)
        self._hold(seen, pose.joints, px_per_length)
        if self.pinned:
            self._pull(seen, pose.joints, px_per_length)
        by_root, by_angles, by_length, by_apart = back_through(
            self.figure, pose, seen.by_joint / count, length
        )
        gradient = np.zeros(self.size)
        looks = self.looks
        self.part(gradient, "root")[:] = _ROOT * by_root
        np.add.at(
            self.part(gradient, "length"), self.twin_segment, by_length * length * looks.length
        )
        by_deep = seen.by_deep.sum(axis=0) / count * deep
        np.add.at(self.part(gradient, "deep"), self.twin_joint, by_deep * looks.deep)
        by_size = (by_length * length).sum() + by_deep.sum() + (by_apart * apart).sum()
        self.part(gradient, "size")[0] = looks.size * by_size
        self._back_apart(gradient, by_apart * self._size(numbers))
        by_angles = by_angles * self.sign
        by_swing = np.where(
            self.far[:, None], by_angles.T @ self.basis.far, by_angles.T @ self.basis.near
        )
        by_share = by_swing * self.spread[self.group]
        np.add.at(self.part(gradient, "shares"), self.group, by_share)
        prior = looks.weight * numbers
        place, shape = self.slots["root"]
        prior[place] = 0.0
        stiff = _ROOT / looks.root
        bend = stiff * np.diff(numbers[place].reshape(shape), n=2, axis=0)
        total = float(seen.loss.mean() + 0.5 * looks.weight * (numbers**2).sum())
        total -= 0.5 * looks.weight * float((numbers[place] ** 2).sum())
        total += 0.5 * looks.weight * float((bend**2).sum())
        rooted = prior[place].reshape(shape)
        push = looks.weight * stiff * bend
        rooted[:-2] += push
        rooted[1:-1] -= 2.0 * push
        rooted[2:] += push
        prior[place] = rooted.ravel()
        return total, gradient + prior, seen.loss

    def _hold(self, seen: Cover, joints: Floats, px_per_length: float) -> None:
        """Joints outside of the windows are pulled back: there is no animal."""
        height, width = self.windows.shares.shape[1:]
        half = 0.5 * np.array([width, height]) * self.windows.cell_px / px_per_length
        over = joints - np.clip(joints, -half, half)
        seen.loss[:] += self.looks.beyond * (over**2).sum(axis=(1, 2))
        seen.by_joint[:] += 2.0 * self.looks.beyond * over

    def _pull(self, seen: Cover, joints: Floats, px_per_length: float) -> None:
        """Marked joints pull: the squared distance, in lengths, is a loss, too."""
        marked = np.stack([self.windows.pins[name] for name in self.pinned], axis=1)
        away = joints[:, self.pinned_joints] - self.windows.from_picture(marked, px_per_length)
        away = np.where(np.isfinite(away), away, 0.0)
        pull = self.looks.pin * self.trust[..., None]
        seen.loss[:] += (pull * away**2).sum(axis=(1, 2))
        seen.by_joint[:, self.pinned_joints] += 2.0 * pull * away

    def _back_apart(self, gradient: Floats, by_apart: Floats) -> None:
        right = np.array([limb.side == "right" for limb in self.figure.limbs])[:, None]
        own = self.apart * by_apart
        if self.top:
            own = np.where(right, own * np.array([1.0, -1.0]), own)
        else:
            aside = np.where(right, 0.5 * self.apart * by_apart, 0.0)
            np.add.at(self.part(gradient, "aside"), self.twin_limb, aside)
        np.add.at(self.part(gradient, "apart"), self.twin_limb, own)

    def improve(
        self, numbers: Floats, px_per_length: float, soft: float, steps: int,
        heard: Callable[[], None] | None = None,
    ) -> tuple[Floats, float]:  # fmt: skip
        """The numbers after so many steps of L-BFGS, and their loss."""

        def value(at: Floats) -> tuple[float, Floats]:
            if heard is not None:
                heard()
            total, gradient, _ = self.loss(at, px_per_length, soft)
            return total, gradient

        found = minimize(value, numbers, jac=True, method="L-BFGS-B", options={"maxiter": steps})
        return np.asarray(found.x), float(found.fun)

    def fitted(self, numbers: Floats, px_per_length: float, soft: float) -> Fitted:
        """What the numbers say."""
        root, angles, length, deep, apart = self.unpacked(numbers)
        loss = self.loss(numbers, px_per_length, soft)[2]
        return Fitted(
            self.figure, px_per_length, root.copy(), angles, length, deep, apart, numbers, loss
        )

    def other_way_round(self, numbers: Floats, part: str) -> Floats:
        """The numbers of the same silhouettes (from the side) with what the left legs of a part do
        done by the right ones.
        """
        found = numbers.copy()
        left, right = (
            next(limb for limb in self.figure.limbs if limb.name == f"{part}_{side}")
            for side in ("left", "right")
        )
        rows = {int(segment): row for row, segment in enumerate(self.groups)}
        shares = self.part(found, "shares")
        for mine, theirs in zip(left.segments, right.segments, strict=True):
            if self.basis.shared:
                # Half a cycle later every second harmonic, from the first on, is turned round.
                count = (shares.shape[1] - 1) // 2
                turned = 1.0 - 2.0 * (np.arange(count) % 2 == 0)
                shares[rows[mine], 1:] *= np.concatenate([turned, turned])
            else:
                both = [rows[mine], rows[theirs]]
                shares[both] = shares[both[::-1]]
        limb = self.twin_limb[self.figure.limbs.index(left)]
        aside = self.part(found, "aside")
        self.part(found, "apart")[limb] += 0.5 * aside[limb]
        aside[limb] *= -1.0
        return found

    def moved_to(self, other: Fit, numbers: Floats) -> Floats:
        """These numbers for another figure, basis or frames of the same animal.

        What the other does not share with this begins at 0, at the plan's. Frames of the other
        that this lacks have the root between its neighbours'.
        """
        found = np.zeros(other.size)
        mine, theirs = self.figure, other.figure
        ends = [[figure.names[k] for k in figure.end] for figure in (mine, theirs)]
        limbs = [[limb.name for limb in figure.limbs] for figure in (mine, theirs)]
        keys = {
            "length": (ends[0], ends[1]), "deep": (mine.names, theirs.names),
            "apart": (limbs[0], limbs[1]), "aside": (limbs[0], limbs[1]),
            "shares": ([ends[0][k] for k in self.groups], [ends[1][k] for k in other.groups]),
        }  # fmt: skip
        for name, (own, wanted) in keys.items():
            rows = {key: row for row, key in enumerate(own)}
            both = [(rows[key], row) for row, key in enumerate(wanted) if key in rows]
            there, here = (list(column) for column in zip(*both, strict=True))
            own_rows = self.part(numbers, name)[there]
            if name == "shares":
                own_rows = as_many(own_rows, self.basis, other.basis)
            other.part(found, name)[here] = own_rows
        other.part(found, "size")[:] = self.part(numbers, "size")
        root = self.part(numbers, "root")
        for axis in (0, 1):
            other.part(found, "root")[:, axis] = np.interp(other.frames, self.frames, root[:, axis])
        return found


def _seen_from_above(figure: Figure) -> bool:
    """Whether right limbs mirror left ones in the plane."""
    names = figure.names
    for limb in figure.limbs:
        if limb.side == "left":
            other = names[limb.joints[0]].removesuffix("_left") + "_right"
            left = figure.rest @ figure.turns
            mate = next(one for one in figure.limbs if names[one.joints[0]] == other)
            apart = left[limb.segments[0]] - left[mate.segments[0]]
            return bool(abs(apart) > 1e-9)
    return False


def _twins(figure: Figure) -> tuple[Ints, Ints, Ints]:
    """For each segment, joint and limb that on the left of it, or itself."""
    segment: NDArray[np.int64] = np.arange(len(figure.start))
    joint: NDArray[np.int64] = np.arange(len(figure.names))
    limbs: NDArray[np.int64] = np.arange(len(figure.limbs))
    left = {limb.part.name: n for n, limb in enumerate(figure.limbs) if limb.side == "left"}
    for number, limb in enumerate(figure.limbs):
        if limb.side == "right":
            twin = figure.limbs[left[limb.part.name]]
            segment[list(limb.segments)] = twin.segments
            joint[list(limb.joints)] = twin.joints
            limbs[number] = left[limb.part.name]
    return segment, joint, limbs
