"""A clip carried over to a path on the ground (paper 4.4): the body bent along the curve and laid
on the ground's plane, feet planted by inverse kinematics, with start and stop.

Arc length goes to arc length: what a joint has ahead of the body's middle it has along the curve.
The bones of a body with limbs keep their lengths, so its spine is turned, not moved; one without
limbs is carried joint by joint along the curve's normals.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
import shapely
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter1d, maximum_filter1d

from veduta.fauna.motion.carried import Joints, against_parents, joints_in
from veduta.fauna.motion.figure import Floats
from veduta.fauna.motion.pieces import Piece, pieces_of, spots_on
from veduta.fauna.motion.pivot import Pivot
from veduta.fauna.motion.reach import reached_in_space
from veduta.fauna.motion.steps import (
    Footing,
    Heights,
    Stands,
    Steps,
    stands_along,
    steps_of,
    within_reach,
)
from veduta.fauna.motion.whole_path import Curve, Pace
from veduta.place.skin import Clip, Contact, Skin

_SIMPSON = (1.0, 4.0, 1.0)
"""Weights of hips, middle and shoulders in the trunk's centre: it bows smoothly, though its bones
are straight.
"""


@dataclass(frozen=True)
class TransferLooks:
    """How a body lies on the ground; in its lengths."""

    along: float = 0.4
    across: float = 0.1
    """The plane under it is that of the ground so far before, behind and beside it."""
    roll: float = 0.6
    """It leans to the side by this share of the ground's slope there: animals keep upright."""
    stretch: float = 0.985
    """A leg is stretched to this share of its length at most; the body comes down for it by up
    to
    """
    lower: float = 0.12
    """this."""
    lower_s: float = 0.12
    """And so smoothly."""


@dataclass(frozen=True, eq=False)
class Leg:
    """foot: its steps. joints: rows of the skeleton from the body on. end_m: (3,) its end in the
    last of them.
    """

    foot: Footing
    joints: tuple[int, ...]
    end_m: Floats


@dataclass(frozen=True, eq=False)
class Walker:
    """What goes: a skeleton, the clip that it goes by, and its legs.

    spine: (j,) whether a joint turns with the curve where it is; others turn as what they hang on.
    Without legs all joints are carried one by one. swims: it keeps its height over the ground.
    """

    skin: Skin
    clip: Clip
    stride_m: float
    length_m: float
    spine: NDArray[np.bool_]
    legs: tuple[Leg, ...] = ()
    swims: bool = False


@dataclass(frozen=True, eq=False)
class Walked:
    """clip: in the frame of the path. slides_m: how far a standing foot is from its place at worst.
    sinks_m: how far one is under the ground at worst. aside_m: the middle of its body
    from the path at worst, seen from above.
    """

    clip: Clip
    slides_m: float
    sinks_m: float
    aside_m: float


def walked(
    walker: Walker, path_m: Floats, ground: Heights, *, closed: bool, looks: TransferLooks,
    corners: Sequence[int] = (),
) -> Walked:  # fmt: skip
    """The clip `path`: the animal goes along a path (n, 3) from where it stands to where it stops.

    corners: rows of the path at which it turns on the spot; it needs legs for that.
    """
    stride = max(walker.stride_m, 1e-6)
    pace = Pace(stride / float(walker.clip.times_s[-1]))
    pieces = pieces_of(
        path_m, corners if walker.legs else (), pace, stride, walker.length_m, closed=closed
    )
    laid = _one_after_the_other([_laid(walker, piece, ground, looks) for piece in pieces])
    times, phase = (
        np.concatenate([getattr(piece, name) for piece in pieces]) for name in ("times", "phase")
    )
    plans = [
        stands_along(
            leg.foot, float(phase[0]), float(phase[-1]), partial(spots_on, pieces, leg.foot)
        )
        for leg in walker.legs
    ]
    laid = _lowered(walker, laid, plans, phase, times, ground, looks)
    steps = []
    for leg, plan in zip(walker.legs, plans, strict=True):
        hung = laid.places[:, leg.joints[0]]
        reach = 0.5 * (1.0 + looks.stretch) * _leg_length(walker.skin, leg)
        near = within_reach(plan, phase, hung, reach, leg.foot, ground)
        steps.append(steps_of(near, phase, leg.foot, ground, (hung, reach)))
    slides, sinks, contacts = _planted(walker, laid, steps, times, ground)
    turns, moves = against_parents(walker.skin, laid)
    clip = Clip("path", times, moves, turns, False, tuple(contacts))
    return Walked(clip, slides, sinks, _aside(walker, laid, pieces))


def _laid(walker: Walker, piece: Piece, ground: Heights, looks: TransferLooks) -> Joints:
    """The body on one piece of its way, its legs as in its clip."""
    share = np.clip(piece.pace / 0.35, 0.0, 1.0)
    share = share * share * (3.0 - 2.0 * share)
    seconds = float(walker.clip.times_s[-1])
    joints = joints_in(walker.skin, walker.clip, piece.phase % 1.0 * seconds, share)
    if isinstance(piece.line, Curve) and not walker.legs:
        return _carried(walker, joints, piece.line, piece.way, ground)
    frame, origin = _frames(walker, piece.line, ground, piece.way, looks)
    return _bent(walker, joints, piece.line, piece.way, frame, origin)


def _one_after_the_other(laid: list[Joints]) -> Joints:
    return Joints(
        np.concatenate([one.turns for one in laid]), np.concatenate([one.places for one in laid])
    )


def _frames(
    walker: Walker, curve: Curve | Pivot, ground: Heights, way: Floats, looks: TransferLooks
) -> tuple[Floats, Floats]:
    """(t, 3, 3) axes ahead, left and up of the body, and (t, 3) the ground under its middle."""
    ahead = curve.heading(way)
    left = np.stack([-ahead[:, 1], ahead[:, 0]], axis=1)
    middle = curve.at(way)
    along = np.linspace(-1.0, 1.0, 9) * looks.along * walker.length_m
    across = np.linspace(-1.0, 1.0, 5) * looks.across * walker.length_m
    x, y = (axis.reshape(-1) for axis in np.meshgrid(along, across, indexing="ij"))
    spots = middle[:, None] + x[:, None] * ahead[:, None] + y[:, None] * left[:, None]
    heights = np.array(ground(spots.reshape(-1, 2))).reshape(len(way), -1)
    known = np.isfinite(heights)
    base = np.nanmean(np.where(known.any(axis=1, keepdims=True), heights, 0.0), axis=1)
    heights = np.where(known, heights, base[:, None])
    level = heights.mean(axis=1)
    slope = heights @ x / (x @ x)
    lean = looks.roll * (heights @ y) / (y @ y)
    if walker.swims:
        slope, lean = np.zeros_like(slope), np.zeros_like(lean)
    flat = np.zeros(len(way))
    forward = np.column_stack([ahead, slope])
    forward /= np.linalg.norm(forward, axis=1, keepdims=True)
    side = np.column_stack([left, lean])
    up = np.cross(forward, side)
    up /= np.linalg.norm(up, axis=1, keepdims=True)
    axes = np.stack([forward, np.cross(up, forward), up], axis=2)
    return axes, np.column_stack([middle, level + flat])


def _turned(angle: Floats) -> Floats:
    """(..., 3, 3) turns about z."""
    cos, sin, zero = np.cos(angle), np.sin(angle), np.zeros_like(angle)
    rows = [cos, -sin, zero, sin, cos, zero, zero, zero, zero + 1.0]
    return np.stack(rows, axis=-1).reshape(*angle.shape, 3, 3)


def _bent(
    walker: Walker, joints: Joints, curve: Curve | Pivot, way: Floats, frame: Floats,
    origin: Floats,
) -> Joints:  # fmt: skip
    """The body in its frame, its spine turned with the curve; bones keep their lengths."""
    skin = walker.skin
    here = curve.heading(way)
    yaw = np.zeros(joints.places.shape[:2])
    middles = _middles(skin)
    for joint, parent in enumerate(skin.parent):
        if walker.spine[joint]:
            there = curve.heading(way + middles[joint])
            cross = here[:, 0] * there[:, 1] - here[:, 1] * there[:, 0]
            yaw[:, joint] = np.arctan2(cross, (here * there).sum(axis=1))
        elif parent >= 0:
            yaw[:, joint] = yaw[:, parent]
    turn = _turned(yaw)
    places = joints.places.copy()
    for joint, parent in enumerate(skin.parent):
        if parent == 0 and walker.spine[joint]:
            at = curve.at(way + skin.rest[joint, 0, 3]) - curve.at(way)
            left = np.stack([-here[:, 1], here[:, 0]], axis=1)
            flat = np.linalg.norm(frame[:, :2, 0], axis=1)
            places[:, joint, 0] += (at * here).sum(axis=1) / flat - skin.rest[joint, 0, 3]
            places[:, joint, 1] += (at * left).sum(axis=1)
        elif parent > 0:
            away = joints.places[:, joint] - joints.places[:, parent]
            places[:, joint] = places[:, parent] + np.einsum("tij,tj->ti", turn[:, parent], away)
    world = frame[:, None] @ turn @ joints.turns
    placed = origin[:, None] + np.einsum("tij,tkj->tki", frame, places)
    # It stands over its feet, upright on a slope, too: only its trunk lies along that.
    hung = float(np.mean([skin.rest[leg.joints[0], 2, 3] for leg in walker.legs]))
    upright = np.array([0.0, 0.0, 1.0]) - frame[:, :, 2]
    placed += hung * upright[:, None]
    # Its middle goes along the path: what sways is the body about that.
    placed[..., :2] -= _off_the_path(walker, placed, curve, way)[:, None]
    world[:, 0], placed[:, 0] = frame, origin
    return Joints(world, placed)


def _off_the_path(walker: Walker, places: Floats, line: Curve | Pivot, way: Floats) -> Floats:
    """(t, 2) from the path to the body's centre: that of the spine between the legs, along which it
    may bow to one side; of a body without legs, of all joints.
    """
    if not walker.legs:
        rows = np.flatnonzero(walker.spine).tolist()
        there = line.at(way[:, None] + walker.skin.rest[rows, 0, 3])
        return np.asarray((places[:, rows, :2] - there).mean(axis=1))
    arcs = np.linspace(*_between_legs(walker), len(_SIMPSON))
    off = [_spine_at(walker, places, float(at)) - line.at(way + at) for at in arcs]
    return np.asarray(np.average(off, axis=0, weights=_SIMPSON))


def _between_legs(walker: Walker) -> tuple[float, float]:
    """From where the hindmost legs hang to where the foremost do, m ahead of the root; of a body
    without legs, from its end to its tip.
    """
    ahead = walker.skin.rest[:, 0, 3]
    ends = ahead[[leg.joints[0] for leg in walker.legs] or np.flatnonzero(walker.spine)]
    return float(ends.min()), float(ends.max())


def _spine_at(walker: Walker, places: Floats, at: float) -> Floats:
    """(t, 2) where the spine lies that is so far (m) ahead of the root at rest."""
    ahead = walker.skin.rest[:, 0, 3]
    rows = np.flatnonzero(walker.spine)
    rows = rows[np.argsort(ahead[rows], kind="stable")]
    after = int(np.clip(np.searchsorted(ahead[rows], at), 1, len(rows) - 1))
    first, second = rows[after - 1], rows[after]
    share = (at - ahead[first]) / max(float(ahead[second] - ahead[first]), 1e-9)
    return np.asarray((1.0 - share) * places[:, first, :2] + share * places[:, second, :2])


def _middles(skin: Skin) -> Floats:
    """(j,) how far ahead the middle of each joint's segment is at rest."""
    own = skin.rest[:, 0, 3]
    found: Floats = own.copy()
    for joint, parent in enumerate(skin.parent):
        children = np.flatnonzero(skin.parent == joint)
        if len(children):
            found[joint] = 0.5 * (own[joint] + own[int(children[0])])
        elif parent > 0:
            found[joint] = own[joint] + 0.5 * (own[joint] - own[parent])
    return found


def _carried(walker: Walker, joints: Joints, curve: Curve, way: Floats, ground: Heights) -> Joints:
    """Each joint on the curve, where its arc length is, beside it by its normal."""
    arcs = way[:, None] + joints.places[..., 0]
    ahead = curve.heading(arcs)
    left = np.stack([-ahead[..., 1], ahead[..., 0]], axis=-1)
    flat = curve.at(arcs) + joints.places[..., 1:2] * left
    level = np.interp(np.clip(arcs, 0.0, curve.length_m), curve.arcs, curve.points[:, 2])
    if curve.closed:
        level = np.interp(arcs % curve.length_m, curve.arcs, curve.points[:, 2])
    if not walker.swims:
        own = np.array(ground(flat.reshape(-1, 2))).reshape(level.shape)
        own = np.where(np.isfinite(own), own, level)
        level = np.asarray(gaussian_filter1d(own, 1.5, axis=1, mode="nearest"))
    yaw = np.arctan2(ahead[..., 1], ahead[..., 0])
    placed = np.concatenate([flat, (level + joints.places[..., 2])[..., None]], axis=-1)
    return Joints(_turned(yaw) @ joints.turns, placed)


def _lowered(
    walker: Walker, laid: Joints, plans: list[Stands], phase: Floats, times: Floats,
    ground: Heights, looks: TransferLooks,
) -> Joints:  # fmt: skip
    """The body brought down where a standing foot is out of its leg's reach."""
    if not walker.legs:
        return laid
    need = np.zeros(len(times))
    for leg, plan in zip(walker.legs, plans, strict=True):
        long = looks.stretch * _leg_length(walker.skin, leg)
        step = steps_of(plan, phase, leg.foot, ground)
        away = laid.places[:, leg.joints[0]] - step.places
        high = away[:, 2]
        beyond = np.maximum((away**2).sum(axis=1) - long * long, 0.0)
        down = high - np.sqrt(np.maximum(high * high - beyond, 0.0))
        need = np.maximum(need, np.where(step.stands, down, 0.0))
    need = np.minimum(need, looks.lower * walker.length_m)
    keys = max(1.0, looks.lower_s / float(times[1] - times[0]))
    wide = maximum_filter1d(need, 2 * int(2.0 * keys) + 1)
    smooth = gaussian_filter1d(wide, keys)
    moved = laid.places.copy()
    moved[:, 1:, 2] -= smooth[:, None]
    return Joints(laid.turns, moved)


def _leg_length(skin: Skin, leg: Leg) -> float:
    places = [skin.rest[joint, :3, 3] for joint in leg.joints]
    places.append(places[-1] + leg.end_m)
    return float(np.linalg.norm(np.diff(np.array(places), axis=0), axis=1).sum())


def _planted(
    walker: Walker, laid: Joints, steps: list[Steps], times: Floats, ground: Heights
) -> tuple[float, float, list[Contact]]:
    """Turns the legs, in place, so that their feet are where they are wanted."""
    slides, sinks, contacts = 0.0, 0.0, []
    for leg, step in zip(walker.legs, steps, strict=True):
        rows = list(leg.joints)
        end = laid.ends(rows[-1], leg.end_m)
        turns, _ = reached_in_space(laid.places[:, rows], end, step.places)
        laid.turns[:, rows] = turns @ laid.turns[:, rows]
        for first, second in zip(rows, rows[1:], strict=False):
            away = walker.skin.rest[second, :3, 3] - walker.skin.rest[first, :3, 3]
            laid.places[:, second] = laid.ends(first, away)
        end = laid.ends(rows[-1], leg.end_m)
        off = np.linalg.norm(end - step.places, axis=1)[step.stands]
        slides = max(slides, float(off.max(initial=0.0)))
        deep = np.array(ground(end[:, :2])) - (end[:, 2] - leg.foot.sole_m)
        sinks = max(sinks, float(np.nanmax(deep, initial=0.0)))
        change = np.diff(np.concatenate([[0], step.stands.astype(np.int8), [0]]))
        begin, last = np.flatnonzero(change == 1), np.flatnonzero(change == -1) - 1
        spans = tuple(
            (float(times[a]), float(times[b])) for a, b in zip(begin, last, strict=True) if b > a
        )
        contacts.append(Contact(leg.foot.name, walker.skin.names[rows[-1]], spans))
    return slides, sinks, contacts


def _aside(walker: Walker, laid: Joints, pieces: tuple[Piece, ...]) -> float:
    """How far the body's middle is from its way at worst, seen from above: by where the joints came
    to lie, and the nearest spot of the curve. While it turns on the spot there is none.
    """
    cuts = np.cumsum([len(piece.times) for piece in pieces])[:-1]
    worst = 0.0
    for piece, centre in zip(pieces, np.split(_middle(walker, laid), cuts), strict=True):
        if isinstance(piece.line, Curve) and len(centre):
            line = shapely.LineString(piece.line.at(_reaching(piece.line, walker.length_m)))
            worst = max(worst, float(shapely.distance(shapely.points(centre), line).max()))
    return worst


def _reaching(curve: Curve, length_m: float) -> Floats:
    """Arcs of a curve's points; of an open one, straight on by a body's length at its ends."""
    if curve.closed:
        return curve.arcs
    return np.concatenate([[-length_m], curve.arcs, [curve.length_m + length_m]])


def _middle(walker: Walker, laid: Joints) -> Floats:
    """(t, 2) the middle of the spine between the legs; of a body without legs, of all of it."""
    return _spine_at(walker, laid.places, 0.5 * sum(_between_legs(walker)))
