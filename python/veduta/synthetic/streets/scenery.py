"""A street to look at: built facades, plain houses around, the ground, and what stands about."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from veduta.place.builder import PartBuilder, UvMap
from veduta.place.material import Material, Texture
from veduta.place.part import Part
from veduta.place.semantics import Provenance, SemanticClass
from veduta.synthetic.build import BuiltFacade, build
from veduta.synthetic.camera import Camera
from veduta.synthetic.light import Light, daylight
from veduta.synthetic.looks import Look
from veduta.synthetic.mesh import Mesh, MeshBuilder
from veduta.synthetic.noise import fractal_noise, grain, value_noise
from veduta.synthetic.part import mirrors, to_part
from veduta.synthetic.scene import PlacedPart, RayScene
from veduta.synthetic.seeds import stream
from veduta.synthetic.street import Occluder, add_occluder, street_looks
from veduta.synthetic.streets.house import House, Street
from veduta.synthetic.textures import render_coat

GROUND_M = 130.0
"""Side of the square of ground that photos show."""
GROUND_PX_PER_M = 16.0
GABLE_M, GABLE_PX_PER_M = 24.0, 40.0
CLEAR_M = {"tree": 2.4, "lamp": 1.5, "car": 2.7}
"""Nobody takes a photo from as near to one of them as this."""
CAR_TO_WALL_M = 1.9
"""How far a car is moved from the kerb towards the wall: onto the pavement, off the lane."""
_STAND = np.eye(4)


def street_scenery(street: Street, cameras: Sequence[Camera]) -> tuple[RayScene, Light]:
    """All of the street for rays, and the light of its day; nothing stands in a photo's way."""
    placed: list[PlacedPart] = [(_ground(street.seed), _STAND)]
    glass: dict[str, NDArray[np.uint8]] = {}
    centres = np.array([camera.position_m[:2] for camera in cameras])
    for house in street.houses:
        if house.layout is None:
            continue
        built = build(house.layout, house.seed, street=False)
        if house.four_sided:
            part = to_part(_front_only(built), house.id)
            placed += [(part, house.world_from_front(side)) for side in range(4)]
        else:
            built = _with_gables(built, house)
            placed.append((to_part(built, house.id), house.world_from_front()))
        glass |= mirrors(built, house.id)
    placed += [(plain_house(house), _STAND) for house in street.others]
    for number, house in enumerate(street.houses):
        parts, shine = _clutter(house, number, street.seed, centres)
        placed += parts
        glass |= shine
    return RayScene(placed, glass), street_light(street.seed)


def _front_only(built: BuiltFacade) -> BuiltFacade:
    """The same without sides and back, which other fronts close."""
    mesh = built.mesh
    kept = mesh.material != built.materials.index("side")
    corners = np.repeat(kept, np.diff(mesh.start))
    front = Mesh(
        mesh.positions[corners],
        mesh.uv[corners],
        np.concatenate([[0], np.cumsum(np.diff(mesh.start)[kept])]),
        mesh.material[kept],
        mesh.feature[kept],
    )
    return replace(built, mesh=front)


def _with_gables(built: BuiltFacade, house: House) -> BuiltFacade:
    """The same with sides and back that are nowhere alike, as weather leaves them."""
    before = built.looks["side"].tile_m
    look = Look(gable_texture(house.seed), None, (GABLE_M, GABLE_M))
    mesh = built.mesh
    side = built.materials.index("side")
    faces = np.repeat(mesh.material, np.diff(mesh.start)) == side
    uv = mesh.uv.copy()
    uv[faces] *= np.array(before) / GABLE_M
    # Each side has another part of the texture.
    uv[faces] += 0.37 * np.repeat(np.arange(len(mesh.material)), np.diff(mesh.start))[faces, None]
    looks = {**built.looks, "side": look}
    return replace(built, mesh=replace(mesh, uv=uv), looks=looks)


def gable_texture(seed: int) -> NDArray[np.uint8]:
    """(h, w, 3) uint8 sRGB: plaster with stains, repairs and what is left of older paint."""
    rng = stream(seed, "gable")
    side = round(GABLE_M * GABLE_PX_PER_M)
    shape = (side, side)
    shade = 1.0 + 0.10 * fractal_noise(rng, shape, 1.5 * GABLE_PX_PER_M, 6)
    shade += 0.025 * grain(rng, shape)
    streaks = value_noise(rng, shape, (5.0 * GABLE_PX_PER_M, 0.3 * GABLE_PX_PER_M))
    shade -= 0.12 * np.clip(streaks, 0.0, 1.0)
    repairs = value_noise(rng, shape, (1.4 * GABLE_PX_PER_M, 1.1 * GABLE_PX_PER_M))
    shade += 0.10 * (repairs > 0.5) - 0.14 * (repairs < -0.6)
    light, warm = float(rng.uniform(0.5, 0.75)), float(rng.uniform(0.86, 0.97))
    colour = light * np.array([1.0, warm, warm**2])
    return np.asarray(np.clip(np.rint(255 * shade[..., None] * colour), 0, 255), np.uint8)


def street_light(seed: int) -> Light:
    """Sun from anywhere but the horizon and the zenith; every other day is overcast."""
    rng = stream(seed, "street light")
    azimuth, elevation = float(rng.uniform(0.0, 2 * np.pi)), float(rng.uniform(0.6, 1.0))
    return daylight(seed, bool(rng.random() < 0.5), azimuth, elevation)


def plain_house(house: House) -> Part:
    """A rendered block without openings, in the world's frame."""
    rng = stream(house.seed, f"plain {house.id}")
    light, warm = float(rng.uniform(0.5, 0.8)), float(rng.uniform(0.8, 0.97))
    texture = render_coat(rng, 8.0, 8.0, (light, light * warm, light * warm**2))
    builder = PartBuilder(house.id)
    coat = builder.material(_material(f"{house.id} coat", texture))
    wall = builder.feature(SemanticClass.OTHER, Provenance.MEASURED, "walls")
    outline, low, high = house.outline_m, 0.0, house.top_m
    for number, start in enumerate(outline):
        end = outline[(number + 1) % len(outline)]
        along = (end - start) / np.linalg.norm(end - start)

        def in_tiles(
            points: NDArray[np.float64], along: NDArray[np.float64] = along
        ) -> NDArray[np.float64]:
            return np.stack([points[:, :2] @ along, -points[:, 2]], axis=1) / 8.0

        ring = [(*start, low), (*end, low), (*end, high), (*start, high)]
        builder.polygon([ring], wall, coat, in_tiles)
    builder.polygon([[(*corner, high) for corner in outline]], wall, coat)
    return builder.build()


def _ground(seed: int) -> Part:
    """Asphalt with patches, stains and cracks that are nowhere the same."""
    builder = PartBuilder("ground")
    surface = builder.material(_material("ground", ground_texture(seed)))
    feature = builder.feature(SemanticClass.GROUND, Provenance.MEASURED, "ground")
    r = GROUND_M / 2
    ring = [(-r, -r, 0.0), (r, -r, 0.0), (r, r, 0.0), (-r, r, 0.0)]

    def over_all(points: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.stack([points[:, 0] / GROUND_M + 0.5, 0.5 - points[:, 1] / GROUND_M], axis=1)

    builder.polygon([ring], feature, surface, over_all)
    return builder.build()


def ground_texture(seed: int) -> NDArray[np.uint8]:
    """(h, w, 3) uint8 sRGB of the whole square of ground."""
    rng = stream(seed, "ground")
    side = round(GROUND_M * GROUND_PX_PER_M)
    shape = (side, side)
    shade = 1.0 + 0.10 * fractal_noise(rng, shape, 6.0 * GROUND_PX_PER_M, 6)
    shade += 0.05 * grain(rng, shape)
    patches = value_noise(rng, shape, (3.0 * GROUND_PX_PER_M, 3.0 * GROUND_PX_PER_M))
    shade -= 0.12 * (patches > 0.55)
    stains = fractal_noise(rng, shape, 1.2 * GROUND_PX_PER_M, 3)
    shade -= 0.5 * np.clip(stains - 0.35, 0.0, 0.5)
    cracks = np.abs(fractal_noise(rng, shape, 4.0 * GROUND_PX_PER_M, 4))
    shade -= 0.25 * (cracks < 0.012)
    colour = np.array([0.46, 0.455, 0.44])
    return np.asarray(np.clip(np.rint(255 * shade[..., None] * colour), 0, 255), np.uint8)


def _clutter(
    house: House, number: int, seed: int, centres: NDArray[np.float64]
) -> tuple[list[PlacedPart], dict[str, NDArray[np.uint8]]]:
    """Up to two things before a house, where no photo is taken."""
    rng = stream(seed, f"clutter {number}")
    looks = street_looks(seed + number)
    parts: list[PlacedPart] = []
    glass: dict[str, NDArray[np.uint8]] = {}
    kinds: tuple[Occluder, ...] = ("tree", "lamp", "car")
    for kind in kinds:
        share, wanted = float(rng.uniform(0.15, 0.85)), float(rng.random())
        if wanted > 0.6 or len(parts) == 2:
            continue
        shift = np.eye(4)
        shift[1, 3] = CAR_TO_WALL_M if kind == "car" else 0.0
        x = share * house.width_m
        world_from_part = house.world_from_front() @ shift
        world_from_part[2, 3] = 0.13 if kind == "car" else 0.0
        depth = -4.3 if kind == "car" else -2.7
        middle = (world_from_part @ np.array([x, depth, 0.0, 1.0]))[:2]
        if np.linalg.norm(centres - middle, axis=1).min() < CLEAR_M[kind]:
            continue
        name = f"{kind} {number}"
        builder = MeshBuilder({key: look.tile_m for key, look in looks.items()})
        add_occluder(builder, kind, x, seed + 31 * number, 0)
        parts.append((_thing(builder, name, looks), world_from_part))
        for key in builder.materials:
            mirror = looks[key].mirror
            if mirror is not None:
                glass[f"{name} {key}"] = mirror
    return parts, glass


def _thing(builder: MeshBuilder, name: str, looks: dict[str, Look]) -> Part:
    mesh = builder.mesh()
    part = PartBuilder(name)
    feature = part.feature(SemanticClass.OTHER, Provenance.MEASURED, "thing")
    materials = [
        part.material(_material(f"{name} {key}", looks[key].texture)) for key in builder.materials
    ]
    for face, (first, last) in enumerate(pairwise(mesh.start.tolist())):
        ring, uv = mesh.positions[first:last], mesh.uv[first:last]
        part.polygon([ring], feature, materials[int(mesh.material[face])], _known(uv))
    return part.build()


def _known(uv: NDArray[np.float64]) -> UvMap:
    return lambda points: uv


def _material(name: str, texture: NDArray[np.uint8]) -> Material:
    known = np.zeros(texture.shape[:2], np.bool_)
    return Material(name, roughness=0.9, texture=Texture(texture, known))
