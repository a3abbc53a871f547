"""The kind of camera is chosen by evidence: the true one is known here."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from known_structure import known_structure

from veduta.photos.cameras.lens import (
    PARTS,
    SHORTEST_TRACK,
    CameraKind,
    Candidate,
    choose_lens,
    held_out_parts,
    simplest_of,
    with_cameras,
)
from veduta.photos.options import CameraOptions
from veduta.photos.structure import Structure, adjusted

ONE_GROUP = dict.fromkeys(range(1, 100), 1)
MIDDLE = (800.0, 600.0)


def chosen(structure: Structure, options: CameraOptions | None = None) -> CameraKind:
    return choose_lens(structure, options or CameraOptions(), ONE_GROUP, seed=0).kind


@pytest.mark.parametrize(
    ("model", "params", "lenses", "places"),
    [
        ("PINHOLE", (1400.0, 1400.0, *MIDDLE), {"pinhole", "simple-radial"}, {"middle"}),
        ("PINHOLE", (1400.0, 1405.0, 780.0, 611.0), {"pinhole"}, {"free"}),
        ("SIMPLE_RADIAL", (1400.0, *MIDDLE, -0.12), {"simple-radial"}, {"middle"}),
        ("RADIAL", (1400.0, *MIDDLE, -0.25, 0.3), {"radial"}, {"middle"}),
        ("OPENCV", (1400.0, 1420.0, *MIDDLE, -0.2, 0.15, 0.003, -0.004), {"opencv"}, None),
    ],
)
def test_one_camera(
    model: str, params: tuple[float, ...], lenses: set[str], places: set[str] | None
) -> None:
    kind = chosen(known_structure(model, params, points=150))
    assert kind.sharing == "shared"
    assert kind.lens in lenses
    assert places is None or kind.principal_point in places


def test_a_focal_length_that_is_held_holds_the_middle_too() -> None:
    structure = known_structure("PINHOLE", (1400.0, 1405.0, 780.0, 611.0), points=150)
    assert chosen(structure, CameraOptions(focal_px=1400.0)).principal_point == "middle"
    both = CameraOptions(focal_px=1400.0, principal_point="free", lens="pinhole")
    assert chosen(structure, both).principal_point == "free"


def test_a_zoom_between_the_photos() -> None:
    steps = (1.0, 1.02, 1.05)
    structure = known_structure(
        "SIMPLE_RADIAL", (1400.0, *MIDDLE, -0.1), focal_steps=steps, points=150
    )
    assert chosen(structure).sharing == "per-photo"


def test_what_is_asked_for_is_not_tried() -> None:
    asked = CameraOptions(lens="opencv", cameras="per-photo", principal_point="middle")
    choice = choose_lens(known_structure(points=50), asked, ONE_GROUP, seed=0)
    assert choice.kind == CameraKind("opencv", "per-photo", "middle")
    assert choice.tried == ()


def test_photos_of_different_cameras_share_none() -> None:
    structure = known_structure(points=80)
    apart = {image: image for image in structure.image_ids}
    choice = choose_lens(structure, CameraOptions(), apart, seed=0)
    assert {candidate.kind.sharing for candidate in choice.tried} == {"per-photo"}


def test_the_same_seed_chooses_the_same() -> None:
    structure = known_structure(points=80)
    first, second = (choose_lens(structure, CameraOptions(), ONE_GROUP, 4) for _ in range(2))
    for one, two in zip(first.tried, second.tried, strict=True):
        assert one.kind == two.kind
        assert np.array_equal(one.errors_px, two.errors_px)
    assert first.kind == second.kind


def test_simplest_of_what_is_as_good() -> None:
    rng = np.random.default_rng(2)
    photo_of = np.repeat(np.arange(8), 50)
    errors = np.abs(rng.normal(0.0, 0.5, 400))
    jitter = 0.02 * rng.standard_normal(400)
    simple = Candidate(CameraKind("pinhole", "shared", "middle"), 2, errors + jitter, photo_of)
    rich = Candidate(CameraKind("opencv", "shared", "middle"), 6, errors, photo_of)
    assert simplest_of([simple, rich]) is simple
    poor = Candidate(simple.kind, 2, 1.3 * errors + jitter, photo_of)
    assert simplest_of([poor, rich]) is rich
    # A few false matches, which fall better by chance, do not make up for that.
    lucky = np.where(np.arange(400) % 50 == 0, 9.0, errors)
    unlucky = np.where(np.arange(400) % 50 == 0, 30.0, errors)
    poor = Candidate(simple.kind, 2, 1.3 * lucky, photo_of)
    assert simplest_of([poor, Candidate(rich.kind, 6, unlucky, photo_of)]).kind == rich.kind


def test_the_errors_of_one_photo_go_together() -> None:
    """What is better in one photo alone, by however many observations, is chance."""
    photo_of = np.repeat(np.arange(6), 200)
    errors = np.random.default_rng(3).rayleigh(0.5, 1200)
    worse = np.where(photo_of == 0, 1.2 * errors, errors)
    simple = Candidate(CameraKind("pinhole", "shared", "middle"), 2, worse, photo_of)
    rich = Candidate(CameraKind("opencv", "shared", "middle"), 6, errors, photo_of)
    assert simplest_of([simple, rich]) is simple


def test_the_adjustment_finds_the_true_lens() -> None:
    """From a start without distortion; the truth is the oracle."""
    params = (1400.0, *MIDDLE, -0.12)
    structure = known_structure("SIMPLE_RADIAL", params, noise_px=0.1)
    kind = CameraKind("simple-radial", "shared", "middle")
    camera = adjusted(with_cameras(structure, kind, ONE_GROUP), free_principal_point=False).camera(
        0
    )
    assert camera.params[0] == pytest.approx(1400.0, rel=1e-3)
    assert camera.params[3] == pytest.approx(-0.12, abs=2e-3)


def test_each_observation_of_a_long_track_is_held_out_once() -> None:
    """Counted one by one; and what is left of a track still makes a point."""
    structure = known_structure(points=120)
    rng = np.random.default_rng(6)
    structure = structure.observed(rng.random(len(structure.point_of)) < 0.6)
    part_of = held_out_parts(structure, rng)
    lengths = set()
    for point in range(len(structure.points)):
        parts = part_of[structure.point_of == point].tolist()
        lengths.add(len(parts))
        if len(parts) < SHORTEST_TRACK:
            assert set(parts) <= {-1}
        else:
            counts = [parts.count(part) for part in range(PARTS)]
            assert sum(counts) == len(parts)
            assert max(counts) - min(counts) <= 1
            assert len(parts) - max(counts) >= SHORTEST_TRACK - 1
    assert min(lengths) < SHORTEST_TRACK < PARTS < max(lengths)


def test_what_is_clearly_worse_is_tried_no_further() -> None:
    structure = known_structure("SIMPLE_RADIAL", (1400.0, *MIDDLE, -0.12), points=100)
    choice = choose_lens(structure, CameraOptions(cameras="shared"), ONE_GROUP, seed=0)
    held_out = {candidate.kind: len(candidate.errors_px) for candidate in choice.tried}
    pinhole = CameraKind("pinhole", "shared", "middle")
    assert held_out[choice.kind] == max(held_out.values())
    assert held_out[pinhole] == min(held_out.values()) < held_out[choice.kind]
    assert choice.kind == CameraKind("simple-radial", "shared", "middle")


def test_without_long_tracks_the_simplest_kind_is_taken() -> None:
    structure = known_structure(photos=3, points=60)
    choice = choose_lens(structure, CameraOptions(), ONE_GROUP, seed=0)
    assert choice.kind == CameraKind("pinhole", "shared", "middle")
    assert choice.tried == ()


def test_a_few_long_tracks_tell_no_lens() -> None:
    """Four observations would be held out: of some parts none."""
    three = known_structure(photos=3, points=60)
    four = known_structure(photos=4, points=60)
    first = four.image_of < 3
    some = first | (four.point_of == four.point_of[~first][0])
    structure = four.observed(some)
    assert len(structure.image_of) > len(three.image_of)
    choice = choose_lens(structure, CameraOptions(), ONE_GROUP, seed=0)
    assert choice.kind == CameraKind("pinhole", "shared", "middle")
    assert choice.tried == ()


def test_false_matches_do_not_bend_the_lens() -> None:
    """One observation in thirty lies 40 px aside: with squares the lens is far off."""
    params = (1400.0, *MIDDLE, -0.12)
    structure = known_structure("SIMPLE_RADIAL", params, noise_px=0.1, points=150)
    rng = np.random.default_rng(8)
    keypoints = tuple(
        seen + np.where(rng.random((len(seen), 1)) < 1 / 30, [40.0, 0.0], 0.0)
        for seen in structure.keypoints_px
    )
    start = with_cameras(
        replace(structure, keypoints_px=keypoints),
        CameraKind("simple-radial", "shared", "middle"),
        ONE_GROUP,
    )
    bent = [
        abs(
            adjusted(start, free_principal_point=False, false_matches=bounded).camera(0).params[3]
            - params[3]
        )
        for bounded in (True, False)
    ]
    assert bent[0] < 2e-3 < bent[1]
