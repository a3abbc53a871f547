"""Photos of a camera that looks the way it goes, on made-up points of a street."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pycolmap
import pytest
from numpy.typing import NDArray

from veduta.photos.intake.read import PhotoRecord, with_focal
from veduta.photos.mapping.initial_pair import weighed_pairs
from veduta.photos.mapping.mapping import map_photos
from veduta.photos.mapping.one_camera import mapped_as_of_one_camera, write_shared_database
from veduta.photos.mapping.settling import map_settled
from veduta.photos.matching.match import database_name
from veduta.photos.options import CameraOptions, PhotosOptions
from veduta.photos.stages import Stages
from veduta.photos.structure import adjusted, structure_of
from veduta.run.errors import InputError
from veduta.run.progress import no_progress

WIDTH_PX, HEIGHT_PX, FOCAL_PX = 1240, 376, 720.0
ASSUMED_PX = 1.2 * WIDTH_PX
FRAMES = 7
STEP_M = 1.0


def street(rng: np.random.Generator, count: int = 400) -> NDArray[np.float64]:
    """(n, 3) x right, y down, z ahead: fronts at both sides, the ground, and trees between."""
    side = rng.choice([-1.0, 1.0], count)
    ahead = rng.uniform(4.0, 60.0, count)
    fronts = np.column_stack(
        [side * rng.normal(9.0, 0.6, count), rng.uniform(-8, 1.6, count), ahead]
    )
    ground = np.column_stack([rng.uniform(-9, 9, count), np.full(count, 1.6), ahead])
    trees = np.column_stack([side * rng.uniform(4, 8, count), rng.uniform(-4, 1.6, count), ahead])
    return np.concatenate([fronts, ground[: count // 3], trees[: count // 2]])


def places(steps_m: float) -> NDArray[np.float64]:
    """(FRAMES, 3) the way ahead, with a little sway."""
    n = np.arange(FRAMES)
    return np.column_stack([0.1 * np.sin(n), 0.03 * np.cos(n), steps_m * n])


def street_database(
    path: Path, *, known: bool, shared: bool, step_m: float = STEP_M, turn_rad: float = 0.01
) -> Path:
    """What matching would leave of the street: features half a pixel off, and true matches."""
    rng = np.random.default_rng(7)
    points = street(rng)
    seen = []
    for number, place in enumerate(places(step_m)):
        cosine, sine = np.cos(turn_rad * number), np.sin(turn_rad * number)
        turn = np.array([[cosine, 0.0, -sine], [0.0, 1.0, 0.0], [sine, 0.0, cosine]])
        local = (points - place) @ turn.T
        with np.errstate(divide="ignore", invalid="ignore"):
            px = FOCAL_PX * local[:, :2] / local[:, 2:] + (WIDTH_PX / 2, HEIGHT_PX / 2)
        inside = (
            (local[:, 2] > 1.0) & (px > 0).all(axis=1) & (px < (WIDTH_PX, HEIGHT_PX)).all(axis=1)
        )
        seen.append((np.flatnonzero(inside), px[inside] + rng.normal(0.0, 0.4, (inside.sum(), 2))))
    with pycolmap.Database.open(path) as opened:
        for image, (_, px) in enumerate(seen, 1):
            number = 1 if shared else image
            if image == 1 or not shared:
                focal = FOCAL_PX if known else ASSUMED_PX
                camera = pycolmap.Camera.create_from_model_name(
                    number, "SIMPLE_RADIAL", focal, WIDTH_PX, HEIGHT_PX
                )
                camera.has_prior_focal_length = known
                opened.write_camera(camera, use_camera_id=True)
                rig = pycolmap.Rig(rig_id=number)
                rig.add_ref_sensor(camera.sensor_id)
                opened.write_rig(rig, use_rig_id=True)
            made = pycolmap.Image(name=database_name(image), camera_id=number, image_id=image)
            opened.write_image(made, use_image_id=True)
            frame = pycolmap.Frame(frame_id=image, rig_id=number)
            frame.add_data_id(made.data_id)
            opened.write_frame(frame, use_frame_id=True)
            opened.write_keypoints(image, px.astype(np.float32))
        for first in range(FRAMES):
            for second in range(first + 1, FRAMES):
                _, own, other = np.intersect1d(seen[first][0], seen[second][0], return_indices=True)
                rows = np.column_stack([own, other]).astype(np.uint32)
                geometry = pycolmap.TwoViewGeometry(inlier_matches=rows)
                geometry.config = pycolmap.TwoViewGeometryConfiguration.UNCALIBRATED
                opened.write_two_view_geometry(first + 1, second + 1, geometry)
                opened.write_matches(first + 1, second + 1, rows)
    return path


IDS = tuple(range(1, FRAMES + 1))


def steps(model: pycolmap.Reconstruction) -> NDArray[np.float64]:
    """(FRAMES - 1,) lengths between neighbours, in units of their mean."""
    centres = np.array([model.images[image].projection_center() for image in IDS])
    found = np.linalg.norm(np.diff(centres, axis=0), axis=1)
    return np.asarray(found / found.mean())


def photo(image_id: int, focal_px: float | None = None, width_px: int = WIDTH_PX) -> PhotoRecord:
    return PhotoRecord(
        image_id=image_id, name=f"{image_id}.png", path=Path(f"{image_id}.png"), sha256="",
        width_px=width_px, height_px=HEIGHT_PX, focal_px=focal_px, camera=None, time=None,
        position=None, group=1, notes=(),
    )  # fmt: skip


@pytest.mark.parametrize("known", [True, False])
def test_all_are_placed_where_they_were_taken(tmp_path: Path, known: bool) -> None:
    """Also where one camera took all and its focal length is off by a factor of two."""
    database = street_database(tmp_path / "own.db", known=known, shared=True)
    assert all(pair.fault for pair in weighed_pairs(database, IDS, 0)), "no pair meets the others"
    mapped = map_photos(database, tmp_path / "map", IDS, 0)
    (model,) = mapped.models
    assert model.num_reg_images() == FRAMES
    (start,) = mapped.starts
    assert (start.chosen_by, start.pair.begins_ahead) == ("ahead", True)
    true = np.linalg.norm(np.diff(places(STEP_M), axis=0), axis=1)
    assert steps(model) == pytest.approx(true / true.mean(), abs=0.02)
    focal = next(iter(model.cameras.values())).mean_focal_length()
    assert focal == pytest.approx(FOCAL_PX, rel=0.1)


def test_a_focal_length_that_is_held_stays(tmp_path: Path) -> None:
    database = street_database(tmp_path / "own.db", known=True, shared=True)
    (model,) = map_photos(database, tmp_path / "map", IDS, 0, focal_held=True).models
    names = {image: str(image) for image in IDS}
    structure = structure_of(model, names)
    assert structure.camera(0).mean_focal_length() == FOCAL_PX
    held = adjusted(replace(structure, focal_held=True), free_principal_point=False)
    assert held.camera(0).mean_focal_length() == FOCAL_PX
    free = adjusted(structure, free_principal_point=False)
    assert free.camera(0).mean_focal_length() != FOCAL_PX


def test_photos_ahead_of_each_other_are_not_called_two_places(tmp_path: Path) -> None:
    """All of the middle hardly moves, and at the rim another thing comes into view."""
    database = street_database(tmp_path / "own.db", known=True, shared=True)
    settled = map_settled(database, tmp_path / "map", IDS, 0)
    assert (settled.dropped, settled.folded) == ((), False)


def test_a_camera_that_only_turned_begins_none(tmp_path: Path) -> None:
    database = street_database(
        tmp_path / "own.db", known=True, shared=True, step_m=0.0, turn_rad=0.04
    )
    assert not any(pair.begins_ahead for pair in weighed_pairs(database, IDS, 0))
    assert map_photos(database, tmp_path / "map", IDS, 0).models == ()


def test_a_camera_for_each_is_given_up_for_one(tmp_path: Path) -> None:
    """Nothing hangs together with own focal lengths, and all does with one."""
    own = street_database(tmp_path / "own.db", known=False, shared=False)
    alone = map_settled(own, tmp_path / "alone", IDS, 0)
    assert alone.mapped.models == ()
    photos = [photo(image) for image in IDS]
    write_shared_database(own, photos, tmp_path / "own.shared.db")
    found, one = mapped_as_of_one_camera(
        alone, photos, PhotosOptions(), _At(tmp_path, own), no_progress
    )
    assert one
    assert found.mapped.models[0].num_reg_images() == FRAMES
    for camera in (CameraOptions(cameras="per-photo"), CameraOptions(cameras="shared")):
        asked = PhotosOptions(camera=camera)
        again = mapped_as_of_one_camera(alone, photos, asked, _At(tmp_path, own), no_progress)
        assert again == (alone, False), "who says how cameras are shared is not overruled"


class _At(Stages):
    """Stages whose database lies at a path."""

    def __init__(self, out: Path, own: Path) -> None:
        super().__init__(out, None, PhotosOptions())  # type: ignore[arg-type]
        object.__setattr__(self, "own", own)

    def database(self) -> Path:
        own: Path = self.own  # type: ignore[attr-defined]
        return own


def test_a_given_focal_length_is_of_one_camera() -> None:
    known = with_focal([photo(1), photo(2, focal_px=900.0)], FOCAL_PX)
    assert [(one.focal_px, one.group) for one in known] == [(FOCAL_PX, 1)] * 2
    sizes: Sequence[PhotoRecord] = [photo(1), photo(2, width_px=640)]
    with pytest.raises(InputError) as error:
        with_focal(sizes, FOCAL_PX)
    assert "1.png 1240 x 376 px, 2.png 640 x 376 px" in error.value.fault
