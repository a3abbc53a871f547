"""The step `texture` on pictures in a folder, and the formats' own validators on what it writes."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pycolmap
import pytest
from painted_wall import PaintedWall, painted_wall
from test_validators import validate_city, validate_gltf

from veduta.formats.tiles import contents
from veduta.photos.city.model import CityModel
from veduta.photos.options import TextureOptions
from veduta.photos.structure import Structure
from veduta.photos.texture.step import can_texture, texture_step
from veduta.photos.world.georeference import Georeference
from veduta.run.progress import no_progress

ORIGIN = (500_000.0, 5_400_000.0, 300.0)


def structure_of_views(wall: PaintedWall) -> Structure:
    """The views as a structure without points."""
    one = wall.views[0].camera
    camera = pycolmap.Camera(
        camera_id=1,
        model="PINHOLE",
        width=one.width_px,
        height=one.height_px,
        params=[*one.focal_px, *one.centre_px],
    )
    count = len(wall.views)
    none = np.zeros(0, dtype=np.int64)
    return Structure(
        cameras={1: camera},
        camera_of={number + 1: 1 for number in range(count)},
        image_ids=tuple(range(1, count + 1)),
        names=tuple(view.name for view in wall.views),
        cam_from_world=np.array([view.cam_from_world for view in wall.views]),
        keypoints_px=(np.zeros((0, 2)),) * count,
        points=np.zeros((0, 3)),
        colours=np.zeros((0, 3), dtype=np.uint8),
        image_of=none,
        keypoint_of=none,
        point_of=none,
    )


@pytest.mark.parametrize("crs", [None, "EPSG:25832"])
def test_files_are_valid_and_name_each_other(tmp_path: Path, crs: str | None) -> None:
    wall = painted_wall((1.0, 0.8, 1.2))
    out = tmp_path / "out"
    out.mkdir()
    city = replace(wall.city, crs=crs, origin_m=ORIGIN)
    options = TextureOptions(texel_m=0.03)

    def read_photo(image_id: int) -> np.ndarray:
        return wall.views[image_id - 1].pixels()

    found = texture_step(structure_of_views(wall), read_photo, city, options, out, no_progress)
    assert found.measures["faces_textured"] == 1
    assert contents(out) == ["tileset.json", "parts/house.glb"]
    named = json.loads((out / "model.city.json").read_text())["appearance"]["textures"]
    assert all((out / one["image"]).is_file() for one in named)
    issues = validate_gltf(out / found.parts[0].model)
    assert (issues["numErrors"], issues["numWarnings"]) == (0, 0), issues["messages"]
    report = validate_city(out / "model.city.json")
    assert report["valid"], report


def test_only_a_model_that_photos_lie_in_is_textured() -> None:
    city: CityModel = replace(painted_wall((1.0,)).city, crs="EPSG:25832", origin_m=ORIGIN)
    there = Georeference("model", True, "", "EPSG:25832", ORIGIN, None)
    assert can_texture(there, city, TextureOptions())
    assert not can_texture(there, city, TextureOptions(no_texture=True))
    assert not can_texture(replace(there, accepted=False), city, TextureOptions())
    assert not can_texture(replace(there, crs="EPSG:28992"), city, TextureOptions())
    assert not can_texture(there, None, TextureOptions())
    assert not can_texture(None, city, TextureOptions())
