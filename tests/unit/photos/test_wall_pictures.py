"""Pictures of walls and what is written of them, on a corner whose look is known."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path

import cv2
import numpy as np
import pycolmap
import pytest
from photo_scene import ARC, FOCAL_PX, HEIGHT_PX, TEXELS_PER_M, WIDTH_PX, _texture, take_photo
from PIL import Image

from veduta.formats.gltf import read_glb
from veduta.photos.levelling import photo_gains
from veduta.photos.structure import Structure
from veduta.photos.walls.document import WallsDocument
from veduta.photos.walls.part import MODEL, add_walls, walls_part
from veduta.photos.walls.pictures import WallPicture, wall_pictures
from veduta.photos.walls.step import FoundWalls, write_walls
from veduta.photos.walls.wall import Wall
from veduta.place.place import Place
from veduta.place.semantics import Provenance, SemanticClass

RELIEF = 0.1
SEED = 5


def corner(rows: int = 300) -> tuple[Structure, Wall]:
    """The cameras of the scene with points on its wall y = 0, and that wall."""
    rng = np.random.default_rng(1)
    points = np.column_stack(
        [rng.uniform(0.3, 2.5, rows), np.zeros(rows), rng.uniform(0.4, 2.2, rows)]
    )
    camera = pycolmap.Camera(
        model="PINHOLE",
        width=WIDTH_PX,
        height=HEIGHT_PX,
        params=[FOCAL_PX, FOCAL_PX, WIDTH_PX / 2, HEIGHT_PX / 2],
    )
    poses = np.array([np.column_stack([p.rotation, -p.rotation @ np.array(p.eye)]) for p in ARC])
    image_of, point_of = (grid.ravel() for grid in np.indices((len(ARC), rows)))
    seen = points @ np.swapaxes(poses[:, :, :3], 1, 2) + poses[:, None, :, 3]
    places = FOCAL_PX * seen[..., :2] / seen[..., 2:] + [WIDTH_PX / 2, HEIGHT_PX / 2]
    structure = Structure(
        cameras={1: camera},
        camera_of={number + 1: 1 for number in range(len(ARC))},
        image_ids=tuple(range(1, len(ARC) + 1)),
        names=tuple(f"view{number}.png" for number in range(len(ARC))),
        cam_from_world=poses,
        keypoints_px=tuple(places),
        points=points,
        colours=np.zeros((rows, 3), np.uint8),
        image_of=image_of.astype(np.int64),
        keypoint_of=point_of.astype(np.int64),
        point_of=point_of.astype(np.int64),
    )
    # Seen from y > 0 its left end is at the larger x.
    wall = Wall("w000", np.array([2.5, 0.0]), np.array([0.3, 0.0]), 0.4, 2.2, np.arange(rows), 0.0)
    return structure, wall


@cache
def photo(row: int) -> np.ndarray:
    return take_photo(ARC[row], SEED)


def picture_of(walls: tuple[Wall, ...], structure: Structure, **changed: np.ndarray) -> WallPicture:
    gains = changed.get("gains")

    def read(row: int) -> np.ndarray:
        pixels = photo(row)
        if gains is not None:
            light = (pixels / 255.0) ** 2.2 * gains[row]
            pixels = np.round(255 * np.clip(light, 0, 1) ** (1 / 2.2)).astype(np.uint8)
        return pixels

    return wall_pictures(structure, walls, read, 512, RELIEF)[0]


def true_picture(picture: WallPicture) -> np.ndarray:
    """The wall's own texture at the places of the picture's pixels."""
    grid = picture.grid
    points = grid.points(np.arange(grid.width_px) + 0.5, np.arange(grid.height_px) + 0.5)
    place = (points[..., [0, 2]] * TEXELS_PER_M).astype(np.float32)
    return cv2.remap(
        _texture(SEED + 1), place[..., 0], place[..., 1], cv2.INTER_LINEAR,
        borderMode=cv2.BORDER_REFLECT,
    )  # fmt: skip


def apart(picture: WallPicture, true: np.ndarray) -> float:
    """Mean difference (of 255) after both are blurred: photos are coarser than the texture."""
    seen = cv2.erode((picture.pixels[..., 3] > 0).astype(np.uint8), np.ones((9, 9))) > 0
    one, two = (
        cv2.GaussianBlur(image.astype(np.float64), (0, 0), 1.5)
        for image in (picture.pixels[..., :3], true)
    )
    return float(np.abs(one - two)[seen].mean())


def test_a_wall_looks_as_it_does() -> None:
    structure, wall = corner()
    picture = picture_of((wall,), structure)
    true = true_picture(picture)
    assert picture.seen > 0.95
    assert apart(picture, true) < 5.0
    # The measure would notice a shift of three pixels.
    assert apart(replace(picture, pixels=np.roll(picture.pixels, 3, axis=1)), true) > 8.0


def test_exposure_is_levelled() -> None:
    structure, wall = corner()
    gains = np.array([[0.5], [1.0], [0.7], [1.0], [0.6], [0.9]]) * np.ones(3)
    picture = picture_of((wall,), structure, gains=gains)
    true = true_picture(picture).astype(np.float64)
    light = (picture.pixels[..., :3] / 255.0) ** 2.2
    ratio = np.log(light.mean(axis=2) + 0.01) - np.log(((true / 255) ** 2.2).mean(axis=2) + 0.01)
    cells = [np.median(block) for row in np.array_split(ratio, 6) for block in
             np.array_split(row, 6, axis=1)]  # fmt: skip
    assert np.std(cells) < 0.1


def test_what_nothing_shows_is_transparent() -> None:
    structure, wall = corner()
    high = replace(wall, top=9.0)
    picture = picture_of((high,), structure)
    rows = picture.grid.upper - picture.grid.pixel * (np.arange(picture.grid.height_px) + 0.5)
    alpha = picture.pixels[..., 3]
    assert not alpha[rows > 6.0].any()
    assert (alpha[(rows < 2.0) & (rows > 0.6)] == 255).mean() > 0.95
    assert not picture.pixels[alpha == 0].any()
    assert picture.seen == pytest.approx(float((alpha > 0).mean()))


def test_another_wall_hides_what_is_behind_it() -> None:
    structure, wall = corner()
    rows = np.arange(9)
    screen = Wall("w001", np.array([2.6, 0.5]), np.array([0.2, 0.5]), 0.0, 1.3, rows, 0.0)
    open_, hidden = (picture_of(walls, structure) for walls in ((wall,), (wall, screen)))
    assert hidden.seen < 0.8 * open_.seen


def test_gains_are_found() -> None:
    rng = np.random.default_rng(6)
    true = rng.uniform(0.5, 2.0, (8, 3))
    base = rng.uniform(0.05, 0.3, (400, 3))
    photo_, place = rng.integers(0, 8, 4000), rng.integers(0, 400, 4000)
    light = base[place] * true[photo_] * np.exp(0.02 * rng.standard_normal((4000, 3)))
    light[:400] *= rng.uniform(2.0, 3.0, (400, 1))
    found = photo_gains(light, photo_, place, 8)
    product = found * true
    assert np.allclose(product / np.median(product, axis=0), 1.0, atol=0.03)
    assert np.array_equal(photo_gains(light[:0], photo_[:0], place[:0], 8), np.ones((8, 3)))


def test_document_pictures_and_model_agree(tmp_path: Path) -> None:
    structure, wall = corner()
    picture = picture_of((wall,), structure)
    folder = tmp_path / "walls"
    folder.mkdir()
    placed = write_walls(FoundWalls((wall,), (picture,)), structure, "unknown", tmp_path, folder)
    assert placed is not None
    document = WallsDocument.model_validate_json((tmp_path / "walls.json").read_bytes())
    told = document.walls[0].picture
    assert told is not None
    with Image.open(tmp_path / told.file) as image:
        assert image.size == (told.width_px, told.height_px)
        assert image.mode == "RGBA"
    assert told.width_px * told.units_per_px == pytest.approx(wall.width - 2 * told.left, rel=0.01)
    part = walls_part((picture,))
    assert part is not None
    assert part.features.semantic(0) is SemanticClass.WALL
    assert part.features.provenance(0) is Provenance.INFERRED
    assert part.feature_area_m2[0] == pytest.approx(wall.width * wall.height, rel=1e-5)
    assert part.triangles.polygon_normal[0] == pytest.approx([0.0, 1.0, 0.0], abs=1e-6)
    # The upper left corner of the wall is the margin's width inside of the picture.
    corner_uv = part.uv[3] * [told.width_px, told.height_px]
    margin_px = -told.left / told.units_per_px
    assert corner_uv == pytest.approx([margin_px, margin_px], abs=0.6)
    place = Place()
    add_walls(place, placed)
    place.save(tmp_path)
    assert len(read_glb(tmp_path / MODEL).features) == 1


def test_no_walls_are_written_as_none(tmp_path: Path) -> None:
    structure, _ = corner()
    assert write_walls(FoundWalls((), ()), structure, "unknown", tmp_path, tmp_path) is None
    assert WallsDocument.model_validate_json((tmp_path / "walls.json").read_bytes()).walls == []
