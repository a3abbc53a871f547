"""Absolute orientation, control points and GPS against truth, finite differences and scipy."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from known_structure import known_structure
from numpy.typing import NDArray
from pyproj import Geod
from scipy.spatial.transform import Rotation

from veduta.imaging.shot import Position
from veduta.photos.intake.read import PhotoRecord
from veduta.photos.structure import Structure, errors_px
from veduta.photos.world.absolute_orientation import absolute_orientation, similarity_jacobian
from veduta.photos.world.control_file import ControlPoint, ControlPoints, read_control
from veduta.photos.world.control_fit import control_georeference
from veduta.photos.world.control_marks import unknown_marks
from veduta.photos.world.georeference import Similarity
from veduta.photos.world.georeferencing import in_the_world
from veduta.photos.world.gps_fit import gps_georeference
from veduta.photos.world.gps_positions import GpsPositions, gps_positions
from veduta.run.errors import InputError


def similarity(seed: int, *, level: bool = False) -> Similarity:
    rng = np.random.default_rng(seed)
    turn = Rotation.random(random_state=seed)
    if level:
        turn = Rotation.from_euler("z", rng.uniform(0.0, 6.0))
    return Similarity(float(rng.uniform(0.2, 5.0)), turn.as_matrix(), 50.0 * rng.random(3))


@pytest.mark.parametrize("seed", range(5))
def test_absolute_orientation_finds_what_was_done(seed: int) -> None:
    true, rng = similarity(seed), np.random.default_rng(seed)
    own = rng.standard_normal((6, 3))
    found = absolute_orientation(own, true.moved(own))
    assert np.isclose(found.scale, true.scale)
    assert np.allclose(found.rotation, true.rotation)
    assert np.allclose(found.shift, true.shift)


def test_absolute_orientation_is_least_squares() -> None:
    """With noise the rotation is scipy's, and no scale near by leaves less; no mirroring."""
    rng = np.random.default_rng(3)
    own = rng.standard_normal((12, 3)) * (1.0, 1.0, 0.01)
    world = similarity(3).moved(own) + 0.3 * rng.standard_normal((12, 3))
    found = absolute_orientation(own, world)
    scipys, _ = Rotation.align_vectors(world - world.mean(axis=0), own - own.mean(axis=0))
    assert np.allclose(found.rotation, scipys.as_matrix(), atol=1e-6)
    assert np.isclose(np.linalg.det(found.rotation), 1.0)

    def left(scale: float) -> float:
        shift = world.mean(axis=0) - scale * found.rotation @ own.mean(axis=0)
        return float(((Similarity(scale, found.rotation, shift).moved(own) - world) ** 2).sum())

    assert left(found.scale) <= min(left(0.999 * found.scale), left(1.001 * found.scale))


def test_the_jacobian_is_that_of_differences() -> None:
    arm, step = np.random.default_rng(0).standard_normal((4, 3)), 1e-6
    numeric = []
    for column in range(7):
        change = np.zeros(7)
        change[column] = step
        turned = Rotation.from_rotvec(change[1:4]).apply(arm) * np.exp(change[0]) + change[4:]
        numeric.append(((turned - arm) / step).ravel())
    assert np.allclose(similarity_jacobian(arm), np.array(numeric).T, atol=1e-5)


def marked(
    structure: Structure, true: Similarity, rows: list[int], noise_px: float = 0.5
) -> ControlPoints:
    """Points of a structure, marked in all of its photos."""
    rng = np.random.default_rng(1)
    points = []
    for row in rows:
        seen = []
        for photo, name in enumerate(structure.names):
            pose = structure.cam_from_world[photo]
            place = pose[:, :3] @ structure.points[row] + pose[:, 3]
            x, y = structure.camera(photo).img_from_cam(place[None])[0]
            seen.append((name, (x + noise_px * rng.normal(), y + noise_px * rng.normal())))
        world = true.moved(structure.points[row][None])[0] + (500_000.0, 5_500_000.0, 100.0)
        points.append(ControlPoint(f"p{row}", world, tuple(seen)))
    return ControlPoints(Path("gcp.txt"), "EPSG:25832", tuple(points))


def centre_errors_m(
    structure: Structure, found: Similarity, true: Similarity, origin: NDArray[np.float64]
) -> NDArray[np.float64]:
    centres = structure.centres()
    there = found.moved(centres) + origin - (500_000.0, 5_500_000.0, 100.0)
    return np.linalg.norm(there - true.moved(centres), axis=1)


def test_control_points_lay_a_structure_into_the_world() -> None:
    structure, true = known_structure(), similarity(2)
    found = control_georeference(structure, marked(structure, true, [0, 50, 100, 150, 200]))
    assert found.accepted, found.why
    assert found.best is not None
    error = centre_errors_m(structure, found.best.world_from_model, true, np.array(found.origin_m))
    assert error.max() < 5.0 * np.linalg.norm(found.best.shift_sd_m)
    assert error.max() < 0.02 * true.scale
    # What is seen stays where it is seen.
    moved = in_the_world(structure, found)
    assert np.allclose(errors_px(moved), errors_px(structure), atol=1e-6)
    assert np.allclose(
        moved.centres(), found.best.world_from_model.moved(structure.centres()), atol=1e-6
    )


def test_control_points_that_cannot_do_are_refused() -> None:
    structure, true = known_structure(), similarity(2)
    control = marked(structure, true, [0, 50, 100, 150])
    few = ControlPoints(control.path, control.crs, control.points[:2])
    assert "of 3 that it takes" in control_georeference(structure, few).why
    line = [
        ControlPoint(str(n), control.points[0].place_m + n * np.array([1.0, 2.0, 0.0]), p.seen)
        for n, p in enumerate(control.points)
    ]
    on_line = control_georeference(structure, ControlPoints(control.path, control.crs, tuple(line)))
    assert "on a line" in on_line.why
    wrong = control.points[0]
    moved = ControlPoint(wrong.name, wrong.place_m + true.scale, wrong.seen)
    bad = ControlPoints(control.path, control.crs, (moved, *control.points[1:]))
    named = control_georeference(structure, bad)
    assert named.accepted
    assert "p0 is left out" in named.why
    assert "p0 is left out" in named.notes[0]
    refused = control_georeference(structure, replace(bad, points=bad.points[:3]))
    assert not refused.accepted
    assert "contradict each other" in refused.why


def test_the_control_file(tmp_path: Path) -> None:
    path = tmp_path / "gcp.txt"
    path.write_text(
        "WGS84 UTM 32N\n# a remark\n500000 5500000 10 100 200 a.jpg\n"
        "500000 5500000 10 110 190 b.jpg\n"
        "500010 5500000 11 5 6 a.jpg corner\n"
    )
    control = read_control(path)
    assert control.crs == "EPSG:32632"
    assert [len(point.seen) for point in control.points] == [2, 1]
    assert control.points[1].name == "corner"
    assert control.points[1].seen == (("a.jpg", (5.0, 6.0)),)
    assert control.lines == {"a.jpg": (3, 5), "b.jpg": (4,)}
    assert control.notes == ()
    for text, fault in (
        ("", "is empty"),
        ("moon\n1 2 3 4 5 a.jpg\n", "names no CRS"),
        ("EPSG:25832\n1 2 3 4\n", "line 2"),
        ("EPSG:25832\n1 2 nan 4 5 a.jpg\n", "line 2"),
        ("EPSG:25832\n", "no control points"),
        ("EPSG:25832\n1 2 3 4 5 a.jpg p\n1 2 9 4 5 b.jpg p\n", "another place"),
        ("WGS84\n500000 5500000 10 1 2 a.jpg\n", "in degrees.*Write longitude, latitude"),
        ("WGS84\n48.1 102.5 10 1 2 a.jpg\n", "point 48.1 102.5 10 at"),
    ):
        path.write_text(text)
        with pytest.raises(InputError, match=fault):
            read_control(path)


def test_points_without_names_that_are_near_each_other(tmp_path: Path) -> None:
    """They are named after their places, to the millimetre."""
    path = tmp_path / "gcp.txt"
    path.write_text(
        "EPSG:25832\n500000.10 5500000.25 10 1 2 a.jpg\n500000.1 5500000.25 10.0 3 4 b.jpg\n"
        "500000.2 5500000.26 10 5 6 a.jpg\n"
    )
    assert [len(point.seen) for point in read_control(path).points] == [2, 1]


def test_control_points_in_degrees_become_metres(tmp_path: Path) -> None:
    """The distances are those on the ellipsoid, but for the scale of the grid (0.9996 and on)."""
    path = tmp_path / "gcp.txt"
    corners = [(11.500, 48.100), (11.502, 48.100), (11.502, 48.101)]
    lines = [f"{x} {y} 500 {n} 2 a.jpg p{n}" for n, (x, y) in enumerate(corners)]
    path.write_text("\n".join(["WGS84", *lines]))
    control = read_control(path)
    assert control.crs == "EPSG:32632"
    assert "converted from EPSG:4326" in control.notes[0]
    places = [point.place_m for point in control.points]
    for here, there in ((0, 1), (1, 2)):
        apart = np.linalg.norm(places[here] - places[there])
        _, _, true = Geod(ellps="WGS84").inv(*corners[here], *corners[there])
        assert apart == pytest.approx(true, rel=1e-3)
    assert [place[2] for place in places] == [500.0] * 3


def test_marks_in_photos_that_are_not_there(tmp_path: Path) -> None:
    path = tmp_path / "gcp.txt"
    lines = [
        f"{5000 + n} {n * n} 0 10 20 {name} p{n}"
        for n in range(3)
        for name in ("IMG_1.JPG", "IMG_2.JPG")
    ]
    lines += [
        "5000 0 0 9 9 img_3.jpg p0",
        "5001 1 0 9 9 img_3.jpg p1",
        "5002 4 0 1 2 garden.png p2",
    ]
    path.write_text("\n".join(["EPSG:25832", *lines]))
    control = read_control(path)
    photos = ["IMG_1.JPG", "IMG_2.JPG", "IMG_3.JPG"]
    assert unknown_marks(control, photos) == [
        "lines 8, 9: img_3.jpg is not among the photos, where IMG_3.JPG is",
        "line 10: garden.png is not among the photos",
    ]
    with pytest.raises(InputError, match=r"marks 0 of its 3 points.*lines 3, 5, 7: IMG_2.JPG is"):
        unknown_marks(control, ["IMG_1.JPG", "IMG_9.JPG"])
    two = replace(control, points=control.points[:2])
    with pytest.raises(InputError, match="marks 2 of its 2 points in two photos"):
        unknown_marks(two, photos)


def gps(structure: Structure, true: Similarity, error_m: float, wild: int = 0) -> GpsPositions:
    rng = np.random.default_rng(4)
    there = true.moved(structure.centres())
    told = there + error_m * rng.standard_normal(there.shape)
    told[:wild, :2] += 300.0
    rows = np.arange(len(there))
    return GpsPositions("EPSG:25832", (0.0, 0.0, 0.0), rows, told[:, :2], told[:, 2])


def test_gps_lays_a_structure_into_the_world() -> None:
    structure = known_structure(photos=20)
    true = Similarity(8.0, similarity(5, level=True).rotation, np.array([30.0, 40.0, 5.0]))
    found, prior = gps_georeference(structure, gps(structure, true, 2.0, wild=3), 0)
    assert found.accepted, found.why
    assert found.best is not None
    assert prior is not None
    best = found.best
    assert abs(best.world_from_model.scale / true.scale - 1.0) < 4.0 * best.scale_sd
    assert best.scale_sd < 0.03
    apart = best.world_from_model.moved(structure.centres()) - true.moved(structure.centres())
    assert np.abs(apart.mean(axis=0)[:2]).max() < 2.0
    assert sum(one.distance_m > 200.0 for one in best.residuals) == 3


def test_gps_that_says_nothing_is_refused() -> None:
    structure = known_structure(photos=20)
    small = Similarity(0.2, np.eye(3), np.zeros(3))
    found, _ = gps_georeference(structure, gps(structure, small, 5.0), 0)
    assert not found.accepted
    assert "too near to each other" in found.why
    large = Similarity(20.0, np.eye(3), np.zeros(3))
    positions = gps(structure, large, 1.0)
    rng = np.random.default_rng(0)
    mixed = GpsPositions(
        positions.crs,
        positions.origin_m,
        positions.rows,
        rng.permutation(positions.east_north),
        positions.height,
    )
    assert not gps_georeference(structure, mixed, 0)[0].accepted
    one = GpsPositions(
        positions.crs, positions.origin_m, positions.rows,
        np.zeros_like(positions.east_north), positions.height,
    )  # fmt: skip
    assert "one and the same" in gps_georeference(structure, one, 0)[0].why


def test_positions_where_no_projection_reaches_are_left_out() -> None:
    structure = known_structure(photos=4)
    places = {name: Position(48.0, 11.0, 500.0) for name in structure.names}
    places[structure.names[1]] = Position(0.0, 102.0, None)  # a quarter of the Earth away
    photos = [
        PhotoRecord(
            image_id=row, name=name, path=Path(name), sha256="", width_px=1, height_px=1,
            focal_px=None, camera=None, time=None, position=position, group=1, notes=(),
        )
        for row, (name, position) in enumerate(places.items(), 1)
    ]  # fmt: skip
    found = gps_positions(structure, photos, "EPSG:25832", (600_000.0, 5_300_000.0, 0.0))
    assert found is not None
    assert found.rows.tolist() == [0, 2, 3]
    assert np.isfinite(found.east_north).all()
    assert gps_positions(structure, photos[1:2], "EPSG:25832", (0.0, 0.0, 0.0)) is None
