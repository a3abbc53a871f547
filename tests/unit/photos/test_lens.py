"""The kind of camera is chosen by evidence: the true one is known here."""

from __future__ import annotations

import numpy as np
import pytest
from known_structure import known_structure

from veduta.photos.lens import CameraKind, Candidate, choose_lens, simplest_of, with_cameras
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
    noise = np.array([0.01, -0.01, 0.012, -0.009])
    simple = Candidate(CameraKind("pinhole", "shared", "middle"), 2, 0.50, 0.25 + noise)
    rich = Candidate(CameraKind("opencv", "shared", "middle"), 6, 0.499, np.full(4, 0.249))
    assert simplest_of([simple, rich]) is simple
    poor = Candidate(simple.kind, 2, 0.6, np.full(4, 0.36) + noise)
    assert simplest_of([poor, rich]) is rich


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
