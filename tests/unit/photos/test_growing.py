"""Mapping that was stopped goes on from the last photo but one that it had."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import combinations
from pathlib import Path

import numpy as np
import pycolmap
import pytest
from photo_scene import ARC

from veduta.photos.mapping import growing, initial_pair
from veduta.photos.mapping.doubt import Doubt, database_without
from veduta.photos.mapping.growing import read_snapshot, write_snapshot
from veduta.photos.mapping.grown import Grown
from veduta.photos.mapping.initial_pair import weighed_pair
from veduta.photos.mapping.mapping import Mapped, map_photos

IDS = tuple(range(1, len(ARC) + 1))


class KilledError(Exception):
    """Stands for the end of the process."""


@pytest.fixture(scope="module")
def whole(arc_matches: Path, tmp_path_factory: pytest.TempPathFactory) -> Mapped:
    """What nothing stopped."""
    return map_photos(arc_matches, tmp_path_factory.mktemp("whole"), IDS, 0)


def centres(model: pycolmap.Reconstruction) -> np.ndarray:
    """(n, 3) in the order of the photos, about their middle, in units of their spread."""
    found = np.array([model.images[image].projection_center() for image in IDS])
    found = found - found.mean(axis=0)
    return found / np.linalg.norm(found)


@pytest.mark.parametrize("most", [2, 4, 5])
def test_it_goes_on_from_its_snapshot(
    arc_matches: Path, whole: Mapped, tmp_path: Path, most: int
) -> None:
    def stop(step: str, share: float) -> None:
        assert step == "map"
        if round(share * len(IDS)) > most:
            raise KilledError

    with pytest.raises(KilledError):
        map_photos(arc_matches, tmp_path / "map", IDS, 0, stop)
    (snapshots,) = (tmp_path / "map").iterdir()
    kept = read_snapshot(snapshots)
    assert kept is not None
    assert kept.model.num_reg_images() == most

    told: list[int] = []
    mapped = map_photos(
        arc_matches, tmp_path / "map", IDS, 0, lambda _, share: told.append(round(share * len(IDS)))
    )
    assert told == list(range(most, len(IDS) + 1)), "what was kept, and then the others"
    (model,) = mapped.models
    assert mapped.starts == whole.starts, "what it began with is kept with what was grown"
    turn = np.linalg.svd(centres(model).T @ centres(whole.models[0]))
    assert turn.S.sum() == pytest.approx(1.0, abs=1e-4), "the same cameras but for a similarity"


def test_components_that_are_ended_stay(arc_matches: Path, tmp_path: Path) -> None:
    first = map_photos(arc_matches, tmp_path / "map", IDS[:3], 0)
    assert [model.num_reg_images() for model in first.models] == [3]
    again = map_photos(arc_matches, tmp_path / "map", IDS, 0)
    # The ended one is taken as it is; the other photos become a second one.
    assert [sorted(model.reg_image_ids()) for model in again.models] == [[1, 2, 3], [4, 5, 6]]


def test_two_photos_alone_are_no_component(arc_matches: Path, tmp_path: Path) -> None:
    assert map_photos(arc_matches, tmp_path / "map", IDS[:2], 0).models == ()


def without_pairs(database: Path, target: Path, pairs: Iterable[tuple[int, int]]) -> Path:
    database_without(database, [Doubt(*pair, 0, "") for pair in pairs], target)
    return target


def test_photos_of_two_places_become_two_components(arc_matches: Path, tmp_path: Path) -> None:
    """A first pair of one's own does not keep the other photos from becoming a component."""
    across = [(first, second) for first in IDS[:3] for second in IDS[3:]]
    apart = without_pairs(arc_matches, tmp_path / "apart.db", across)
    mapped = map_photos(apart, tmp_path / "map", IDS, 0)
    assert [sorted(model.reg_image_ids()) for model in mapped.models] == [[1, 2, 3], [4, 5, 6]]
    for model, start in zip(mapped.models, mapped.starts, strict=True):
        assert {start.pair.first, start.pair.second} <= set(model.reg_image_ids())
        assert (start.chosen_by, start.pair.fault) == ("conditions", None)


def test_the_pair_with_most_matches_that_meets_the_conditions(
    arc_matches: Path, tmp_path: Path
) -> None:
    """Against all pairs, weighed one by one."""
    (start,) = map_photos(arc_matches, tmp_path / "map", IDS, 0).starts
    weighed = [weighed_pair(arc_matches, pair, 0) for pair in combinations(IDS, 2)]
    meeting = [pair for pair in weighed if pair.fault is None]
    assert start.pair == max(meeting, key=lambda pair: pair.telling)
    better = [pair for pair in weighed if pair.telling > start.pair.telling]
    assert start.passed_over == len(better)


def test_a_pair_that_gives_nothing_is_followed_by_the_next(
    arc_matches: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The first offered has no matches in what is mapped; the engine cannot begin with it."""
    gone = without_pairs(arc_matches, tmp_path / "gone.db", [(3, 4)])
    bad, good = weighed_pair(arc_matches, (3, 4), 0), weighed_pair(arc_matches, (2, 4), 0)
    monkeypatch.setattr(growing, "weighed_pairs", lambda *_: iter([bad, good]))
    mapped = map_photos(gone, tmp_path / "map", IDS, 0)
    assert mapped.models[0].num_reg_images() == len(IDS)
    assert mapped.starts[0].pair == good
    assert mapped.starts[0].refused == 1


def test_the_engine_chooses_where_no_pair_meets_the_conditions(
    arc_matches: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(initial_pair, "LEAST_ANGLE_DEG", 179.0)
    mapped = map_photos(arc_matches, tmp_path / "map", IDS, 0)
    (start,) = mapped.starts
    assert mapped.models[0].num_reg_images() == len(IDS)
    assert (start.chosen_by, start.refused) == ("engine", 0)
    assert start.passed_over == len(list(combinations(IDS, 2)))


def test_half_a_snapshot_is_none(tmp_path: Path) -> None:
    assert read_snapshot(tmp_path / "none") is None
    (tmp_path / "here" / ".1.x.tmp").mkdir(parents=True)
    assert read_snapshot(tmp_path / "here") is None
    write_snapshot(Grown(pycolmap.Reconstruction(), None), tmp_path / "here")
    write_snapshot(Grown(pycolmap.Reconstruction(), None), tmp_path / "here")
    assert [path.name for path in (tmp_path / "here").iterdir()] == ["2"]
