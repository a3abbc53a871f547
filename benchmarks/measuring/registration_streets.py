"""Simulated streets in a town of boxes: what structure from motion and the walls would say of them.

Nothing is rendered. Points lie on the facades that cameras along a street see past the other
buildings, on the ground, and on clutter; the walls are the facades with the faults that a finder
makes: rough edges, parts, neighbours in one plane as one, some missing and some that are none.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pycolmap
from numpy.typing import NDArray

from veduta.photos.cameras.orient import transformed
from veduta.photos.city.facades import Facades, facades_of
from veduta.photos.city.model import CityBuilding, CityModel
from veduta.photos.city.outlines import prism
from veduta.photos.city.parts import building_of
from veduta.photos.structure import Structure
from veduta.photos.walls.wall import Wall
from veduta.photos.world.georeference import Similarity

STREET_M = 15.0
FIELD_RAD = np.deg2rad(33.0)
FARTHEST_M = 45.0


@dataclass(frozen=True)
class SimulatedStreet:
    """What was photographed, in a frame of its own, and where it is in truth.

    centres_gps: (n, 3) what GPS says, metres about the model's origin. removed: the model without
    the buildings of the street.
    """

    structure: Structure
    walls: tuple[Wall, ...]
    model: CityModel
    removed: CityModel
    world_from_model: Similarity
    centres_gps: NDArray[np.float64]


def simulated_street(
    seed: int, *, streets: int = 4, per_side: int = 12, seen: int = 4, sides: int = 2
) -> SimulatedStreet:
    """A town of `streets` streets with `per_side` buildings a side; `seen` of a side in one.

    sides: 1 where the photos show one side only (of twice as many buildings).
    """
    rng = np.random.default_rng(seed)
    boxes, middle = _town(rng, streets, per_side)
    turn = rng.uniform(0.0, 2.0 * np.pi)
    real = [_building(number, box, turn) for number, box in enumerate(boxes)]
    buildings = [_building(number, _drawn(rng, box), turn) for number, box in enumerate(boxes)]
    street = int(rng.integers(streets))
    count = seen if sides == 2 else 2 * seen
    first = int(rng.integers(0, per_side - count + 1))
    base = 2 * per_side * street
    chosen = list(range(base + first, base + first + count))
    if sides == 2:
        chosen += _opposite(boxes, chosen, base + per_side, per_side)
    low = min(boxes[number][0] for number in chosen)
    high = max(boxes[number][0] + boxes[number][2] for number in chosen)
    model = CityModel(tuple(buildings), "EPSG:25832", (500_000.0, 5_500_000.0, 100.0))
    facades = facades_of(CityModel(tuple(real), model.crs, model.origin_m))
    photos = 40
    along = np.linspace(low - 3.0, high + 3.0, photos)
    flat = np.column_stack([along, middle[street] + rng.uniform(-2.5, 2.5, photos)])
    side = np.where(np.arange(photos) % 2 == 0, 1.0, -1.0) if sides == 2 else np.ones(photos)
    look = np.column_stack([rng.uniform(-0.8, 0.8, photos), side])
    rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    centres = np.column_stack([flat @ rotation.T, 1.6 + rng.uniform(-0.1, 0.4, photos)])
    look = look @ rotation.T
    look /= np.linalg.norm(look, axis=1)[:, None]
    points, facade_of = _points(rng, facades, centres)
    seen_by = _visible(points, facade_of, centres, look, facades)
    kept = seen_by.sum(axis=0) >= 2
    points, facade_of, seen_by = points[kept], facade_of[kept], seen_by[:, kept]
    near = np.array([np.linalg.norm(centres - p, axis=1).min() for p in points])
    points = points + rng.standard_normal(points.shape) * (0.02 + 0.003 * near)[:, None]
    truth = _structure(points, centres, look, seen_by)
    walls = _walls(rng, points, facade_of, facades)
    world_from_model = _similarity(rng, centres)
    structure, own_walls = _in_own_frame(truth, walls, world_from_model)
    common = rng.standard_normal(3) * (2.5, 2.5, 8.0)
    gps = centres + common + rng.standard_normal(centres.shape) * (2.5, 2.5, 4.0)
    keep = [one for number, one in enumerate(buildings) if number not in set(chosen)]
    removed = CityModel(tuple(keep), model.crs, model.origin_m)
    return SimulatedStreet(structure, own_walls, model, removed, world_from_model, gps)


_Box = tuple[float, float, float, float, float]
"""x, y, width, depth, height."""


def _town(rng: np.random.Generator, streets: int, per_side: int) -> tuple[list[_Box], list[float]]:
    boxes: list[_Box] = []
    middles = []
    for street in range(streets):
        middle = 60.0 * street + rng.uniform(-3.0, 3.0)
        middles.append(middle)
        for side in (1.0, -1.0):
            x, back = rng.uniform(0.0, 5.0), 0.0
            for _ in range(per_side):
                width, depth = rng.uniform(6.0, 14.0), rng.uniform(8.0, 12.0)
                back = back if rng.random() < 0.4 else float(rng.uniform(0.0, 1.5))
                front = middle + side * (STREET_M / 2.0 + back)
                height = float(np.round(rng.uniform(6.0, 18.0), 1))
                boxes.append((x, front if side > 0 else front - depth, width, depth, height))
                x += width + (0.0 if rng.random() < 0.6 else rng.uniform(1.0, 4.0))
    return boxes, middles


def _drawn(rng: np.random.Generator, box: _Box) -> _Box:
    """As a model of LoD1 has it: a decimetre wrong."""
    x, y, width, depth, height = np.array(box) + 0.07 * rng.standard_normal(5)
    return float(x), float(y), float(width), float(depth), float(height)


def _opposite(boxes: list[_Box], chosen: list[int], first: int, count: int) -> list[int]:
    """The buildings of the other side that lie opposite."""
    low = min(boxes[number][0] for number in chosen)
    high = max(boxes[number][0] + boxes[number][2] for number in chosen)
    return [
        number
        for number in range(first, first + count)
        if boxes[number][0] + boxes[number][2] > low and boxes[number][0] < high
    ]


def _building(number: int, box: _Box, turn: float) -> CityBuilding:
    x, y, width, depth, height = box
    ring = np.array([[x, y], [x + width, y], [x + width, y + depth], [x, y + depth]])
    rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    base = np.column_stack([ring @ rotation.T, np.zeros(4)])
    polygons, classes = prism([base], height)
    building, _ = building_of(f"b{number}", polygons, classes, {}, solid=True)
    return building


def _points(
    rng: np.random.Generator, facades: Facades, centres: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """(p, 3) points and the facade of each; -1 on the ground and on clutter."""
    middle = centres[:, :2].mean(axis=0)
    reach = np.linalg.norm(centres[:, :2] - middle, axis=1).max() + FARTHEST_M
    near = np.flatnonzero(np.linalg.norm(facades.middle - middle, axis=1) < reach)
    area = facades.width[near] * (facades.top - facades.bottom)[near]
    row = rng.choice(near, 14000, p=area / area.sum())
    share, rise = rng.random(len(row)), rng.uniform(0.02, 0.99, len(row))
    flat = facades.start[row] + share[:, None] * (facades.end - facades.start)[row]
    height = facades.bottom[row] + rise * (facades.top - facades.bottom)[row]
    low, high = centres[:, :2].min(axis=0) - 5.0, centres[:, :2].max(axis=0) + 5.0
    other = rng.uniform(low, high, (800, 2))
    level = np.where(rng.random(800) < 0.5, 0.0, rng.uniform(0.0, 3.0, 800))
    points = np.concatenate([np.column_stack([flat, height]), np.column_stack([other, level])])
    return points, np.concatenate([row, np.full(800, -1)])


def _visible(
    points: NDArray[np.float64],
    facade_of: NDArray[np.int64],
    centres: NDArray[np.float64],
    look: NDArray[np.float64],
    facades: Facades,
) -> NDArray[np.bool_]:
    """(n, p) which camera sees which point: ahead, near, from outside, past all walls."""
    found = np.zeros((len(centres), len(points)), dtype=bool)
    on = facade_of >= 0
    for row, (centre, ahead) in enumerate(zip(centres, look, strict=True)):
        ray = points[:, :2] - centre[:2]
        far = np.linalg.norm(ray, axis=1)
        sees = (ray @ ahead > np.cos(FIELD_RAD) * far) & (far < FARTHEST_M) & (far > 1.0)
        outward = np.zeros_like(ray)
        outward[on] = facades.outward[facade_of[on]]
        cosine = -(ray * outward).sum(axis=1) / np.maximum(far, 1e-9)
        sees &= ~on | (cosine > 0.15)
        asked = np.flatnonzero(sees)
        sees[asked] = ~_blocked(centre, points[asked], facades)
        found[row] = sees
    return found


def _blocked(
    centre: NDArray[np.float64], points: NDArray[np.float64], facades: Facades
) -> NDArray[np.bool_]:
    """(p,) whether a wall stands between."""
    edge = facades.end - facades.start
    ray = points[:, None, :2] - centre[:2]
    gap = facades.start[None] - centre[:2]
    cross = ray[..., 0] * edge[:, 1] - ray[..., 1] * edge[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        share = (gap[..., 0] * edge[:, 1] - gap[..., 1] * edge[:, 0]) / cross
        place = (gap[..., 0] * ray[..., 1] - gap[..., 1] * ray[..., 0]) / cross
    height = centre[2] + share * (points[:, 2, None] - centre[2])
    hits = (share > 0.0) & (share < 0.995) & (place > 0.0) & (place < 1.0)
    found: NDArray[np.bool_] = (hits & (height < facades.top)).any(axis=1)
    return found


def _structure(
    points: NDArray[np.float64],
    centres: NDArray[np.float64],
    look: NDArray[np.float64],
    seen_by: NDArray[np.bool_],
) -> Structure:
    """Columns without lenses' faults: what is seen is what projects."""
    camera = pycolmap.Camera(
        camera_id=1, model="PINHOLE", width=1600, height=1200, params=[1200, 1200, 800, 600]
    )
    poses, keypoints, photos, keys, numbers = [], [], [], [], []
    for row, (centre, (east, north)) in enumerate(zip(centres, look, strict=True)):
        ahead = np.array([east, north, 0.0])
        rotation = np.stack([np.cross(ahead, [0, 0, 1.0]), [0, 0, -1.0], ahead])
        pose = np.column_stack([rotation, -rotation @ centre])
        own = np.flatnonzero(seen_by[row])
        poses.append(pose)
        keypoints.append(camera.img_from_cam(points[own] @ rotation.T + pose[:, 3]))
        photos.append(np.full(len(own), row))
        keys.append(np.arange(len(own)))
        numbers.append(own)
    ids = tuple(range(1, len(centres) + 1))
    return Structure(
        cameras={1: camera},
        camera_of=dict.fromkeys(ids, 1),
        image_ids=ids,
        names=tuple(f"{number:03d}.jpg" for number in ids),
        cam_from_world=np.array(poses),
        keypoints_px=tuple(keypoints),
        points=points,
        colours=np.full((len(points), 3), 128, dtype=np.uint8),
        image_of=np.concatenate(photos).astype(np.int64),
        keypoint_of=np.concatenate(keys).astype(np.int64),
        point_of=np.concatenate(numbers).astype(np.int64),
    )


_Rough = tuple[NDArray[np.float64], NDArray[np.float64], float, float, NDArray[np.int64], float]


def _walls(
    rng: np.random.Generator,
    points: NDArray[np.float64],
    facade_of: NDArray[np.int64],
    facades: Facades,
) -> list[_Rough]:
    """Start, end, bottom, top, points and rms of each wall, in the world."""
    found: list[_Rough] = []
    done: set[int] = set()
    for facade in np.unique(facade_of[facade_of >= 0]).tolist():
        if facade in done or rng.random() < 0.12:
            continue
        group = [facade]
        for other in np.unique(facade_of[facade_of >= 0]).tolist():
            if other not in done and other != facade and _continues(facades, group[-1], other):
                group.append(other)
        done.update(group)
        rows = np.flatnonzero(np.isin(facade_of, group))
        if len(rows) < 30:
            continue
        along, outward = facades.along[facade], facades.outward[facade]
        place = points[rows, :2] @ along
        off = points[rows, :2] @ outward
        low, high = np.quantile(place, [0.005, 0.995])
        if high - low < 2.5:
            continue
        heights = points[rows, 2]
        shift = float(np.median(off)) + 0.04 * rng.standard_normal()
        lean = np.deg2rad(0.25) * rng.standard_normal() * (high - low) / 2.0
        low, high = low + 0.15 * rng.standard_normal(), high + 0.15 * rng.standard_normal()
        start = low * along + (shift - lean) * outward
        end = high * along + (shift + lean) * outward
        rms = float(np.sqrt(np.mean((off - np.median(off)) ** 2)))
        found.append((start, end, float(heights.min()), float(heights.max()), rows, rms))
    middle, reach = points[:, :2].mean(axis=0), 0.4 * np.ptp(points[:, :2], axis=0)
    for _ in range(2):
        place = middle + rng.uniform(-1.0, 1.0, 2) * reach
        way = rng.standard_normal(2)
        way *= rng.uniform(3.0, 7.0) / np.linalg.norm(way)
        near = np.argsort(np.linalg.norm(points[:, :2] - place, axis=1))[:20]
        found.append((place, place + way, 0.0, float(rng.uniform(2.0, 5.0)), near, 0.1))
    return sorted(found, key=lambda wall: -len(wall[4]))


def _continues(facades: Facades, one: int, other: int) -> bool:
    """Whether a finder would take two facades for one: in one plane, side by side, as high."""
    gap = facades.start[one] - facades.end[other]
    apart = abs(float((facades.start[other] - facades.start[one]) @ facades.outward[one]))
    turned = float(facades.outward[one] @ facades.outward[other])
    beside = float(np.linalg.norm(gap)) < 0.2
    alike = abs(float(facades.top[one] - facades.top[other])) < 1.0
    return turned > 0.999 and apart < 0.1 and beside and alike


def _similarity(rng: np.random.Generator, centres: NDArray[np.float64]) -> Similarity:
    """From a frame of its own, whose up is some half degree wrong, to the world."""
    yaw, scale = rng.uniform(0.0, 2.0 * np.pi), float(np.exp(rng.uniform(-0.7, 0.7)))
    lean = np.deg2rad(0.4) * rng.standard_normal(2)
    c, s = np.cos(yaw), np.sin(yaw)
    turn = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]])
    tilt_x = np.array(
        [[1, 0, 0], [0, np.cos(lean[0]), -np.sin(lean[0])], [0, np.sin(lean[0]), np.cos(lean[0])]]
    )
    tilt_y = np.array(
        [[np.cos(lean[1]), 0, np.sin(lean[1])], [0, 1, 0], [-np.sin(lean[1]), 0, np.cos(lean[1])]]
    )
    return Similarity(scale, turn @ tilt_x @ tilt_y, centres.mean(axis=0))


def _in_own_frame(
    truth: Structure, walls: list[_Rough], world_from_model: Similarity
) -> tuple[Structure, tuple[Wall, ...]]:
    back = world_from_model.rotation.T
    scale = 1.0 / world_from_model.scale
    structure = transformed(truth, scale, back, -scale * back @ world_from_model.shift)
    found = []
    for number, (start, end, bottom, top, rows, rms) in enumerate(walls):
        corners = np.array([[*start, bottom], [*end, bottom], [*end, top], [*start, top]])
        own = scale * (corners - world_from_model.shift) @ world_from_model.rotation
        found.append(
            Wall(
                id=f"w{number:03d}",
                start=(own[0, :2] + own[3, :2]) / 2.0,
                end=(own[1, :2] + own[2, :2]) / 2.0,
                bottom=float(own[:2, 2].mean()),
                top=float(own[2:, 2].mean()),
                point_rows=rows.astype(np.int64),
                rms=rms * scale,
            )
        )
    return structure, tuple(found)
