"""Makes the pictures of docs/styles.md: a row of lots in each style. Part of `make pictures`."""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from pictures import small_jpeg
from PIL import Image

from veduta.grammar.building import build_part
from veduta.grammar.derivation import derive, parse
from veduta.grammar.rules import style_names
from veduta.place.part import Part
from veduta.synthetic.camera import look_at
from veduta.synthetic.light import daylight
from veduta.synthetic.photo import Lens, develop
from veduta.synthetic.render import render
from veduta.synthetic.scene import RayScene

IMAGES = Path(__file__).parent / "images"
SIZE_PX = (960, 600)
MAX_BYTES = 150_000
GROUND = """
@StartRule
Ground --> set(material.name, "ground") color("#8f8d88")
Road --> set(material.name, "ground") color("#6b6b6e") texture("builtin/textures/asphalt")
Pavement -->
    set(material.name, "ground")
    color("#b9b4aa")
    texture("builtin/textures/paving")
    extrude(world.up, 0.12)
    comp(f) { side : Kerb | all : Paved. }
Kerb --> color("#a5a29a") texture("builtin/textures/stone")
"""
REACH_M = 300.0
PAVEMENT_M, ROAD_M = 2.6, 7.0
LENS = Lens(blur_px=0.3, vignetting=0.05, noise=0.0)
Point = tuple[float, float, float]


@dataclass(frozen=True)
class Scene:
    """Lots in a row along x, the street south of them, and a camera (m); `gap_m` between lots."""

    widths_m: tuple[float, ...]
    depth_m: float
    eye_m: Point
    target_m: Point
    gap_m: float = 0.0
    focal: float = 0.75
    first_seed: int = 1


SCENES = {
    "haussmann": Scene((17, 13, 15, 14), 13, (0, -27, 5), (21, 0, 10.5)),
    "louis-xiii": Scene((16, 13, 16), 13, (1, -26, 4), (18, 0, 8.5)),
    "louis-xiv": Scene((25, 15, 15), 14, (0, -26, 3.5), (19, 0, 8.8)),
    "empire": Scene((22, 14, 17), 12, (0, -26, 4), (18, 0, 9)),
    "restauration": Scene((13, 16, 15), 12, (0, -25, 4), (18, 0, 8.5)),
    "victorian": Scene((12, 18, 12), 10, (-1, -16, 3), (13, 0, 5), first_seed=5),
    "gothic-revival": Scene((25, 17, 20), 15, (-7, -25, 2.5), (18, 0, 8.6), gap_m=6, first_seed=9),
    "modern-slab": Scene((42, 26, 30), 12, (-9, -31, 4), (21, 0, 9.5), gap_m=10, first_seed=3),
    "suburban-house": Scene((20, 21, 20), 27, (2, -12, 3.5), (20, 8, 2.6), first_seed=4),
}


def main() -> None:
    """Render the styles that are named, or all."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("styles", nargs="*", help="styles to render; all where none is named")
    for style in parser.parse_args().styles or style_names():
        path = IMAGES / f"style-{style}.jpg"
        path.write_bytes(small_jpeg(_picture(style, SCENES[style]), MAX_BYTES))
        print(f"{path.name}: {path.stat().st_size} bytes")


def _picture(style: str, scene: Scene) -> Image.Image:
    parts = [(part, np.eye(4)) for part in (*_buildings(style, scene), *_ground())]
    camera = look_at(scene.eye_m, scene.target_m, SIZE_PX, scene.focal * SIZE_PX[0])
    light = daylight(3, sunny=True, azimuth_rad=-2.1, elevation_rad=0.75)
    return Image.fromarray(develop(render(RayScene(parts), camera, light, samples=2), LENS, 0))


def _buildings(style: str, scene: Scene) -> list[Part]:
    rules, left = parse(style), 0.0
    parts = []
    for number, width in enumerate(scene.widths_m):
        lot = _rectangle(left, 0.0, left + width, scene.depth_m, 0.0)
        columns = derive(rules, [lot], seed=scene.first_seed + number).columns()
        assets = rules.library.assets_of(columns)
        parts.append(build_part(columns, f"lot-{number}", assets, rules.textures))
        left += width + scene.gap_m
    return parts


def _ground() -> list[Part]:
    """The street before the lots: a carriageway between two pavements, on level ground."""
    rules, low = parse(GROUND), -0.14
    near, far = -PAVEMENT_M, -PAVEMENT_M - ROAD_M
    pieces = {
        "ground": ("Ground", -REACH_M, REACH_M, low - 0.02),
        "road": ("Road", far, near, low),
        "near": ("Pavement", near, 0.0, low),
        "far": ("Pavement", far - PAVEMENT_M, far, low),
    }
    parts = []
    for name, (start, south, north, z) in pieces.items():
        lot = _rectangle(-REACH_M, south, REACH_M, north, z)
        columns = derive(rules, [lot], start=start).columns()
        parts.append(build_part(columns, name, (), rules.textures))
    return parts


def _rectangle(left: float, low: float, right: float, high: float, z: float) -> list[Point]:
    return [(left, low, z), (right, low, z), (right, high, z), (left, high, z)]


if __name__ == "__main__":
    main()
