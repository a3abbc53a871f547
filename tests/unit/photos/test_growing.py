"""Mapping that was stopped goes on from the last photo but one that it had."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pycolmap
import pytest
from photo_scene import ARC, write_photos

from veduta.photos.intake.call import plan_call
from veduta.photos.intake.read import read_photos
from veduta.photos.mapping.growing import read_snapshot, write_snapshot
from veduta.photos.mapping.mapping import map_photos
from veduta.photos.matching.features import FeaturesJob, run_features
from veduta.photos.matching.match import match_pairs, write_database
from veduta.photos.matching.pairs import choose_pairs
from veduta.photos.options import MatchOptions

IDS = tuple(range(1, len(ARC) + 1))


class KilledError(Exception):
    """Stands for the end of the process."""


@pytest.fixture(scope="module")
def database(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("growing")
    write_photos(folder / "photos")
    options = MatchOptions(max_features=800)
    photos = read_photos(plan_call(folder / "photos").sources).photos
    files = [folder / f"{photo.image_id}.npz" for photo in photos]
    for photo, file in zip(photos, files, strict=True):
        run_features(FeaturesJob(photo.path, options, file))
    write_database(folder / "matches.db", photos, files, per_photo=False)
    match_pairs(folder / "matches.db", choose_pairs(photos, options), options, seed=0)
    return folder / "matches.db"


@pytest.fixture(scope="module")
def whole(database: Path, tmp_path_factory: pytest.TempPathFactory) -> np.ndarray:
    """Where the cameras are when nothing stops the mapping."""
    (model,) = map_photos(database, tmp_path_factory.mktemp("whole"), IDS, 0).models
    return centres(model)


def centres(model: pycolmap.Reconstruction) -> np.ndarray:
    """(n, 3) in the order of the photos, about their middle, in units of their spread."""
    found = np.array([model.images[image].projection_center() for image in IDS])
    found = found - found.mean(axis=0)
    return found / np.linalg.norm(found)


@pytest.mark.parametrize("most", [2, 4, 5])
def test_it_goes_on_from_its_snapshot(
    database: Path, whole: np.ndarray, tmp_path: Path, most: int
) -> None:
    def stop(step: str, share: float) -> None:
        assert step == "map"
        if round(share * len(IDS)) > most:
            raise KilledError

    with pytest.raises(KilledError):
        map_photos(database, tmp_path / "map", IDS, 0, stop)
    (snapshots,) = (tmp_path / "map").iterdir()
    kept = read_snapshot(snapshots)
    assert kept is not None
    assert kept.num_reg_images() == most

    told: list[int] = []
    mapped = map_photos(
        database, tmp_path / "map", IDS, 0, lambda _, share: told.append(round(share * len(IDS)))
    )
    assert told == list(range(most, len(IDS) + 1)), "what was kept, and then the others"
    (model,) = mapped.models
    turn = np.linalg.svd(centres(model).T @ whole)
    assert turn.S.sum() == pytest.approx(1.0, abs=1e-4), "the same cameras but for a similarity"


def test_components_that_are_ended_stay(database: Path, tmp_path: Path) -> None:
    first = map_photos(database, tmp_path / "map", IDS[:3], 0)
    assert [model.num_reg_images() for model in first.models] == [3]
    again = map_photos(database, tmp_path / "map", IDS, 0)
    # The ended one is taken as it is; the other photos become a second one.
    assert [sorted(model.reg_image_ids()) for model in again.models] == [[1, 2, 3], [4, 5, 6]]


def test_two_photos_alone_are_no_component(database: Path, tmp_path: Path) -> None:
    assert map_photos(database, tmp_path / "map", IDS[:2], 0).models == ()


def test_half_a_snapshot_is_none(tmp_path: Path) -> None:
    assert read_snapshot(tmp_path / "none") is None
    (tmp_path / "here" / ".1.x.tmp").mkdir(parents=True)
    assert read_snapshot(tmp_path / "here") is None
    write_snapshot(pycolmap.Reconstruction(), tmp_path / "here")
    write_snapshot(pycolmap.Reconstruction(), tmp_path / "here")
    assert [path.name for path in (tmp_path / "here").iterdir()] == ["2"]
