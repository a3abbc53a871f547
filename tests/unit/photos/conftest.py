"""What tests of photos share: the matches of six photos of one corner."""

from __future__ import annotations

from pathlib import Path

import pytest
from photo_scene import write_photos

from veduta.photos.intake.call import plan_call
from veduta.photos.intake.read import read_photos
from veduta.photos.matching.features import FeaturesJob, run_features
from veduta.photos.matching.match import match_pairs, write_database
from veduta.photos.matching.pairs import choose_pairs
from veduta.photos.options import MatchOptions


@pytest.fixture(scope="session")
def arc_matches(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The database of the photos of `photo_scene.ARC`, which no test may change."""
    folder = tmp_path_factory.mktemp("arc")
    write_photos(folder / "photos")
    options = MatchOptions(max_features=800)
    photos = read_photos(plan_call(folder / "photos").sources).photos
    files = [folder / f"{photo.image_id}.npz" for photo in photos]
    for photo, file in zip(photos, files, strict=True):
        run_features(FeaturesJob(photo.path, options, file))
    write_database(folder / "matches.db", photos, files, per_photo=False)
    match_pairs(folder / "matches.db", choose_pairs(photos, options), options, seed=0)
    return folder / "matches.db"
