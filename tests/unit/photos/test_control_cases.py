"""Control points as people write and mark them: each kind of blunder is named."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from known_structure import known_structure
from test_world_fits import marked, similarity

from veduta.photos.world.control_axes import settled_axes
from veduta.photos.world.control_file import ControlPoint, ControlPoints, read_control
from veduta.photos.world.control_fit import control_georeference
from veduta.photos.world.control_marks import marks_within
from veduta.photos.world.control_words import control_words
from veduta.photos.world.georeference import Fit, Georeference, Residual
from veduta.photos.world.rough import roughly
from veduta.run.errors import InputError

NUMBERS = ["440000", "5900000", "10", "100", "200"]


@pytest.mark.parametrize(
    ("rest", "photo", "name"),
    [
        ("a.jpg", "a.jpg", ""),
        ("a.jpg g1", "a.jpg", "g1"),
        ("IMG 0001.jpg g1", "IMG 0001.jpg", "g1"),
        ('"IMG 0001.jpg" g1', "IMG 0001.jpg", "g1"),
        ("'a b.JPG'", "a b.JPG", ""),
        ('a.tif "north west"', "a.tif", "north west"),
        ("DSC0001 g 2", "DSC0001", "g 2"),
    ],
)
def test_a_photo_may_have_blanks_in_its_name(rest: str, photo: str, name: str) -> None:
    assert control_words(" ".join([*NUMBERS, rest])) == (NUMBERS, photo, name)


def test_tabs_keep_columns_apart() -> None:
    words = control_words("\t".join([*NUMBERS, "IMG 0001.jpg", "g1"]))
    assert words == (NUMBERS, "IMG 0001.jpg", "g1")
    with pytest.raises(ValueError, match="has 5 words"):
        control_words(" ".join(NUMBERS))


def written(path: Path, head: str, place: str) -> Path:
    path.write_text(f"{head}\n{place} 100 200 a.jpg g1\n")
    return path


def test_the_crs_is_read_as_people_write_it(tmp_path: Path) -> None:
    for head in ("EPSG: 32632", "epsg:32632 # utm", "EPSG 32632", "EPSG:32632"):
        path = written(tmp_path / "gcp.txt", head, "440000 5900000 10")
        assert read_control(path).crs == "EPSG:32632"


def test_degrees_under_a_metric_crs_are_refused(tmp_path: Path) -> None:
    path = written(tmp_path / "gcp.txt", "EPSG:32632", "9.18 48.7 120")
    with pytest.raises(InputError, match=r"gcp.txt.*looks like degrees.*Write WGS84"):
        read_control(path)
    # A local grid of metres begins at zero.
    assert read_control(written(path, "EPSG:28992", "155000 463000 0")).points
    with pytest.raises(InputError, match="latitude seems to come first"):
        read_control(written(path, "WGS84", "10 100 0"))


def blunders() -> list[tuple[int, int, float]]:
    return [(p, axis, d) for p in range(6) for axis in range(3) for d in (-3.0, -1.0, 1.0, 3.0)]


def test_the_point_that_is_wrong_is_named() -> None:
    """72 single blunders, of one point along one axis."""
    structure, true = known_structure(), similarity(2)
    good = marked(structure, true, [0, 50, 100, 150, 200, 250])
    named = 0
    for row, axis, metres in blunders():
        step = metres * true.scale * np.eye(3)[axis]
        moved = replace(good.points[row], place_m=good.points[row].place_m + step)
        points = (*good.points[:row], moved, *good.points[row + 1 :])
        found = control_georeference(structure, replace(good, points=points))
        told = found.why.count("is left out") == 1 and f"{moved.name} is left out" in found.why
        named += found.accepted and told
    assert 66 <= named <= 72


def test_two_wrong_points_of_four_are_refused() -> None:
    structure, true = known_structure(), similarity(2)
    good = marked(structure, true, [0, 50, 100, 150])
    shifts = (np.array([1.0, 0.0, 0.0]), np.array([0.0, 2.0, 1.0]))
    moved = [
        replace(point, place_m=point.place_m + true.scale * shift)
        for point, shift in zip(good.points, shifts, strict=False)
    ]
    bad = replace(good, points=(*moved, *good.points[2:]))
    found = control_georeference(structure, bad)
    assert not found.accepted
    assert "contradict each other" in found.why


def test_one_mark_elsewhere_is_left_out() -> None:
    structure, true = known_structure(), similarity(2)
    good = marked(structure, true, [0, 50, 100, 150])
    first = good.points[0]
    (name, (x, y)), *others = first.seen
    wrong = replace(first, seen=((name, (x + 90.0, y)), *others))
    found = control_georeference(structure, replace(good, points=(wrong, *good.points[1:])))
    assert found.accepted, found.why
    assert f"{first.name} is marked elsewhere in {name}" in found.notes[0]


def test_exchanged_axes_are_recognised() -> None:
    structure, true = known_structure(), similarity(2)
    good = marked(structure, true, [0, 50, 100, 150, 200])
    swapped = tuple(replace(one, place_m=one.place_m[[1, 0, 2]]) for one in good.points)
    control = replace(good, points=swapped, exchanged=good)
    found, note = settled_axes(structure, control)
    assert found is good
    assert "exchanged" in note
    assert settled_axes(structure, replace(good, exchanged=control)) == (
        replace(good, exchanged=control),
        "",
    )


def points(pixel: tuple[float, float]) -> ControlPoints:
    place = np.array([500_000.0, 5_500_000.0, 0.0])
    seen = (("a.jpg", pixel), ("b.jpg", (5.0, 5.0)), ("c.jpg", (6.0, 6.0)))
    found = tuple(ControlPoint(f"p{n}", place + n, seen) for n in range(3))
    return ControlPoints(Path("gcp.txt"), "EPSG:32632", found)


def test_marks_outside_of_their_photos() -> None:
    sizes = dict.fromkeys(("a.jpg", "b.jpg", "c.jpg"), (900, 600))
    kept, told = marks_within(points((-5.0, 3.0)), sizes)
    assert [len(point.seen) for point in kept.points] == [2, 2, 2]
    assert "p0: the mark at -5, 3 lies outside of a.jpg (900 x 600 px)" in told[0]
    assert marks_within(points((900.0, 600.0)), sizes)[1] == []
    with pytest.raises(InputError, match=r"3 of its 6 marks outside.*900 x 600.*2700, 1800"):
        marks_within(points((2700.0, 1800.0)), {"a.jpg": (900, 600), "b.jpg": (900, 600)})


def test_a_rough_place_says_how_rough() -> None:
    similar = similarity(1)
    left = (Residual("a", 30.0), Residual("b", 40.0))
    sd = np.full(3, 3.0)
    fit = Fit(similar, 0.1, np.zeros(3), sd, 35.0, 1.0, left)
    refused = Georeference("gps", False, "GPS contradicts the photos", "EPSG:1", (0, 0, 0), fit)
    model = replace(refused, method="model", best=replace(fit, score=5.0))
    nothing = replace(refused, method="gcp", best=None)
    found = roughly([nothing, model, refused])
    assert [one.accepted for one in found] == [False, False, True]
    assert found[2].best is not None
    assert np.allclose(found[2].best.shift_sd_m, np.sqrt((30.0**2 + 40.0**2) / 2.0))
    assert "known to 35.4 m" in found[2].notes[0]
    assert roughly([nothing]) == [nothing]
