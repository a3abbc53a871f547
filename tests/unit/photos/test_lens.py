"""The kind of camera is chosen by evidence: the true one is known here."""

from __future__ import annotations

import numpy as np
import pytest
from known_structure import known_structure

from veduta.photos.cameras.lens import CameraKind, Candidate, choose_lens, simplest_of, with_cameras
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
    kind = chosen(known_structure(model, params))
    assert kind.sharing == "shared"
    assert kind.lens in lenses
    assert places is None or kind.principal_point in places


def test_a_zoom_between_the_photos() -> None:
    steps = (1.0, 1.02, 1.05)
    structure = known_structure("SIMPLE_RADIAL", (1400.0, *MIDDLE, -0.1), focal_steps=steps)
    assert chosen(structure).sharing == "per-photo"


def test_what_is_asked_for_is_not_tried() -> None:
    asked = CameraOptions(lens="opencv", cameras="per-photo", principal_point="middle")
    choice = choose_lens(known_structure(points=50), asked, ONE_GROUP, seed=0)
    assert choice.kind == CameraKind("opencv", "per-photo", "middle")
    assert choice.tried == ()


def test_photos_of_different_cameras_share_none() -> None:
    structure = known_structure(points=200)
    apart = {image: image for image in structure.image_ids}
    choice = choose_lens(structure, CameraOptions(), apart, seed=0)
    assert {candidate.kind.sharing for candidate in choice.tried} == {"per-photo"}


def test_the_same_seed_chooses_the_same() -> None:
    structure = known_structure(points=300)
    first, second = (choose_lens(structure, CameraOptions(), ONE_GROUP, 4) for _ in range(2))
    assert [item.kind for item in first.tried] == [item.kind for item in second.tried]
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
