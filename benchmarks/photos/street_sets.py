"""Folders of rendered photos with known truth, for `veduta photos`.

    python benchmarks photos/street_sets OUT [--place street|block|tower] [--seed N] [--photos N]
        [--lens KIND] [--cameras 1|3] [--no-gps] [--held-back N] [--model-seed N]

Writes `images/`, `held-back/` (photos that are not to be reconstructed from), `truth.json`,
`model.city.json` and `outlines.geojson`. With `--model-seed` the model is that of another street,
laid to the same place: nothing of what the photos show is in it. Of a block, 300 photos go round
it twice, and fewer are the first of these. A tower has four identical sides; the photos of a ring
about it can be told apart by what stands behind it.
"""

from __future__ import annotations

import argparse
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np

from veduta.synthetic.camera import Camera
from veduta.synthetic.streets.coarse import everything, ray_scene
from veduta.synthetic.streets.gps import degrees_of, gps_places
from veduta.synthetic.streets.house import Street
from veduta.synthetic.streets.model_files import city_json, outlines_geojson
from veduta.synthetic.streets.photos import LENSES, Kit, photos_of
from veduta.synthetic.streets.plan import TOWER_WALK_M, plan_block, plan_street, plan_tower
from veduta.synthetic.streets.scenery import street_scenery
from veduta.synthetic.streets.truth_file import truth_json
from veduta.synthetic.streets.walk import walk, walk_round
from veduta.synthetic.streets.walls import true_walls

DEFAULT_PHOTOS = {"street": 40, "block": 300, "tower": 32}
ONE_CAMERA = Kit()
Place = Literal["street", "block", "tower"]
PLANS = {"street": plan_street, "block": plan_block, "tower": plan_tower}
DEFAULT_PHOTOS = {"street": 40, "block": 300, "tower": 32}
ONE_CAMERA = Kit()
IMAGES, HELD_BACK = "images", "held-back"
BLOCK_PHOTOS = 300


@dataclass(frozen=True)
class StreetSet:
    """What is in a folder. model_seed: of the street whose model is written, None for its own."""

    seed: int
    place: Place = "street"
    photos: int = 40
    kit: Kit = ONE_CAMERA
    gps: bool = True
    held_back: int = 0
    model_seed: int | None = None
    size_px: tuple[int, int] = (1000, 750)

    @property
    def planned(self) -> Street:
        """What stands where."""
        return PLANS[self.place](self.seed)

    def cameras(self, street: Street) -> tuple[Camera, ...]:
        """Those of all photos, with those held back."""
        count, kit = self.photos + self.held_back, self.kit
        if self.place == "tower":
            return walk_round(TOWER_WALK_M, count, self.size_px, self.seed)
        whole = max(BLOCK_PHOTOS, count) if self.place == "block" else count
        lenses, steps = kit.distortions, kit.focal_steps
        return walk(street, whole, self.size_px, distortions=lenses, focal_steps=steps)[:count]


def write_set(made: StreetSet, out: Path) -> None:
    """Render one set; a photo takes two to three seconds of a core."""
    street = made.planned
    write_photos(street, made.cameras(street), made, out)
    other = made.model_seed
    write_model(street if other is None else PLANS[made.place](other), out)


def write_photos(street: Street, cameras: tuple[Camera, ...], made: StreetSet, out: Path) -> None:
    """The photos and their truth."""
    held_back = set(held_back_rows(len(cameras), made.held_back))
    places = gps_places(np.array([camera.position_m for camera in cameras]), made.seed)
    degrees = degrees_of(street, places) if made.gps else None
    scene, light = street_scenery(street, cameras)
    names = [f"{row + 1:04d}.jpg" for row in range(len(cameras))]
    for folder in (IMAGES, HELD_BACK) if held_back else (IMAGES,):
        (out / folder).mkdir(parents=True, exist_ok=True)
    photos = photos_of(scene, light, cameras, made.kit, degrees, made.seed)
    for row, (jpeg, _) in enumerate(photos):
        (out / (HELD_BACK if row in held_back else IMAGES) / names[row]).write_bytes(jpeg)
    shown = [camera for row, camera in enumerate(cameras) if row not in held_back]
    walls = true_walls(street.houses, shown, ray_scene(everything(street)))
    aside = [names[row] for row in sorted(held_back)]
    truth = truth_json(street, names, cameras, places, walls, aside)
    (out / "truth.json").write_text(json.dumps(truth, indent=1))


def held_back_rows(photos: int, held_back: int) -> list[int]:
    """Rows of photos, evenly spread over the walk."""
    return [int((number + 0.5) * photos / held_back) for number in range(held_back)]


def write_model(street: Street, out: Path) -> None:
    """The coarse model in both formats."""
    houses = everything(street)
    (out / "model.city.json").write_text(json.dumps(city_json(street, houses)))
    (out / "outlines.geojson").write_text(json.dumps(outlines_geojson(street, houses), indent=1))


def main() -> None:
    """Write one folder."""
    parser = argparse.ArgumentParser()
    parser.add_argument("out", type=Path)
    parser.add_argument("--place", choices=tuple(PLANS), default="street")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--photos", type=int)
    parser.add_argument("--lens", choices=tuple(LENSES), default="radial")
    parser.add_argument("--cameras", type=int, choices=(1, 3), default=1)
    parser.add_argument("--no-gps", action="store_true")
    parser.add_argument("--held-back", type=int, default=0, metavar="N")
    parser.add_argument("--model-seed", type=int, metavar="N")
    given = parser.parse_args()
    made = StreetSet(
        given.seed,
        given.place,
        given.photos or DEFAULT_PHOTOS[given.place],
        Kit(given.lens, given.cameras),
        not given.no_gps,
        given.held_back,
        given.model_seed,
    )
    write_set(made, given.out)


if __name__ == "__main__":
    main()
