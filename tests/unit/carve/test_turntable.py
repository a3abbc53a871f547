"""Turntables whose angles are not known: a rendered body, truth withheld."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest
import trimesh
from turned_object import body, silhouettes

from veduta.carve.command import run_carve
from veduta.carve.options import (
    CarveOptions,
    ColourOptions,
    PoseOptions,
    TextureOptions,
    VolumeOptions,
)
from veduta.carve.read.turning import Table, misses, outlines_of
from veduta.carve.read.turntable import Focal, TurntableRule, find_turns, seem_uneven
from veduta.place.place import Place
from veduta.run.errors import InputError, NotFoundError
from veduta.run.progress import Progress

SIZE = (320, 240)
FOCAL = 450.0
GUESS = Focal(1.3 * SIZE[0], 0.4)
RULE = TurntableRule(largest_px=320, points=32)


def _table(count: int, *, sign: float = 1.0, roll: float = 0.02, uneven: float = 0.3) -> Table:
    rng = np.random.default_rng(3)
    steps = 2.0 * np.pi / count * (1.0 + uneven * rng.uniform(-1.0, 1.0, count))
    angles = sign * np.concatenate([[0.0], np.cumsum(steps)[:-1]])
    return Table(FOCAL, float(np.radians(20.0)), roll, 0.01, angles)


def _photos_of(table: Table, folder: Path) -> Path:
    folder.mkdir()
    for number, mask in enumerate(silhouettes(table, SIZE)):
        photo = np.where(mask[..., None], (60, 120, 200), 15).astype(np.uint8)
        cv2.imwrite(str(folder / f"turn{number:02d}.png"), photo)
    return folder


def test_rays_of_the_right_table_miss_nothing_and_others_do() -> None:
    table = _table(16)
    lines, factor = outlines_of(silhouettes(table, SIZE), 32, SIZE[0])
    assert factor == 1.0
    assert misses(table, lines).miss_px.max() < 1.0
    wrong = replace(table, angles=np.linspace(0.0, 5.0, 16))
    assert np.sqrt(np.square(np.maximum(misses(wrong, lines).miss_px, 0.0)).mean()) > 2.0


@pytest.mark.parametrize(("sign", "roll"), [(1.0, 0.02), (-1.0, np.pi / 2.0)])
def test_uneven_turns_are_found(sign: float, roll: float) -> None:
    truth = _table(16, sign=sign, roll=roll)
    told: list[float] = []
    found = find_turns(
        silhouettes(truth, SIZE), GUESS, rule=RULE, progress=lambda _, share: told.append(share)
    )
    # It goes on all the time: nobody waits for minutes at one number.
    assert told == sorted(told)
    assert len(told) > 30
    assert told[-1] <= 1.0
    error = np.degrees(found.table.angles - truth.angles)
    error -= np.median(error)
    assert np.sqrt(np.square(error).mean()) < 1.0
    assert found.table.focal_px == pytest.approx(FOCAL, rel=0.08)
    assert found.table.tilt == pytest.approx(truth.tilt, abs=np.radians(1.0))
    assert found.table.roll == pytest.approx(roll, abs=np.radians(1.0))
    assert found.miss_px < 0.5


def test_a_vase_does_not_say_how_far_it_turned_but_takes_even_turns() -> None:
    vase = trimesh.creation.cylinder(0.12, 0.3, sections=128)
    truth = _table(12, uneven=0.0)
    masks = silhouettes(truth, SIZE, vase)
    with pytest.raises(NotFoundError, match="as round as a vase"):
        find_turns(masks, GUESS, rule=RULE)
    found = find_turns(masks, Focal(FOCAL, 1e-3), even=True, rule=RULE)
    assert np.diff(np.abs(found.table.angles)) == pytest.approx(2.0 * np.pi / 12)
    assert np.isnan(found.deviations).all()
    assert not seem_uneven(found, SIZE, RULE)


def test_a_silhouette_that_vanishes_in_a_small_photo_is_refused() -> None:
    masks = [np.zeros((240, 320), dtype=bool) for _ in range(4)]
    for mask in masks:
        mask[90:150, 120:200] = True
    masks[2][:] = False
    masks[2][100, 150] = True
    with pytest.raises(InputError, match="photo 3 shows no silhouette at 80 px") as raised:
        outlines_of(masks, 16, 80)
    assert "larger" in str(raised.value)


def test_uneven_turns_that_are_taken_as_even_are_doubted(tmp_path: Path) -> None:
    """Steps as of a ring that is no full turn: what the report says is no certainty."""
    truth = replace(_table(16), angles=np.radians(23.48) * np.arange(16))
    folder = _photos_of(truth, tmp_path / "piece")
    options = CarveOptions(
        poses=PoseOptions(turntable=True, even_turns=True, focal_px=FOCAL),
        volume=VolumeOptions(levels=6),
        colour=ColourOptions(carve=False),
        texture=TextureOptions(no_texture=True),
    )
    result = run_carve(folder, tmp_path / "out", options, Progress(quiet=True))
    assert result.failure is None
    assert "turns_deviation_deg" not in result.measures
    assert any("try without --even-turns" in doubt for doubt in result.doubts)
    assert "deviation (degrees)" not in (tmp_path / "out" / "report.json").read_text()


def test_photos_in_another_order_are_refused() -> None:
    masks = silhouettes(_table(16), SIZE)
    mixed = [masks[n] for n in np.random.default_rng(1).permutation(16)]
    with pytest.raises(NotFoundError, match="how far the object turned") as raised:
        find_turns(mixed, GUESS, rule=RULE)
    assert "in the order" in str(raised.value)


def test_photos_of_several_sizes_and_cut_ones_are_refused() -> None:
    masks = silhouettes(_table(8), SIZE)
    with pytest.raises(InputError, match="several sizes"):
        find_turns([masks[0][:200], *masks[1:]], GUESS)
    with pytest.raises(InputError, match="leaves 8 of 8 photos"):
        find_turns([mask[:, 100:220] for mask in masks], GUESS)


def test_the_verb_carves_a_turntable(tmp_path: Path) -> None:
    """The volume is known but for the scale: metres in the camera's distance."""
    truth = _table(16, uneven=0.0)
    folder = _photos_of(truth, tmp_path / "piece")
    options = CarveOptions(
        poses=PoseOptions(turntable=True),
        volume=VolumeOptions(levels=6),
        colour=ColourOptions(carve=False),
        texture=TextureOptions(no_texture=True),
    )
    result = run_carve(folder, tmp_path / "out", options, Progress(quiet=True))
    turned = np.array(result.measures["turns_deg"])
    assert turned == pytest.approx(np.degrees(np.abs(truth.angles)), abs=2.5)
    assert result.measures["silhouette_iou_least"] > 0.93
    assert result.measures["volume_units3"] == pytest.approx(body().convex_hull.volume, rel=0.6)
    assert len(Place.load(tmp_path / "out").cameras) == 16


def test_a_turntable_without_photos(tmp_path: Path) -> None:
    options = CarveOptions(poses=PoseOptions(turntable=True))
    with pytest.raises(InputError, match="holds no photos"):
        run_carve(tmp_path, tmp_path / "out", options, Progress(quiet=True))
