"""The table of cameras, against published crop factors and equivalent focal lengths."""

from __future__ import annotations

import csv
import math

import pytest

from veduta.imaging.sensors import TABLE, sensor_of

DIAGONAL_35MM = math.hypot(36.0, 24.0)


def rows(name: str) -> list[dict[str, str]]:
    with (TABLE / name).open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


@pytest.mark.parametrize(
    ("make", "model", "crop"),
    [
        ("Canon", "Canon EOS 5D Mark II", 1.0),
        ("Canon", "Canon EOS 400D DIGITAL", 1.6),
        ("Canon", "Canon EOS-1D Mark III", 1.3),
        ("NIKON CORPORATION", "NIKON D60", 1.53),
        ("NIKON CORPORATION", "NIKON 1 J1", 2.7),
        ("SONY", "DSC-RX100M3", 2.7),
        ("SONY", "NEX-5N", 1.53),
        ("OLYMPUS IMAGING CORP.", "E-M10", 2.0),
        ("OM Digital Solutions", "OM-1", 2.0),
        ("Panasonic", "DMC-GF1", 2.0),
        ("RICOH IMAGING COMPANY, LTD.", "PENTAX K-1", 1.0),
        ("LEICA CAMERA AG", "LEICA Q2", 1.0),
        ("FUJIFILM", "GFX 50S", 0.79),
    ],
)
def test_crop_factors(make: str, model: str, crop: float) -> None:
    sensor = sensor_of(make, model, 30.0)
    assert sensor is not None
    found = DIAGONAL_35MM / math.hypot(sensor.width_mm, sensor.height_mm)
    assert found == pytest.approx(crop, rel=0.035)


@pytest.mark.parametrize(
    ("make", "model", "focal_mm", "focal_mm35"),
    [
        ("Apple", "iPhone 4S", 4.28, 35),
        ("Apple", "iPhone 6", 4.15, 29),
        ("Apple", "iPhone 8", 3.99, 28),
        ("Apple", "iPhone XR", 4.25, 26),
        ("Apple", "iPhone 13", 5.1, 26),
        ("Apple", "iPhone 14 Pro", 6.86, 24),
        ("samsung", "SM-G973F", 4.32, 26),
        ("Google", "Pixel 6", 6.81, 25),
        ("DJI", "FC6310", 8.8, 24),
        ("EASTMAN KODAK COMPANY", "KODAK Z612 ZOOM DIGITAL CAMERA", 5.85, 35),
    ],
)
def test_equivalents_that_the_cameras_state_themselves(
    make: str, model: str, focal_mm: float, focal_mm35: float
) -> None:
    """Makers round, and some keep the width, not the diagonal."""
    sensor = sensor_of(make, model, focal_mm)
    assert sensor is not None
    found = focal_mm * DIAGONAL_35MM / math.hypot(sensor.width_mm, sensor.height_mm)
    assert found == pytest.approx(focal_mm35, rel=0.07)


@pytest.mark.parametrize(
    ("make", "model", "focal_mm"),
    [
        ("Nobody", "Nothing", 5.0),
        ("", "", 5.0),
        ("Nobody", "D3", 5.0),  # Nikon has one
        ("NIKON CORPORATION", "NIKON D30000", 5.0),
        ("Apple", "iPhone 14 Pro", 2.22),  # its wide-angle camera
    ],
)
def test_what_the_table_does_not_have(make: str, model: str, focal_mm: float) -> None:
    assert sensor_of(make, model, focal_mm) is None


def test_a_d3_is_no_d3000() -> None:
    full, half = sensor_of("NIKON", "NIKON D3", 30.0), sensor_of("NIKON", "NIKON D3000", 30.0)
    assert full is not None
    assert half is not None
    assert (full.width_mm, half.width_mm) == (36.0, 23.5)


def test_the_table_is_whole() -> None:
    """Each row names a format, none stands twice, and each can be found under its own name."""
    sensors = {row["sensor"]: row for row in rows("sensors.csv")}
    for row in sensors.values():
        assert 1.0 < float(row["width_mm"]) / float(row["height_mm"]) < 1.8
    models = rows("models.csv")
    assert {row["sensor"] for row in models} == set(sensors)
    names = [(row["make"], row["model"], row["focal_mm"]) for row in models]
    assert len(set(names)) == len(names) > 150
    for row in models:
        focal = float(row["focal_mm"] or 30.0)
        name = row["model"]
        found = sensor_of(row["make"], f"{name[:-1]}F" if name.endswith("*") else name, focal)
        assert found is not None
        assert found.width_mm == float(sensors[row["sensor"]]["width_mm"])
