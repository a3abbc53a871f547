"""An animal without limbs from the side: length, heights and beat against drawn footage."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import veduta
from veduta.fauna.build.build import build_animal
from veduta.fauna.document.schema import Source
from veduta.fauna.motion.wave import swimming_wave
from veduta.fauna.options import AnimalOptions, FaunaOptions, MotionOptions
from veduta.fauna.read.coat import coat_from_side
from veduta.fauna.read.footage import Footage
from veduta.fauna.read.from_side import headed, seen_length, straight_axes, tail_beat
from veduta.fauna.read.limbless import Seen, silhouettes_in, tracked_axes
from veduta.fauna.read.side_document import describe_from_side
from veduta.fauna.read.tracked import Described, Tracked
from veduta.fauna.read.usual import usual_angles
from veduta.run.errors import InputError
from veduta.synthetic.animals import Filmed, film_fish_from_side

OPTIONS = FaunaOptions(animal=AnimalOptions(kind="fish", view="side"))
FRAME_S = 0.04


def described(film: Filmed) -> Described:
    count = len(film.frames)
    footage = Footage(film.frames, np.arange(count), FRAME_S, assumed=False)
    silhouettes, background = silhouettes_in(footage, None, None, "clip")
    seen = Seen(silhouettes, straight_axes(silhouettes.masks), background)
    areas = silhouettes.masks.sum(axis=(1, 2)).astype(np.float64)
    source = Source(file="", sha256="", frames=count, used=count)
    return describe_from_side(tracked_axes(footage, seen), areas, "fish", source, OPTIONS)


@pytest.mark.parametrize(("leftwards", "keeled"), [(False, False), (True, True)])
def test_a_fish_from_the_side(leftwards: bool, keeled: bool) -> None:
    film = film_fish_from_side(61, leftwards=leftwards, keeled=keeled)
    found = described(film)
    body, motion = found.animal.body, found.animal.motion
    assert (body.heights, body.widths) == ("measured", "invented")
    assert seen_length(found.tracked) == pytest.approx(film.length_px, rel=0.05)
    at = [one.at for one in body.slices]
    high = [one.half_height * film.length_px for one in body.slices]
    assert np.interp(0.25, at, high) == pytest.approx(film.halves["fore"], rel=0.1)
    assert np.interp(0.5, at, high) == pytest.approx(film.halves["middle"], rel=0.1)
    assert found.looks_right is not None
    assert (found.looks_right != leftwards).all()
    assert motion.provenance == "inferred"
    assert 24 * motion.frame_s == pytest.approx(film.cycle * FRAME_S, rel=0.03)
    built = build_animal(found.animal, MotionOptions())
    # What was not seen is no footage's motion.
    assert [gait.name for gait in built.gaits] == ["swim", "roam"]


def test_a_beat_is_found_whether_it_is_seen_once_or_twice() -> None:
    time = np.arange(60) * FRAME_S
    noise = np.random.default_rng(4).normal(0.0, 0.1, (2, 60))
    once, twice = np.sin(2.0 * np.pi * 1.7 * time), np.sin(2.0 * np.pi * 3.4 * time + 1.0)
    for seen in (
        np.stack([twice, twice]), np.stack([once + twice, twice]), np.stack([2 * once, twice])
    ):  # fmt: skip
        beat = tail_beat(100.0 + seen + noise, time)
        assert beat is not None
        assert beat.frequency_hz == pytest.approx(1.7, rel=0.02)
    assert tail_beat(100.0 + noise, time) is None


def test_it_looks_where_it_goes_and_a_turn_is_no_swap() -> None:
    """It goes to the right and back again; the tracked axes keep one end of the picture first."""
    x = np.concatenate([np.linspace(0.0, 300.0, 30), np.linspace(300.0, 0.0, 30)])
    along = np.linspace(50.0, -50.0, 11)
    points = np.stack([x[:, None] + along, np.zeros((60, 11))], axis=2)
    half = np.broadcast_to(np.linspace(1.0, 2.0, 11), (60, 11))
    tracked = Tracked(points, np.arange(60), FRAME_S, "px", half.copy(), ())
    found, looks_right = headed(tracked)
    assert looks_right[:26].all()
    assert not looks_right[34:].any()
    ahead = found.points[:, 0, 0] - found.points[:, -1, 0]
    assert ((ahead > 0.0) == looks_right).all()
    assert found.half_widths is not None
    assert found.half_widths[0, 0] == 1.0
    assert found.half_widths[-1, 0] == 2.0


def test_each_flank_has_its_own_colours_and_the_back_is_above() -> None:
    frames = np.zeros((2, 40, 100, 3), dtype=np.uint8)
    frames[0, :20], frames[0, 20:] = (200, 0, 0), (0, 200, 0)  # looks left: back red, belly green
    frames[1, :20], frames[1, 20:] = (0, 0, 200), (200, 200, 0)
    line = np.stack([np.linspace(10.0, 90.0, 21), np.full(21, 20.0)], axis=1)
    points = np.stack([line, line[::-1]])
    half = np.full(21, 15.0)
    both = coat_from_side(frames, points, half, np.array([False, True]))
    v = [int(share * 128) for share in (0.06, 0.44, 0.56, 0.94)]
    colours = [tuple(both.pixels[row, 256]) for row in v]
    assert colours == [(0, 200, 0), (200, 0, 0), (0, 0, 200), (200, 200, 0)]
    assert both.invented is not None
    assert not both.invented.any()
    left = coat_from_side(frames[:1], points[:1], half, np.array([False]))
    colours = [tuple(left.pixels[row, 256]) for row in v]
    assert colours == [(0, 200, 0), (200, 0, 0), (200, 0, 0), (0, 200, 0)]
    assert left.invented is not None
    assert left.invented[64:].all()
    assert not left.invented[:64].any()


@pytest.mark.parametrize("kind", ["snake", "worm", "fish"])
def test_a_kind_s_wave_runs_from_head_to_tail(kind: str) -> None:
    time = np.arange(49) / 24.0
    wave = swimming_wave(usual_angles(kind, time, 100), time)  # type: ignore[arg-type]
    assert wave.frequency_hz == pytest.approx(1.0, rel=0.01)
    phase = np.unwrap(np.angle(wave.amplitude[20:80]))
    assert phase[-1] < phase[0] - 1.0


def test_frames_in_which_it_turns_to_the_camera_are_left_out() -> None:
    film = film_fish_from_side(62)
    turned = film.frames.copy()
    low = np.array(film.joints["axis"]).reshape(60, -1, 2)[:, :, 0].min(axis=1)
    for row in range(20, 24):  # its hind half is not there
        edge = int(low[row] + 0.35 * film.length_px)
        turned[row, :, :edge] = film.background[:, :edge]
    found = described(replace(film, frames=turned))
    named = " ".join(found.animal.source.left_out)
    assert "frame 20" in named
    assert len(found.axes) <= 56


def test_midlines_are_those_from_above(tmp_path: Path) -> None:
    csv = tmp_path / "midlines.csv"
    csv.write_text("frame,point,x,y\n0,0,0,0\n0,1,1,0\n")
    with pytest.raises(InputError, match="midlines, which are those of an animal that was seen"):
        veduta.read_animal(csv, tmp_path / "out", kind="fish", view="side")


def test_a_folder_of_frames_becomes_a_swimming_fish(tmp_path: Path) -> None:
    film = film_fish_from_side(63)
    (tmp_path / "frames").mkdir()
    for number, frame in enumerate(film.frames[::2]):
        Image.fromarray(frame).save(tmp_path / "frames" / f"{number:03}.png")
    out = tmp_path / "out"
    veduta.read_animal(tmp_path / "frames", out, kind="fish", view="side", fps=12.5, length_m=0.4)
    report = json.loads((out / "report.json").read_text())
    assert report["measures"]["silhouette_iou_median"] > 0.8
    animal = json.loads((out / "animal.json").read_text())
    assert any("how far it swings" in doubt for doubt in animal["doubts"])
    assert animal["length"]["metres"] == 0.4
    scores = animal["source"]["scores"]
    assert [frame for frame, _ in scores] == list(range(30))
    assert all(0.8 < score <= 1.0 for _, score in scores)
    assert report["measures"]["silhouette_score_worst"] == min(score for _, score in scores)
    coat = np.asarray(Image.open(out / "coat.png"))
    # It goes to the right: the left flank, the upper half, is invented.
    assert (coat[:60, 256, 3] < 255).all()
    assert (coat[70:, 256, 3] == 255).all()
