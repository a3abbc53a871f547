"""`place.json`: there and back, and what is refused."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from veduta.formats.place_json import read_place, write_place
from veduta.place.manifest import Bounds, Place, PlacePart, Start
from veduta.run.errors import InputError


def sample_place() -> Place:
    part = PlacePart(
        id="house",
        name="House",
        model="house/model.glb",
        photo="house/rectified.jpg",
        arrangement="single",
        bounds=Bounds(min=(0.0, -0.8, 0.0), max=(12.0, 10.0, 18.6)),
    )
    return Place(parts=[part], start=Start(eye=(6.0, -15.0, 1.7), target=(6.0, 0.0, 6.0)))


def test_there_and_back(tmp_path: Path) -> None:
    write_place(sample_place(), tmp_path / "place.json")
    assert read_place(tmp_path / "place.json") == sample_place()
    raw = json.loads((tmp_path / "place.json").read_text())
    assert (raw["schema"], raw["version"], raw["crs"]) == ("veduta/place", 1, None)


@pytest.mark.parametrize(
    ("content", "fault"),
    [
        ("{", "the file"),
        ("[]", "the file"),
        (
            sample_place().model_dump_json(by_alias=True).replace('"version":1', '"version":2'),
            "version",
        ),
        (
            sample_place().model_dump_json(by_alias=True).replace("house/model", "../model"),
            "parts.0.model",
        ),
    ],
)
def test_what_is_wrong_is_named(tmp_path: Path, content: str, fault: str) -> None:
    path = tmp_path / "place.json"
    path.write_text(content)
    with pytest.raises(InputError, match=fault):
        read_place(path)


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="cannot be read"):
        read_place(tmp_path / "place.json")
