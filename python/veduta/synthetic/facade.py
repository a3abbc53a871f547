"""The entry: a facade with known truth, built, lit and photographed from one seed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.place.part import Part
from veduta.synthetic.build import BuiltFacade, build
from veduta.synthetic.camera import Camera
from veduta.synthetic.layout import STYLES, Layout, Style
from veduta.synthetic.light import Light, daylight
from veduta.synthetic.options import SyntheticOptions
from veduta.synthetic.part import mirrors, to_part
from veduta.synthetic.photo import Lens, develop, encode_jpeg
from veduta.synthetic.render import measure, render
from veduta.synthetic.scene import PlacedPart, RayScene
from veduta.synthetic.seeds import stream
from veduta.synthetic.street import OCCLUDERS, Occluder
from veduta.synthetic.styles import design
from veduta.synthetic.truth import FacadeTruth, elements_of, facade_homography, label_image
from veduta.synthetic.view import street_view


@dataclass(frozen=True)
class SyntheticFacade:
    """A photo and everything about it.

    `photo` (h, w, 3) uint8 sRGB is what the JPEG was made of, `jpeg` the file with its EXIF.
    `part` stands at the world's origin. `depth_m` (h, w) float32, NaN in the sky.
    """

    photo: NDArray[np.uint8]
    jpeg: bytes
    truth: FacadeTruth
    layout: Layout
    part: Part
    camera: Camera
    light: Light
    depth_m: NDArray[np.float32]


def make_facade(seed: int, options: SyntheticOptions | None = None) -> SyntheticFacade:
    """Design a facade, build it with its street, and photograph it; same seed, same bytes."""
    options = options or SyntheticOptions()
    layout = design(options.style, seed, options.floors, options.columns)
    built = build(layout, seed, _occluders(layout, seed, options))
    placed: list[PlacedPart] = [(to_part(built, "facade"), np.eye(4))]
    glass = mirrors(built, "facade")
    if not options.detached:
        for name, house, x_m in _neighbours(layout, seed):
            placed.append((to_part(house, name, as_other=True), _shift(x_m)))
            glass |= mirrors(house, name)
    camera = street_view(layout, seed, options)
    light = _light(seed, options)
    scene = RayScene(placed, glass)
    lens = Lens(options.blur_px, options.vignetting, options.noise, options.jpeg_quality)
    photo = develop(render(scene, camera, light, options.samples, seed), lens, seed)
    truth = _truth(layout, built, placed, camera)
    return SyntheticFacade(
        photo=photo,
        jpeg=encode_jpeg(photo, lens, camera.focal_mm35),
        truth=truth,
        layout=layout,
        part=placed[0][0],
        camera=camera,
        light=light,
        depth_m=measure(scene, camera).depth_m,
    )


def _truth(
    layout: Layout, built: BuiltFacade, placed: list[PlacedPart], camera: Camera
) -> FacadeTruth:
    """Labels are cast against the place and the screens of its openings and balconies."""
    parts = [*placed, (to_part(built, "facade", screens=True), np.eye(4))]
    codes = np.concatenate([part.features.class_code for part, _ in parts])
    labels = label_image(measure(RayScene(parts), camera).feature, codes)
    return FacadeTruth(
        style=layout.style,
        width_m=layout.width_m,
        height_m=layout.height_m,
        storeys=layout.storeys,
        columns=layout.columns,
        elements=elements_of(layout, camera),
        photo_from_facade=facade_homography(camera),
        labels=labels,
    )


def _neighbours(layout: Layout, seed: int) -> list[tuple[str, BuiltFacade, float]]:
    """A house on either side: (name, house, x of its left edge)."""
    rng = stream(seed, "neighbours")
    houses = []
    for number, name in enumerate(("left", "right")):
        style: Style = STYLES[int(rng.integers(len(STYLES)))]
        floors = max(2, layout.storeys + int(rng.integers(-1, 2)))
        plan = design(style, seed + 7919 * (number + 1), floors)
        house = build(plan, seed + 7919 * (number + 1), street=False)
        houses.append((name, house, -plan.width_m if number == 0 else layout.width_m))
    return houses


def _shift(x_m: float) -> NDArray[np.float64]:
    world_from_part = np.eye(4)
    world_from_part[0, 3] = x_m
    return world_from_part


def _occluders(
    layout: Layout, seed: int, options: SyntheticOptions
) -> tuple[tuple[Occluder, float], ...]:
    if not options.occluders:
        return ()
    rng = stream(seed, "occluders")
    places = rng.permutation(np.linspace(0.12, 0.88, len(OCCLUDERS))) * layout.width_m
    return tuple((kind, float(x)) for kind, x in zip(OCCLUDERS, places, strict=True))


def _light(seed: int, options: SyntheticOptions) -> Light:
    """The sun stands over the street (y < 0), to one side, 30 to 55 degrees high."""
    rng = stream(seed, "light")
    azimuth = -np.pi / 2 + float(rng.uniform(0.35, 0.95)) * (1.0 if rng.random() < 0.5 else -1.0)
    elevation = float(rng.uniform(0.55, 0.95))
    return daylight(seed, options.weather == "sunny", azimuth, elevation)
