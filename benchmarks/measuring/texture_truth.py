"""A yard of a few houses with painted fronts whose photos are known: the truth of textures.

Houses are boxes; all that is on their walls is painted on. Trees, cars and lamps stand before them
that the city model does not have. Cameras are known exactly, and told with errors where asked.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.imaging.srgb import srgb_of_linear
from veduta.photos.city.model import CityBuilding, CityModel
from veduta.photos.straight import Pinhole
from veduta.photos.texture.views import View
from veduta.place.builder import PartBuilder, UvMap
from veduta.place.material import Material, Texture
from veduta.place.part import Part
from veduta.place.semantics import Provenance, SemanticClass
from veduta.synthetic.camera import Camera, look_at
from veduta.synthetic.light import daylight
from veduta.synthetic.mesh import MeshBuilder
from veduta.synthetic.panes import WindowLook, window
from veduta.synthetic.render import render
from veduta.synthetic.scene import PlacedPart, RayScene
from veduta.synthetic.seeds import stream
from veduta.synthetic.street import OCCLUDERS, add_ground, add_occluder, street_looks
from veduta.synthetic.textures import Image, ashlar, brick, render_coat

PX_PER_M = 60.0
STREET_M = 11.0
Box = tuple[float, float, float, float, float]
"""West, south, east, north (m) and height."""
HOUSES: tuple[Box, ...] = (
    (-17.0, 0.0, -5.0, 9.0, 10.0),
    (-5.0, 1.5, 6.0, 10.0, 13.0),
    (9.0, 0.0, 20.0, 10.0, 8.5),
)
"""The second stands back a little, the third stands alone."""


@dataclass(frozen=True)
class Yard:
    """What stands there. scene: with all that is real; bare: the houses alone."""

    city: CityModel
    scene: RayScene
    bare: RayScene
    seed: int


def make_yard(seed: int, *, occluders: bool = True) -> Yard:
    """Houses with their own fronts, and things that stand before them."""
    parts = [_house(number, box, seed) for number, box in enumerate(HOUSES)]
    placed: list[PlacedPart] = [(part, np.eye(4)) for part in parts]
    around = _street(seed, occluders)
    plain = tuple(
        CityBuilding(part.id, replace(part, materials=(Material("plain"),) * 5), (0.0, 0.0, 0.0))
        for part in parts
    )
    city = CityModel(plain, None, (0.0, 0.0, 0.0))
    return Yard(city, RayScene([*placed, (around, np.eye(4))]), RayScene(placed), seed)


def _house(number: int, box: Box, seed: int) -> Part:
    """A box with four painted walls, a flat roof and a ground."""
    west, south, east, north, top = box
    builder = PartBuilder(f"house-{number}")
    rng = stream(seed, f"house {number}")
    ring = [(west, south), (east, south), (east, north), (west, north)]
    for side, ((x0, y0), (x1, y1)) in enumerate(zip(ring, ring[1:] + ring[:1], strict=True)):
        width = float(np.hypot(x1 - x0, y1 - y0))
        front = _front(rng, width, top)
        known = np.zeros(front.shape[:2], dtype=np.bool_)
        material = builder.material(Material(f"wall {side}", texture=Texture(front, known)))
        feature = builder.feature(SemanticClass.WALL, Provenance.MEASURED, f"wall {side}")
        corners = [(x0, y0, 0.0), (x1, y1, 0.0), (x1, y1, top), (x0, y0, top)]
        builder.polygon([corners], feature, material, _given(np.array(_SQUARE)))
    roof = builder.material(Material("roof", colour=(0.4, 0.38, 0.36)))
    for semantic, height, order in (
        (SemanticClass.ROOF, top, ring),
        (SemanticClass.GROUND, 0.0, ring[::-1]),
    ):
        feature = builder.feature(semantic, Provenance.MEASURED, semantic.value)
        builder.polygon([[(x, y, height) for x, y in order]], feature, roof)
    return builder.build()


_SQUARE = [(0.0, 1.0), (1.0, 1.0), (1.0, 0.0), (0.0, 0.0)]


def _front(rng: np.random.Generator, width_m: float, height_m: float) -> Image:
    """A wall with windows in rows."""
    tone = tuple(rng.uniform(0.45, 0.8) * np.array([1.0, 0.95, 0.85]) * rng.uniform(0.9, 1.05, 3))
    kind = int(rng.integers(3))
    wall = (
        ashlar(rng, width_m, height_m, tone)
        if kind == 0
        else brick(rng, width_m, height_m, (0.55, 0.3, 0.22), (0.7, 0.68, 0.62))
        if kind == 1
        else render_coat(rng, width_m, height_m, tone)
    )
    size = (round(width_m * PX_PER_M), round(height_m * PX_PER_M))
    wall = np.asarray(cv2.resize(wall, size, interpolation=cv2.INTER_AREA), dtype=np.uint8)
    floors, axes = max(2, int(height_m // 3.1)), max(2, int(width_m // 2.7))
    for floor in range(floors):
        for axis in range(axes):
            look = WindowLook("sash", (0.9, 0.9, 0.88), "sheer", tuple(rng.uniform(0.3, 0.9, 3)))
            pane = window(rng, 1.2, 1.7, look)[..., :3]
            shown = cv2.resize(pane, (round(1.2 * PX_PER_M), round(1.7 * PX_PER_M)))
            x = round(((axis + 0.5) * width_m / axes - 0.6) * PX_PER_M)
            y = round((height_m - floor * height_m / floors - 2.7) * PX_PER_M)
            wall[y : y + shown.shape[0], x : x + shown.shape[1]] = shown
    return wall


def _street(seed: int, occluders: bool) -> Part:
    """The ground, and a tree, a car and a lamp before each house."""
    looks = street_looks(seed)
    builder = MeshBuilder({name: look.tile_m for name, look in looks.items()})
    add_ground(builder, 0)
    if occluders:
        rng = stream(seed, "things")
        for number, (west, _, east, _, _) in enumerate(HOUSES):
            for turn, kind in enumerate(OCCLUDERS):
                share = (turn + rng.uniform(0.25, 0.75)) / len(OCCLUDERS)
                add_occluder(builder, kind, west + share * (east - west), seed + number, 0)
    mesh = builder.mesh()
    part = PartBuilder("street")
    part.feature(SemanticClass.OTHER, Provenance.MEASURED, "street")
    for name in builder.materials:
        texture = looks[name].texture
        part.material(Material(name, texture=Texture(texture, np.zeros(texture.shape[:2], bool))))
    for number in range(len(mesh.feature)):
        own = slice(int(mesh.start[number]), int(mesh.start[number + 1]))
        part.polygon([mesh.positions[own]], 0, int(mesh.material[number]), _given(mesh.uv[own]))
    return part.build()


def _given(uv: NDArray[np.float64]) -> UvMap:
    return lambda _: uv


@dataclass(frozen=True)
class Exposures:
    """How differently photos are taken: deviations of the logarithm, common and per channel."""

    common: float = 0.25
    channel: float = 0.05
    noise: float = 0.008
    vignetting: float = 0.08


@dataclass(frozen=True)
class Shot:
    """A photo, and where it was really taken."""

    pixels: NDArray[np.uint8]
    camera: Camera


def take_shots(
    yard: Yard, count: int, seed: int, exposures: Exposures, size_px: tuple[int, int] = (960, 720)
) -> list[Shot]:
    """Photos from the street and from the ends, each exposed in its own way; the same day."""
    rng = stream(seed, "shots")
    light = daylight(seed, False, -1.2, 0.8)
    shots = []
    for number in range(count):
        along = -24.0 + 52.0 * (number + rng.uniform(0.2, 0.8)) / count
        eye = (along, -STREET_M - rng.uniform(0.0, 5.0), 1.7)
        target = (along + rng.uniform(-7.0, 7.0), 1.0, rng.uniform(3.5, 5.5))
        camera = look_at(eye, target, size_px, 0.72 * size_px[0], rng.uniform(-0.02, 0.02))
        radiance = render(yard.scene, camera, light, 2, seed + number)
        gain = (
            np.exp(rng.normal(0.0, exposures.common) + rng.normal(0.0, exposures.channel, 3)) * 0.62
        )
        shots.append(Shot(_developed(radiance, gain, exposures, rng), camera))
    return shots


def _developed(
    radiance: NDArray[np.float32],
    gain: NDArray[np.float64],
    exposures: Exposures,
    rng: np.random.Generator,
) -> NDArray[np.uint8]:
    height, width = radiance.shape[:2]
    y, x = np.indices((height, width), dtype=np.float32)
    radius2 = ((x + 0.5) / width - 0.5) ** 2 + ((y + 0.5) / height - 0.5) ** 2
    light = radiance * gain * (1.0 - 2.0 * exposures.vignetting * radius2)[..., None]
    light = cv2.GaussianBlur(light.astype(np.float32), (0, 0), 0.5)
    light = light + exposures.noise * np.sqrt(
        np.clip(light, 0.0, None) + 0.01
    ) * rng.standard_normal(light.shape)
    return np.asarray(np.rint(srgb_of_linear(np.clip(light, 0.0, 1.0)) * 255.0), dtype=np.uint8)


def views_of_shots(
    shots: Sequence[Shot], seed: int, shift_m: float = 0.0, turn_rad: float = 0.0
) -> list[View]:
    """The shots as views whose places are off: deviations along each axis, about each axis."""
    rng = stream(seed, "errors")
    found = []
    for number, shot in enumerate(shots):
        turn = cv2.Rodrigues(rng.normal(0.0, turn_rad, 3) if turn_rad else np.zeros(3))[0]
        rotation = turn @ shot.camera.cam_from_world[:3, :3]
        eye = shot.camera.position_m + rng.normal(0.0, 1.0, 3) * shift_m
        pose = np.column_stack([rotation, -rotation @ eye])
        found.append(View(f"shot {number}", pinhole_of(shot.camera), pose, _holding(shot.pixels)))
    return found


def pinhole_of(camera: Camera) -> Pinhole:
    """The same camera under its other name."""
    focal = (camera.focal_px, camera.focal_px)
    return Pinhole(camera.width_px, camera.height_px, focal, camera.centre_px)


def _holding(pixels: NDArray[np.uint8]) -> Callable[[], NDArray[np.uint8]]:
    return lambda: pixels
