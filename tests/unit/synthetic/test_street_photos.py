"""Photos of a street as files: what EXIF says, and that pixels and poses agree."""

from __future__ import annotations

from dataclasses import replace
from io import BytesIO
from pathlib import Path

import numpy as np
from PIL import Image

from veduta.imaging.read import read_image
from veduta.synthetic.camera import look_at
from veduta.synthetic.lens import Distortion
from veduta.synthetic.render import measure
from veduta.synthetic.streets.coarse import ray_scene
from veduta.synthetic.streets.gps import degrees_of
from veduta.synthetic.streets.photos import Kit, photos_of
from veduta.synthetic.streets.plan import plan_street, plan_tower
from veduta.synthetic.streets.scenery import street_light, street_scenery
from veduta.synthetic.streets.walk import walk


def test_photos_say_where_and_with_what_they_were_taken(tmp_path: Path) -> None:
    """The reader of photos gets back focal length, camera, time and place."""
    street = plan_street(5)
    kit = Kit("opencv", 3)
    lenses, steps = kit.distortions, kit.focal_steps
    cameras = walk(street, 12, (96, 72), distortions=lenses, focal_steps=steps)[:3]
    degrees = degrees_of(street, np.array([camera.position_m for camera in cameras]))
    scene = ray_scene(street.houses)
    light = street_light(street.seed)
    made = list(photos_of(scene, light, cameras, kit, degrees, street.seed, samples=1, threads=1))
    for row, (jpeg, pixels) in enumerate(made):
        path = tmp_path / f"{row}.jpg"
        path.write_bytes(jpeg)
        photo = read_image(path)
        assert photo.pixels.shape == pixels.shape == (72, 96, 3)
        assert photo.focal_px is not None
        # EXIF has whole millimetres.
        assert abs(photo.focal_px / cameras[row].focal_px - 1.0) < 0.025
        assert photo.shot.camera == f"Veduta {kit.model(row)}"
        assert photo.shot.time is not None
        assert photo.shot.position is not None
        assert abs(photo.shot.position.latitude_deg - degrees[row, 0]) < 1e-7
        assert abs(photo.shot.position.longitude_deg - degrees[row, 1]) < 1e-7
        assert photo.shot.position.altitude_m is not None
        assert abs(photo.shot.position.altitude_m - degrees[row, 2]) < 0.006
    again = photos_of(scene, light, cameras, kit, degrees, street.seed, samples=1, threads=1)
    assert [jpeg for jpeg, _ in again] == [jpeg for jpeg, _ in made]
    assert Image.open(BytesIO(made[0][0])).getexif()


def test_fronts_are_rendered_where_the_coarse_model_has_them() -> None:
    """The depth of the scenery at a front's wall is that of its block; openings lie deeper."""
    street = replace(plan_street(5), others=())
    street = replace(street, houses=street.houses[:1])
    house = street.houses[0]
    middle = house.outline_m[:2].mean(axis=0)
    outward = np.array([house.along[1], -house.along[0]])
    eye = middle + 14.0 * outward
    height = 0.5 * (house.base_m + house.top_m)
    at = (float(middle[0]), float(middle[1]), height)
    camera = look_at((float(eye[0]), float(eye[1]), 2.0), at, (120, 90), 110.0)
    camera = replace(camera, distortion=Distortion(k1=-0.1, k2=0.03))
    scene, _ = street_scenery(street, [camera])
    found = measure(scene, camera).depth_m
    block = measure(ray_scene(street.houses), camera).depth_m
    both = np.isfinite(found) & np.isfinite(block)
    apart = (found - block)[both]
    assert float(np.mean(np.abs(apart) < 0.03)) > 0.4
    assert float(np.mean((apart > -1.2) & (apart < 0.35))) > 0.8


def test_the_sides_of_the_tower_look_the_same() -> None:
    """Rays that are turned by a right angle about the tower's axis meet it at the same depth."""
    place = plan_tower(1)
    place = replace(place, houses=place.houses[:1])
    turns = 0.3 + np.arange(4) * np.pi / 2
    eyes = [(11.0 * float(np.cos(turn)), 11.0 * float(np.sin(turn)), 4.0) for turn in turns]
    cameras = [look_at(eye, (0.0, 0.0, 4.0), (80, 60), 90.0) for eye in eyes]
    scene, _ = street_scenery(place, cameras)
    depths = [np.nan_to_num(measure(scene, camera).depth_m) for camera in cameras]
    assert float(np.mean(depths[0] > 0)) > 0.7
    for depth in depths[1:]:
        # A tree or a car may stand on one side; the tower fills most of the frame.
        assert float(np.mean(np.abs(depth - depths[0]) < 0.01)) > 0.75
