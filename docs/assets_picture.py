"""Makes the picture of docs/assets.md: every built-in asset on a board. Part of `make pictures`."""

from __future__ import annotations

import argparse
import shutil
from pathlib import Path

import numpy as np
from pictures import ROOT, photograph, save
from PIL import Image

from veduta.formats.gltf import write_glb
from veduta.formats.place_json import write_place
from veduta.grammar.assets.asset import Asset
from veduta.grammar.assets.catalogue import builtin, builtin_names
from veduta.grammar.surfaces.catalogue import PREFIX
from veduta.grammar.textures import Textures
from veduta.place.builder import PartBuilder
from veduta.place.instances import InstanceGroup, Instances
from veduta.place.manifest import Bounds, Place, PlacePart, Start
from veduta.place.material import Material
from veduta.place.part import Part
from veduta.place.semantics import Provenance, SemanticClass

COLUMNS, CELL_M, FILL = 10, 2.0, 1.6
BOARD = (0.088, 0.105, 0.922, 0.615)
"""Where the board is in the picture: left, top, right, bottom, as shares of its sides."""


def sheet(level: int = 0) -> Part:
    """All assets in cells of a wall, each as large as its cell allows."""
    assets = [asset for name in builtin_names() if (asset := builtin(f"{name}@{level}"))]
    rows = -(-len(assets) // COLUMNS)
    builder = PartBuilder("assets")
    wall = builder.feature(SemanticClass.WALL, Provenance.INVENTED, "board")
    width, height = COLUMNS * CELL_M, rows * CELL_M
    board = [(0, 0.62, 0), (width, 0.62, 0), (width, 0.62, height), (0, 0.62, height)]
    builder.polygon([board], wall, builder.material(Material("board", (0.75, 0.72, 0.66))))
    materials: dict[Material, int] = {}
    groups = []
    for number, asset in enumerate(assets):
        row = builder.feature(SemanticClass.OTHER, Provenance.INVENTED, asset.name)
        looks = [_look(asset, slot) for slot in range(len(asset.slots))]
        numbers = tuple(1 + materials.setdefault(look, len(materials)) for look in looks)
        place = _place(asset, number % COLUMNS, rows - 1 - number // COLUMNS)
        groups.append(InstanceGroup(number, numbers, place[None], np.array([row], dtype=np.int32)))
    for material in materials:
        builder.material(material)
    part = builder.build()
    shared = tuple(asset.shared_mesh for asset in assets)
    return Part(**{**vars(part), "instances": Instances(shared, tuple(groups))})


def _look(asset: Asset, slot: int) -> Material:
    own = asset.slots[slot]
    texture = None if own.texture is None else Textures({})[f"{PREFIX}{own.texture}"]
    return Material(own.name, own.colour or own.fallback, own.roughness, own.metalness, texture)


def _place(asset: Asset, column: int, row: int) -> np.ndarray:
    low, high = asset.box_m
    scale = FILL / max(high[:2] - low[:2])
    middle = (low + high) / 2
    turn = np.radians(-18.0)
    around = np.array(
        [[np.cos(turn), -np.sin(turn), 0], [np.sin(turn), np.cos(turn), 0], [0, 0, 1]]
    )
    matrix = scale * around
    centre = np.array([(column + 0.5) * CELL_M, -0.15, (row + 0.5) * CELL_M])
    move = centre - matrix @ np.array([middle[0], -middle[2], middle[1]])
    return np.column_stack([matrix, move])


def write(part: Part, folder: Path) -> None:
    """The part as a place that a visitor sees from the front."""
    folder.mkdir(parents=True)
    write_glb(part, folder / "assets.glb")
    low, high = part.bounds_m
    across, up = high[0] / 2, high[2] / 2
    placed = PlacePart(
        id="assets", name="assets", model="assets.glb", arrangement="single",
        bounds=Bounds(min=low, max=high),
    )  # fmt: skip
    start = Start(eye=(across, -1.75 * high[2], up), target=(across, 0.0, 1.0 * up))
    write_place(Place(parts=[placed], start=start), folder / "place.json")


def main() -> None:
    """Lay the assets out, look at them in Chromium, and keep what was seen."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--work", type=Path, default=ROOT / "out" / "pictures-assets")
    parser.add_argument("--level", type=int, default=0)
    given = parser.parse_args()
    work: Path = given.work
    shutil.rmtree(work, ignore_errors=True)
    (work / "shots").mkdir(parents=True)
    write(sheet(given.level), work / "place")
    photograph(work / "place", work / "shots", script="assets_picture.mjs")
    with Image.open(work / "shots" / "sheet.png") as picture:
        left, top, right, bottom = (
            round(share * side) for share, side in zip(BOARD, picture.size * 2, strict=True)
        )
        save(picture.convert("RGB").crop((left, top, right, bottom)), "assets.jpg")


if __name__ == "__main__":
    main()
