"""The command `veduta plan --photos`: paint and tiles reach all files, and survive a rebuild."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from command_line import refused
from PIL import Image
from room_photo import RoomScene, Tiled, room_photo
from sample_plan import sample_plan
from test_validators import validate_gltf

from veduta.plan.options import HouseOptions, PlanOptions
from veduta.plan.photos.given import room_photos
from veduta.plan.pipeline import PlanResult, run_plan
from veduta.run.progress import Progress

QUICK = PlanOptions(
    house=HouseOptions(
        no_furniture=True, no_tour=True, lights="none", surroundings="none", roof="none"
    )
)


@pytest.fixture(scope="module")
def inputs(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A document, and a photo of one of its rooms."""
    folder = tmp_path_factory.mktemp("inputs")
    (folder / "plan.json").write_text(sample_plan().model_dump_json(by_alias=True))
    scene = RoomScene(floor_tiles=Tiled((0.3, 0.3), joint_m=0.008))
    Image.fromarray(room_photo(scene, 600, 450)).save(folder / "living.png")
    other = RoomScene(floor_tiles=Tiled((0.3, 0.3), joint_m=0.008, tile=(150, 170, 200)))
    Image.fromarray(room_photo(other, 600, 450)).save(folder / "other.png")
    return folder


def plan(document: Path, out: Path, *photos: str) -> PlanResult:
    return run_plan([document], out, QUICK, Progress(quiet=True), photos=room_photos(photos))


def living(out: Path) -> dict[str, Any]:
    content = json.loads((out / "plan.json").read_text())
    found: dict[str, Any] = content["storeys"][0]["rooms"][0]
    return found


def materials(out: Path) -> set[str]:
    return {one["name"] for one in gltf_of(out)["materials"]}


def gltf_of(out: Path) -> dict[str, list[dict[str, Any]]]:
    data = (out / "house.glb").read_bytes()
    length = int.from_bytes(data[12:16], "little")
    found: dict[str, list[dict[str, Any]]] = json.loads(data[20 : 20 + length])
    return found


def test_a_photo_reaches_all_files_and_a_rebuild_keeps_it(inputs: Path, tmp_path: Path) -> None:
    out, again, photo = tmp_path / "out", tmp_path / "again", f"Living={inputs / 'living.png'}"
    plan(inputs / "plan.json", out, photo)
    assert plan(inputs / "plan.json", out, photo).up_to_date
    own = living(out)
    colour = own["wall_colour"]
    assert colour["origin"] == "measured"
    told = "".join(f"{one:02x}" for one in colour["srgb"])
    assert {f"paint-{told}", "tiles-1-0.3-x-0.3"} <= materials(out)
    issues = validate_gltf(out / "house.glb")
    assert (issues["numErrors"], issues["numWarnings"]) == (0, 0), issues["messages"]
    x3d = (out / "house.x3d").read_text()
    assert f"look-paint-{told}" in x3d
    assert "look-tiles-1-0-3-x-0-3" in x3d
    page = (out / "report.html").read_text()
    assert "Photo of Living" in page
    assert f"paint #{told}" in page

    # Somewhere else, and without the photo.
    plan(out / "plan.json", again)
    assert living(again) == own
    assert materials(again) == materials(out)
    ours, theirs = (np.asarray(Image.open(one / "tiles-1.png")) for one in (out, again))
    assert (ours == theirs).all()


def test_photos_may_come_later_and_an_edited_document_stays(inputs: Path, tmp_path: Path) -> None:
    out, photo = tmp_path / "out", f"living={inputs / 'living.png'}"
    plan(inputs / "plan.json", out)
    assert living(out)["wall_colour"] is None
    made = plan(out / "plan.json", out, photo)
    assert made.notes == []
    assert living(out)["wall_colour"] is not None
    plan(out / "plan.json", out, photo)
    assert plan(out / "plan.json", out, photo).up_to_date

    content = json.loads((out / "plan.json").read_text())
    content["storeys"][0]["rooms"][0]["wall_colour"] = {"srgb": [10, 200, 30]}
    edited = json.dumps(content)
    (out / "plan.json").write_text(edited)
    texture = (out / "tiles-1.png").read_bytes()
    plan(out / "plan.json", out)
    assert "paint-0ac81e" in materials(out)
    told = plan(out / "plan.json", out, photo)
    assert "paint-0ac81e" not in materials(out)
    assert (out / "plan.json").read_text() == edited
    assert sum("was edited and stays as it is" in note for note in told.notes) == 1
    assert plan(out / "plan.json", out, photo).notes == told.notes

    # Another photo makes another house; the document's own picture is still there for the next.
    other = f"living={inputs / 'other.png'}"
    assert any("was edited" in note for note in plan(out / "plan.json", out, other).notes)
    assert (out / "tiles-1.png").read_bytes() == texture
    assert {name[:7] for name in materials(out) if name.startswith("tiles")} == {"tiles-2"}
    plan(out / "plan.json", out)
    assert (out / "tiles-1.png").read_bytes() == texture
    assert not (out / "tiles-2.png").exists()
    assert "tiles-1-0.3-x-0.3" in materials(out)


def test_a_photo_that_an_edited_document_has_already_is_no_news(
    inputs: Path, tmp_path: Path
) -> None:
    out, photo = tmp_path / "out", f"living={inputs / 'living.png'}"
    plan(inputs / "plan.json", out, photo)
    content = json.loads((out / "plan.json").read_text())
    content["storeys"][0]["rooms"][1]["name"] = "Bath 2"
    (out / "plan.json").write_text(json.dumps(content))
    assert plan(out / "plan.json", out, photo).notes == []


def test_an_unknown_room_is_refused_and_leaves_nothing(inputs: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    told = refused(
        "plan", inputs / "plan.json", "-o", out, "--photos", f"attic={inputs / 'living.png'}"
    )
    assert told.returncode == 2
    assert "there is no room 'attic'" in told.stderr
    assert "ground floor/living (Living), ground floor/bath (Bath)" in told.stderr
    assert not out.exists()
