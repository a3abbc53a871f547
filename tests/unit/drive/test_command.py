"""The whole verb on a drawn street: the place, its points, the document, and failing well."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import laspy
import numpy as np
import pytest
from PIL import Image

from veduta.drive import stages
from veduta.drive.command import run_drive
from veduta.drive.document.model import DriveDocument
from veduta.drive.options import DriveOptions, TextureOptions
from veduta.formats.glb_mesh import read_glb_mesh
from veduta.place.place import Place
from veduta.run.errors import InputError
from veduta.run.progress import Progress
from veduta.synthetic.drives import (
    StreetOptions,
    TruckOptions,
    build_street,
    scan_street,
    write_drive,
)


@pytest.fixture(scope="module")
def log(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("log")
    street = build_street(StreetOptions(length_m=30.0), 4)
    write_drive(scan_street(street, TruckOptions(), 4), folder)
    return folder


@pytest.fixture(scope="module")
def out(log: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("made") / "out"
    result = run_drive(log, folder, DriveOptions(), Progress(quiet=True))
    assert result.exit_code == 0
    assert result.measures["segments"] == 1
    return folder


def test_walls_and_ground_stand_in_the_place(out: Path) -> None:
    place = Place.load(out)
    assert sorted(place.parts) == ["left-001", "left-001-ground"]
    vertices, triangles = place.parts["left-001"].triangles()
    assert len(triangles) > 100
    assert abs(np.median(vertices[:, 0]) + 11.0) < 0.8  # the facades are 11 m to the left
    assert place.parts["left-001-ground"].standing.ground
    ground = place.parts["left-001-ground"].triangles()[0][:, 2]
    assert ground.min() == pytest.approx(0.0, abs=1e-3)
    assert np.median(ground) + place.origin_m[2] == pytest.approx(0.0, abs=0.05)
    assert place.tours[0].id == "drive"


def test_facade_planes_stand_along_the_street(out: Path) -> None:
    planes = json.loads((out / "facades/facades.json").read_text())["facades"]
    assert 1 <= len(planes) <= 12
    assert sum(plane["width_m"] for plane in planes) > 20.0
    for plane in planes:
        left, right = np.array(plane["left_m"]), np.array(plane["right_m"])
        assert abs(left[0] + 11.0) < 1.2
        assert abs(right[0] + 11.0) < 1.2
        assert left[1] < right[1]  # looking west, north is to the right
        assert 2.0 < plane["height_m"] < 17.0
        assert "picture" not in plane  # there are no images


def test_points_have_their_classes(out: Path) -> None:
    cloud = laspy.read(out / "points.laz")
    kinds = set(np.unique(cloud.classification).tolist())
    assert {2, 6, 64, 65} <= kinds
    cars = np.asarray(cloud.x)[np.asarray(cloud.classification) == 64]
    assert (cars > -10.5).mean() > 0.9


def test_document_says_why(out: Path) -> None:
    document = DriveDocument.model_validate_json((out / "drive.json").read_text())
    assert {one.id: one.side for one in document.segments} == {
        "left-001": "left", "right-002": "right",
    }  # fmt: skip
    assert all(one.reason for one in document.segments)


def test_second_run_has_nothing_to_do(log: Path, out: Path) -> None:
    assert run_drive(log, out, DriveOptions(), Progress(quiet=True)).up_to_date
    with pytest.raises(InputError, match="--force"):
        run_drive(log, out, DriveOptions(seed=2), Progress(quiet=True))


def test_edited_document_is_rebuilt_from(log: Path, out: Path, tmp_path: Path) -> None:
    document = DriveDocument.model_validate_json((out / "drive.json").read_text())
    segment = document.segments[0]
    half = segment.model_copy(update={"line": segment.line[: len(segment.line) // 2]})
    edited = document.model_copy(update={"segments": [half]})
    path = tmp_path / "edited.json"
    path.write_text(edited.model_dump_json(by_alias=True))
    quiet = Progress(quiet=True)
    result = run_drive(log, tmp_path / "out", DriveOptions(), quiet, document=path)
    assert result.measures["segments"] == 1
    whole, part = (
        Place.load(one).parts["left-001"].triangles()[0] for one in (out, tmp_path / "out")
    )
    assert np.ptp(part[:, 1]) == pytest.approx(np.ptp(whole[:, 1]) / 2, rel=0.15)


def test_segment_is_left_as_it_is_where_the_document_says_so(
    log: Path, out: Path, tmp_path: Path
) -> None:
    folder = tmp_path / "out"
    shutil.copytree(out, folder)
    path = folder / "drive.json"
    document = DriveDocument.model_validate_json(path.read_text())
    fated = [one.model_copy(update={"fate": "as-is"}) for one in document.segments[:1]]
    path.write_text(document.model_copy(update={"segments": fated}).model_dump_json(by_alias=True))
    result = run_drive(log, folder, DriveOptions(), Progress(quiet=True), document=path)
    assert result.measures["objects_taken_out"] == 0
    assert 64 not in np.unique(laspy.read(folder / "points.laz").classification)
    vertices = Place.load(folder).parts["left-001"].triangles()[0]
    assert (vertices[:, 0] > -7.5).any()  # cars stand in the mesh again
    again = run_drive(log, folder, DriveOptions(), Progress(quiet=True), document=path)
    assert again.up_to_date


def test_document_of_another_drive_is_refused(log: Path, out: Path, tmp_path: Path) -> None:
    path = tmp_path / "edited.json"
    text = (out / "drive.json").read_text()
    path.write_text(text.replace('"sweep": "000003"', '"sweep": "900003"'))
    with pytest.raises(InputError, match=r"'900003' that is not in the log"):
        run_drive(log, tmp_path / "o", DriveOptions(), Progress(quiet=True), document=path)
    path.write_text('{"schema": "veduta/drive"}')
    with pytest.raises(InputError, match="Field required"):
        run_drive(log, tmp_path / "o", DriveOptions(), Progress(quiet=True), document=path)


def test_killed_run_goes_on_from_what_was_made(
    log: Path, out: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As after kill -9: the private folder has stages and no result."""

    def killed(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr("veduta.drive.stages.texture", killed)
        with pytest.raises(KeyboardInterrupt):
            run_drive(log, tmp_path / "out", DriveOptions(), Progress(quiet=True))
    made: list[str] = []
    whole = stages.reconstruct
    monkeypatch.setattr(
        "veduta.drive.stages.reconstruct", lambda *given: made.append("again") or whole(*given)
    )
    run_drive(log, tmp_path / "out", DriveOptions(), Progress(quiet=True))
    assert made == []
    for name in ("drive.json", "parts/left-001.glb", "place.json"):
        assert (tmp_path / "out" / name).read_bytes() == (out / name).read_bytes()


def test_killed_rebuild_is_not_continued_with_another_path(
    log: Path, out: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    document = DriveDocument.model_validate_json((out / "drive.json").read_text())
    path = tmp_path / "edited.json"
    made: list[str] = []
    path.write_text(document.model_dump_json(by_alias=True))
    whole = stages.reconstruct
    monkeypatch.setattr(
        "veduta.drive.stages.reconstruct", lambda *given: made.append("made") or whole(*given)
    )

    def killed(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    quiet = Progress(quiet=True)
    with monkeypatch.context() as patch:
        patch.setattr("veduta.drive.stages.texture", killed)
        with pytest.raises(KeyboardInterrupt):
            run_drive(log, tmp_path / "out", DriveOptions(), quiet, document=path)
    before = len(made)
    assert before > 0
    north = np.array([0, 0, 0, 0, 0, 0, 0, 1.0, 0, 0, 0, 0])
    moved = [
        pose.model_copy(update={"matrix": tuple((np.array(pose.matrix) + north).tolist())})
        for pose in document.path
    ]
    path.write_text(document.model_copy(update={"path": moved}).model_dump_json(by_alias=True))
    run_drive(log, tmp_path / "out", DriveOptions(), quiet, document=path)
    assert len(made) == 2 * before


def test_street_without_houses_is_no_success(tmp_path: Path) -> None:
    street = build_street(StreetOptions(length_m=10.0, cars=0, trees=0, lamps=0), 1)
    nothing = np.zeros((0, 2, 3))
    bare = type(street)(
        nothing, nothing, street.cylinders, street.balls, nothing, nothing, street.length_m
    )
    write_drive(scan_street(bare, TruckOptions(), 1), tmp_path / "log")
    result = run_drive(tmp_path / "log", tmp_path / "out", DriveOptions(), Progress(quiet=True))
    assert result.exit_code == 3
    assert "facade" in (result.failure.reason if result.failure else "")


def test_anonymising_is_refused_rather_than_left_out(log: Path, tmp_path: Path) -> None:
    options = DriveOptions(texture=TextureOptions(anonymise=True))
    with pytest.raises(InputError, match="no detector"):
        run_drive(log, tmp_path / "out", options, Progress(quiet=True))
    assert not (tmp_path / "out").exists()


def test_folder_without_a_drive_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no drive"):
        run_drive(tmp_path, tmp_path / "out", DriveOptions(), Progress(quiet=True))
    with pytest.raises(InputError, match="no such folder"):
        run_drive(tmp_path / "none", tmp_path / "out", DriveOptions(), Progress(quiet=True))


def test_the_street_as_scanned_lies_beside_each_model(out: Path) -> None:
    """The raw model has what stood before the facades; the mended one does not."""
    rows = {row["id"]: row for row in json.loads((out / "place.json").read_text())["parts"]}
    assert rows["left-001"]["raw"] == "raw/left-001.glb"
    vertices = {}
    for name in ("left-001", "left-001-ground"):
        x, y, z = read_glb_mesh(out / rows[name]["raw"]).points.T
        moved = np.array(rows[name]["transform"]).reshape(4, 4).T
        vertices[name] = np.stack([x, -z, y], axis=1) @ moved[:3, :3].T + moved[:3, 3]
    walls = vertices["left-001"]
    assert ((walls[:, 0] > -9.5) & (walls[:, 2] > 0.5)).mean() > 0.05  # cars and trees
    built = Place.load(out).parts["left-001"].triangles()[0]
    assert ((built[:, 0] > -9.5) & (built[:, 2] > 0.5)).mean() < 0.01
    assert abs(np.median(vertices["left-001-ground"][:, 2])) < 0.3


def test_a_page_asks_which_is_better(out: Path) -> None:
    """Both pictures of each segment are there; only what was scanned has holes."""
    page = (out / "vote.html").read_text()
    rows = json.loads((out / "place.json").read_text())["parts"]
    for name in {row["id"].removesuffix("-ground") for row in rows}:
        assert f'data-segment="{name}" data-made="' in page
        pictures = []
        for word in ("scanned", "made"):
            assert f'src="vote/{name}-{word}.jpg"' in page
            with Image.open(out / "vote" / f"{name}-{word}.jpg") as picture:
                pictures.append(np.asarray(picture, dtype=float).mean(axis=2))
        assert pictures[0].shape == pictures[1].shape
        empty = [(one > 220).mean() for one in pictures]
        assert 0.1 < empty[1] < empty[0] < 0.9


def test_times_stand_beside_the_papers(out: Path) -> None:
    report = (out / "report.html").read_text()
    assert "texture mapping and atlas" in report
    assert "1394" not in report  # 23 h 08 min are 1388
    assert "1388" in report.replace(",", "").replace("\u202f", "")
