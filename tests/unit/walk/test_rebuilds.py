"""A walk that branches, and one that is built again from its edited document."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from veduta.cli.main import main
from veduta.run.errors import InputError
from veduta.run.progress import Progress
from veduta.synthetic.walks.record import GorgeWalk, write_walk
from veduta.walk.build.graph import worlds_of
from veduta.walk.build.judge import Verdict
from veduta.walk.build.mesh import MorphMesh
from veduta.walk.build.way import Way
from veduta.walk.command import run_walk
from veduta.walk.options import TakeOptions, WalkOptions
from veduta.walk.rebuild import run_rebuild

QUIET = Progress(quiet=True)


@pytest.fixture(scope="module")
def walked(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Three key positions 1.5 m apart, and a link from the first to the last."""
    folder = tmp_path_factory.mktemp("walked")
    write_walk(folder / "record", GorgeWalk(keys=3, step_m=1.5, width_px=224, height_px=144))
    options = WalkOptions(take=TakeOptions(links=("000:002",)))
    assert run_walk(folder / "record", folder / "out", options, QUIET).exit_code == 0
    return folder


def _edited(walked: Path, to: Path, **changes: Any) -> Path:
    import shutil

    shutil.copytree(walked / "out", to)
    document = json.loads((to / "walk.json").read_text()) | changes
    (to / "walk.json").write_text(json.dumps(document))
    return to / "walk.json"


def _document(walked: Path) -> dict[str, Any]:
    return dict(json.loads((walked / "out" / "walk.json").read_text()))


def test_a_link_is_a_transition_of_its_own(walked: Path) -> None:
    told = _document(walked)
    assert [(one["start"], one["end"]) for one in told["transitions"]] == [
        ("000", "001"), ("001", "002"), ("000", "002"),
    ]  # fmt: skip
    assert told["transitions"][2]["distance_m"] == pytest.approx(3.0, rel=0.05)
    place = json.loads((walked / "out" / "place.json").read_text())
    assert [(one["start"], one["end"]) for one in place["walks"][0]["transitions"]] == [
        (0, 1), (1, 2), (0, 2),
    ]  # fmt: skip


def test_a_link_to_nowhere_is_refused(walked: Path, tmp_path: Path) -> None:
    options = WalkOptions(take=TakeOptions(links=("000:009",)))
    with pytest.raises(InputError, match="000:009: is no link of two key positions"):
        run_walk(walked / "record", tmp_path / "out", options, QUIET)


def test_cuts_and_order_are_those_of_the_edited_document(walked: Path, tmp_path: Path) -> None:
    told = _document(walked)
    first, _, link = told["transitions"]
    back = {**link, "start": "002", "end": "000", "kind": "morph", "forth": None, "back": None}
    document = _edited(
        walked, tmp_path / "out", keys=[told["keys"][2], told["keys"][0], told["keys"][1]],
        transitions=[back, {**first, "kind": "cut"}, {**link, "kind": "fade"}],
    )  # fmt: skip
    result = run_rebuild(document, tmp_path / "out", QUIET)
    assert result.exit_code == 0
    assert result.measures["transitions_morph"] == 1
    (walk,) = json.loads((tmp_path / "out" / "place.json").read_text())["walks"]
    assert [key["id"] for key in walk["keys"]] == ["002", "000", "001"]
    morph, cut, fade = walk["transitions"]
    assert (morph["start"], morph["end"], morph["kind"]) == (0, 1, "morph")
    assert (morph["forth"], morph["back"]) == (link["back"], link["forth"])
    assert (cut["start"], cut["end"], cut["kind"]) == (1, 2, "cut")
    assert fade["kind"] == "fade"
    names = [morph["forth"], morph["back"], *(key["picture"] for key in walk["keys"])]
    assert all((tmp_path / "out" / name).is_file() for name in names)
    assert run_rebuild(document, tmp_path / "out", QUIET).up_to_date


def test_key_positions_that_were_moved_leave_a_doubt(walked: Path, tmp_path: Path) -> None:
    keys = _document(walked)["keys"]
    keys[1]["transform"][12] += 0.5
    document = _edited(walked, tmp_path / "out", keys=keys)
    result = run_rebuild(document, tmp_path / "out", QUIET)
    assert any("points seen from outside" in doubt for doubt in result.doubts)
    (walk,) = json.loads((tmp_path / "out" / "place.json").read_text())["walks"]
    assert walk["keys"][1]["transform"] == keys[1]["transform"]


def test_options_of_a_rebuild_are_refused(
    walked: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    document = str(walked / "out" / "walk.json")
    assert main(["walk", document, "-o", str(tmp_path / "new"), "--every", "2"]) == 2
    assert "no other option changes it" in capsys.readouterr().err
    assert not (tmp_path / "new").exists()


def test_a_rebuild_into_another_folder_is_whole(walked: Path, tmp_path: Path) -> None:
    result = run_rebuild(walked / "out" / "walk.json", tmp_path / "new", QUIET)
    assert result.exit_code == 0
    (walk,) = json.loads((tmp_path / "new" / "place.json").read_text())["walks"]
    names = [key["picture"] for key in walk["keys"]]
    names += [way[end] for way in walk["transitions"] for end in ("forth", "back") if way[end]]
    assert len(names) >= 7
    assert all((tmp_path / "new" / name).is_file() for name in names)


@pytest.mark.parametrize(
    ("change", "fault"),
    [
        ({"forth": "../../secret.glb"}, "is no model of this walk"),
        ({"forth": "walk/none.glb"}, "none.glb: is not there"),
        ({"forth": None, "back": None}, "has no models to morph"),
        ({"end": "009"}, "which is no key position"),
    ],
)
def test_what_is_wrong_with_a_document_is_said(
    walked: Path, tmp_path: Path, change: dict[str, Any], fault: str
) -> None:
    first = {**_document(walked)["transitions"][0], "kind": "morph", **change}
    document = _edited(walked, tmp_path / "out", transitions=[first])
    with pytest.raises(InputError, match=fault):
        run_rebuild(document, tmp_path / "out", QUIET)


def test_key_positions_that_are_not_there_are_named(walked: Path, tmp_path: Path) -> None:
    keys = _document(walked)["keys"]
    document = _edited(walked, tmp_path / "out", keys=[{**keys[0], "id": "x"}], transitions=[])
    with pytest.raises(InputError, match="key position x has no picture"):
        run_rebuild(document, tmp_path / "out", QUIET)
    twice = _edited(walked, tmp_path / "two", keys=[keys[0], keys[0]], transitions=[])
    with pytest.raises(InputError, match="names a key position twice"):
        run_rebuild(twice, tmp_path / "two", QUIET)


def _way(length_m: float, score_db: float) -> Way:
    pose = np.column_stack([np.eye(3), [0.0, 0.0, -length_m]])
    nothing = np.zeros((0, 3), dtype=np.float32)
    flat = nothing[:, :2]
    mesh = MorphMesh(
        nothing, nothing, flat, flat, nothing[:, 0], nothing.astype(np.uint32), nothing[:, 0] > 0
    )
    return Way(pose, mesh, mesh, Verdict(score_db, 10.0, 1.0, 1.0))


def test_a_branch_stands_where_its_link_leads() -> None:
    """0 - 1 - 2, and 3 that only a link from 1 reaches; from 2 to 3 there is no way."""
    cut = Way(np.eye(4)[:3], why="nothing")
    ways = [_way(2.0, 20.0), _way(3.0, 20.0), cut, _way(5.0, 18.0)]
    ends = [(0, 1), (1, 2), (2, 3), (1, 3)]
    ahead = np.eye(4)
    ahead[2, 3] = 99.0
    found = worlds_of(4, np.eye(4), ends, ways, ahead)
    assert [one[2, 3] for one in found] == pytest.approx([0.0, 2.0, 5.0, 7.0])
    alone = worlds_of(4, np.eye(4), ends[:3], ways[:3], ahead)
    assert alone[3][2, 3] == pytest.approx(5.0 + 99.0)


def test_links_are_read_from_the_command_line() -> None:
    from veduta.cli.arguments import parse
    from veduta.cli.walk_call import WalkCall

    call = parse(WalkCall, "veduta walk", ["a", "-o", "b", "--links", "0:1", "2:3", "--every", "2"])
    assert call.options().take.links == ("0:1", "2:3")
    assert call.options().take.every == 2
