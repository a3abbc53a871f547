"""The whole verb on a drawn street: the place, its points, the document, and failing well."""

from __future__ import annotations

from pathlib import Path

import laspy
import numpy as np
import pytest

from veduta.drive import DriveOptions, run_drive
from veduta.drive.document.model import DriveDocument
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


def test_folder_without_a_drive_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no drive"):
        run_drive(tmp_path, tmp_path / "out", DriveOptions(), Progress(quiet=True))
    with pytest.raises(InputError, match="no such folder"):
        run_drive(tmp_path / "none", tmp_path / "out", DriveOptions(), Progress(quiet=True))
