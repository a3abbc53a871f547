"""Photographs of a synthetic street, and the same without what stands before the fronts.

Every pixel's ray meets boxes, cylinders and balls in closed form, four rays a pixel. Nothing here
is used by what makes facades of drives.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.synthetic.drives import rays
from veduta.synthetic.drives.fronts import Fronts
from veduta.synthetic.drives.street import Street

Floats = NDArray[np.float64]
Colours = NDArray[np.float32]
_FINER = 2
"""Rays of a pixel along both of its axes."""
_SEES_M = 40.0
"""What is farther along the street is not drawn."""
_SKY_LOW, _SKY_HIGH = (196, 216, 240), (112, 158, 226)
_ASPHALT, _PAVEMENT, _KERB_M = (96, 97, 100), (158, 154, 148), -7.4
_LEAF, _BARK, _LAMP, _HEDGE = (70, 112, 52), (92, 74, 58), (58, 62, 66), (52, 92, 44)
_PAINTS = (
    (168, 32, 34), (36, 62, 128), (226, 226, 228), (40, 42, 46), (146, 150, 156), (56, 104, 78),
)  # fmt: skip
_CABIN = (34, 40, 48)
_SIDE, _TOP = 0.62, 1.12
"""Light on sides and tops of boxes, beside that on fronts."""
_GAPS, _TWIG_M, _LEAF_M = 0.2, 0.13, 0.045


@dataclass(frozen=True)
class StreetCamera:
    """A camera that looks to the left, across the path (section 2 of Frueh et al. 2005).

    spacing_m: between two images. jitter_s: standard deviation of the times that are told. noise:
    of a pixel, exposure: of an image's gain (share); both are standard deviations.
    """

    width_px: int = 1024
    height_px: int = 768
    focal_px: float = 500.0
    height_m: float = 3.6
    spacing_m: float = 1.0
    jitter_s: float = 0.002
    noise: float = 1.5
    exposure: float = 0.01

    def world_from_cam(self, world_from_vehicle: Floats) -> Floats:
        """(3, 4): x right, y down, z forward, of a vehicle with x forward and y left."""
        forward, left = world_from_vehicle[:, 0], world_from_vehicle[:, 1]
        up = world_from_vehicle[:, 2]
        eye = world_from_vehicle[:, 3] + self.height_m * up
        return np.stack([forward, -up, left, eye], axis=1)


@dataclass(frozen=True, eq=False)
class StreetPhoto:
    """pixels: (h, w, 3) uint8 as taken. behind: (h, w, 3) the same without what stands before.

    before: (h, w) bool, that hides the pixel. front: (h, w) bool, behind is a house's front.
    """

    pixels: NDArray[np.uint8]
    behind: NDArray[np.uint8]
    before: NDArray[np.bool_]
    front: NDArray[np.bool_]


def photograph(
    street: Street,
    fronts: Fronts,
    camera: StreetCamera,
    world_from_vehicle: Floats,
    random: np.random.Generator,
) -> StreetPhoto:
    """One image from a vehicle's pose (3, 4)."""
    pose = camera.world_from_cam(world_from_vehicle)
    eye = pose[:, 3]
    near = street.between(float(eye[1]) - _SEES_M, float(eye[1]) + _SEES_M)
    screen = _Screen(camera, pose)
    front = _behind(screen, near, fronts)
    behind = screen.colour.copy()
    _before(screen, near)
    gain = 1.0 + camera.exposure * random.normal()
    before = cv2.resize(screen.hidden.astype(np.float32), screen.size, interpolation=cv2.INTER_AREA)
    shown = cv2.resize(front.astype(np.float32), screen.size, interpolation=cv2.INTER_AREA)
    taken = gain * screen.smaller(screen.colour)
    taken += camera.noise * random.normal(size=taken.shape).astype(np.float32)
    return StreetPhoto(_bytes(taken), _bytes(screen.smaller(behind)), before > 0.5, shown > 0.5)


def _bytes(colour: Colours) -> NDArray[np.uint8]:
    return np.clip(np.rint(colour), 0, 255).astype(np.uint8)


class _Screen:
    """The rays of an image, and what is nearest on each so far: colour, distance, what it is."""

    def __init__(self, camera: StreetCamera, pose: Floats) -> None:
        self.size = (camera.width_px, camera.height_px)
        self.eye, self._turn = pose[:, 3].copy(), pose[:, :3]
        self.focal = camera.focal_px * _FINER
        self.shape = (camera.height_px * _FINER, camera.width_px * _FINER)
        across = (np.arange(self.shape[1]) + 0.5 - self.shape[1] / 2) / self.focal
        down = (np.arange(self.shape[0]) + 0.5 - self.shape[0] / 2) / self.focal
        local = np.stack(np.broadcast_arrays(across[None], down[:, None], 1.0), axis=2)
        local /= np.linalg.norm(local, axis=2, keepdims=True)
        self.rays = local @ self._turn.T
        self.distance = np.full(self.shape, np.inf)
        self.colour = np.zeros((*self.shape, 3), dtype=np.float32)
        self.hidden = np.zeros(self.shape, dtype=bool)

    def smaller(self, colour: Colours) -> Colours:
        """At the size of the image."""
        return np.asarray(cv2.resize(colour, self.size, interpolation=cv2.INTER_AREA))

    def part(self, low: Floats, high: Floats) -> tuple[slice, slice] | None:
        """The rows and columns that can show a box; None where it is behind."""
        corners = np.array([[(low, high)[(n >> k) & 1][k] for k in range(3)] for n in range(8)])
        local = (corners - self.eye) @ self._turn
        if (local[:, 2] < 0.3).all():
            return None
        if (local[:, 2] < 0.3).any():
            return slice(0, self.shape[0]), slice(0, self.shape[1])
        at = local[:, :2] / local[:, 2:] * self.focal + np.array(self.shape[::-1]) / 2
        first = np.clip(np.floor(at.min(axis=0)) - 1, 0, None).astype(int)
        last = np.clip(np.ceil(at.max(axis=0)) + 1, 0, None).astype(int)
        if first[0] >= self.shape[1] or first[1] >= self.shape[0] or (last <= first).any():
            return None
        return slice(first[1], last[1]), slice(first[0], last[0])

    def meet(
        self, part: tuple[slice, slice], distance: Floats
    ) -> tuple[NDArray[np.bool_], Floats, Floats]:
        """Where a surface at (n,) distances of the part's rays is the nearest: (h, w) of the whole,
        and (k, 3) the places there, (k,) how far they are.
        """
        rows = distance.reshape(self.rays[part].shape[:2])
        nearer = rows < self.distance[part]
        chosen = np.zeros(self.shape, dtype=bool)
        chosen[part] = nearer
        away = rows[nearer]
        return chosen, self.eye + away[:, None] * self.rays[part][nearer], away

    def put(
        self, chosen: NDArray[np.bool_], away: Floats, colour: Colours, *, before: bool
    ) -> None:
        """Draw there."""
        self.distance[chosen], self.colour[chosen] = away, colour
        self.hidden[chosen] = before

    def cast(self, part: tuple[slice, slice]) -> tuple[Floats, Floats]:
        """(n, 3) origins and directions of a part's rays."""
        directions = self.rays[part].reshape(-1, 3)
        return np.broadcast_to(self.eye, directions.shape), directions


def _behind(screen: _Screen, street: Street, fronts: Fronts) -> NDArray[np.bool_]:
    """Sky, ground and houses; (h, w) which of it are fronts."""
    up = np.clip(screen.rays[..., 2:], 0.0, 1.0)
    screen.colour[:] = np.array(_SKY_LOW) + up * (np.array(_SKY_HIGH) - np.array(_SKY_LOW))
    whole = (slice(0, screen.shape[0]), slice(0, screen.shape[1]))
    chosen, places, away = screen.meet(whole, rays.to_ground(*screen.cast(whole)))
    screen.put(chosen, away, _ground(places), before=False)
    front = np.zeros(screen.shape, dtype=bool)
    for box in street.walls:
        part = screen.part(*box)
        if part is None:
            continue
        chosen, places, away = screen.meet(part, rays.to_boxes(*screen.cast(part), box[None]))
        if not len(away):
            continue
        facing = np.abs(places[:, 0] - box[1, 0]) < 1e-6
        number = int(fronts.number_at(np.array([box[:, 1].mean()]))[0])
        colour = np.empty((len(away), 3), dtype=np.float32)
        colour[:] = fronts.houses[number].wall * _SIDE
        if box[0, 2] == 0.0:
            seen = places[facing]
            colour[facing] = fronts.colours(seen[:, 1], seen[:, 2], away[facing] / screen.focal)
        else:
            colour[facing] = fronts.houses[number].wall * 0.9
            facing = np.zeros_like(facing)
        screen.put(chosen, away, colour, before=False)
        front[chosen] = facing
    return front


def _before(screen: _Screen, street: Street) -> None:
    """Cars, hedges, trees and lamps."""
    for box in street.objects:
        part = screen.part(*box)
        if part is not None:
            chosen, places, away = screen.meet(part, rays.to_boxes(*screen.cast(part), box[None]))
            screen.put(chosen, away, _box_colour(box, places), before=True)
    for tube in street.cylinders:
        _upright(screen, tube)
    for ball in street.balls:
        _crown(screen, ball)


def _upright(screen: _Screen, tube: Floats) -> None:
    """A trunk, a post or a lamp."""
    x, y, radius, foot, top = tube.tolist()
    part = screen.part(
        np.array([x - radius, y - radius, foot]), np.array([x + radius, y + radius, top])
    )
    if part is None:
        return
    chosen, places, away = screen.meet(part, rays.to_cylinders(*screen.cast(part), tube[None]))
    tone = _BARK if radius > 0.1 else _LAMP
    lit = 0.75 + 0.35 * (places[:, 0] - x) / radius
    grain = 0.9 + 0.2 * _hash(places * [12.0, 12.0, 3.0])
    colour = np.array(tone) * (lit * grain)[:, None]
    screen.put(chosen, away, colour.astype(np.float32), before=True)


def _crown(screen: _Screen, ball: Floats) -> None:
    """A ball of leaves with gaps through which one sees."""
    part = screen.part(ball[:3] - ball[3], ball[:3] + ball[3])
    if part is None:
        return
    distance = rays.to_balls(*screen.cast(part), ball[None])
    met = np.isfinite(distance)
    origins, directions = screen.cast(part)
    places = origins[met] + distance[met, None] * directions[met]
    open_ = np.flatnonzero(met)[_leafy(places) < _GAPS]
    distance[open_] = np.inf
    chosen, places, away = screen.meet(part, distance)
    lit = 0.55 + 0.5 * (places[:, 2] - ball[2]) / ball[3]
    colour = np.array(_LEAF) * (np.clip(lit, 0.25, 1.0) * (0.6 + 0.7 * _leafy(places)))[:, None]
    screen.put(chosen, away, colour.astype(np.float32), before=True)


def _leafy(places: Floats) -> Floats:
    """(n,) a number from 0 to 1 of twigs and of the leaves on them."""
    return 0.55 * _hash(places / _TWIG_M) + 0.45 * _hash(places / _LEAF_M)


def _box_colour(box: Floats, places: Floats) -> Colours:
    """A car's body or cabin, or a hedge, by its size; its top lighter, its sides darker."""
    top = np.abs(places[:, 2] - box[1, 2]) < 1e-6
    light = np.where(top, _TOP, np.where(np.abs(places[:, 0] - box[1, 0]) < 1e-6, 1.0, _SIDE))
    if box[1, 0] - box[0, 0] < 1.0:
        light = light * (0.55 + 0.6 * _hash(places / 0.1))
        return (np.array(_HEDGE) * light[:, None]).astype(np.float32)
    number = int(np.floor(box[0, 1] * 7.0)) % len(_PAINTS)
    tone = np.array(_PAINTS[number] if box[0, 2] < 0.5 else _CABIN)
    return (tone * light[:, None]).astype(np.float32)


def _ground(places: Floats) -> Colours:
    """Asphalt, a kerb, and slabs of half a metre."""
    paved = places[:, 0] < _KERB_M
    tone = np.where(paved[:, None], np.array(_PAVEMENT), np.array(_ASPHALT))
    joint = (np.mod(places[:, :2], 0.5) < 0.02).any(axis=1) & paved
    kerb = np.abs(places[:, 0] - _KERB_M) < 0.08
    light = 0.92 + 0.16 * _hash(np.column_stack([places[:, :2] / 0.06, np.zeros(len(places))]))
    light *= np.where(joint, 0.7, 1.0) * np.where(kerb, 1.3, 1.0)
    return np.asarray(tone * light[:, None], dtype=np.float32)


def _hash(places: Floats) -> Floats:
    """(n,) a number from 0 to 1 of each cell of one, the same for the same cell."""
    cell = np.floor(places).astype(np.int64).astype(np.uint64)
    mixed = cell[:, 0] * np.uint64(73856093) ^ cell[:, 1] * np.uint64(19349663)
    mixed = mixed ^ cell[:, 2] * np.uint64(83492791)
    mixed = (mixed ^ (mixed >> np.uint64(13))) * np.uint64(0x9E3779B97F4A7C15)
    return np.asarray((mixed >> np.uint64(40)).astype(np.float64) / 2.0**24)
