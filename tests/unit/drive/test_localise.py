"""A yard with four walls as surface model and as scans: the drive must find itself in the right
one.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest
import rasterio
from numpy.typing import NDArray
from rasterio.transform import from_origin

from veduta.drive.read.localise import LocaliseParameters, _must_be_here, localise
from veduta.drive.read.rivals import Margin
from veduta.drive.read.scan_chain import ScanChain, chain_scans
from veduta.drive.read.surface_model import SurfaceModel, read_surface_model
from veduta.run.errors import InputError, NotFoundError
from veduta.synthetic.drives.level_scan import LevelScanner, scan_level

Floats = NDArray[np.float64]
HOUSES = [
    (10.5, 10.5, 40.5, 22.5), (48.5, 8.5, 70.5, 24.5), (12.5, 40.5, 34.5, 56.5),
    (42.5, 38.5, 72.5, 52.5), (80.5, 10.5, 90.5, 55.5),
]  # fmt: skip
LOW = (1000.0, 2000.0)
FEW = LocaliseParameters(particles=2000, first_draws=40_000)


def _surface(
    path: Path, houses: Sequence[tuple[float, float, float, float]], cell_m: float = 1.0
) -> Path:
    size = int(100 / cell_m)
    cells = np.full((size, size), 5.0, dtype=np.float32)
    for x0, y0, x1, y1 in houses:
        part = cells[
            int(y0 / cell_m) : int(y1 / cell_m) + 1, int(x0 / cell_m) : int(x1 / cell_m) + 1
        ]
        part[:] = 15.0
    place = from_origin(LOW[0], LOW[1] + size * cell_m, cell_m, cell_m)
    with rasterio.open(
        path, "w", driver="GTiff", width=size, height=size, count=1, dtype="float32",
        crs="EPSG:28992", transform=place,
    ) as file:  # fmt: skip
        file.write(cells[::-1], 1)
    return path


def _walls(houses: Sequence[tuple[float, float, float, float]]) -> Floats:
    found = []
    for x0, y0, x1, y1 in houses:
        corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
        found += [[corners[k], corners[(k + 1) % 4]] for k in range(4)]
    return np.array(found, dtype=float)


@pytest.fixture(scope="module")
def driven() -> tuple[Floats, ScanChain]:
    """True poses along the street between the houses and around a corner; the matched chain."""
    x = np.arange(5.0, 75.0, 0.5)
    line = np.stack([x, 31.0 + 2.0 * np.sin(x / 15.0)], axis=1)
    step = np.gradient(line, axis=0)
    truth = np.column_stack([line, np.arctan2(step[:, 1], step[:, 0])])
    scanner = LevelScanner(beams=360, first_deg=-180.0)
    random = np.random.default_rng(2)
    trunks = np.array([[30.0, 28.0, 0.2], [55.0, 35.0, 0.2]])
    ranges = scan_level(_walls(HOUSES), trunks, truth, scanner, random).astype(float)
    angles = scanner.angles_rad()
    beams = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    return truth, chain_scans((beams * row[:, None])[row > 0.0] for row in ranges)


@pytest.fixture(scope="module")
def model(tmp_path_factory: pytest.TempPathFactory) -> SurfaceModel:
    return read_surface_model(_surface(tmp_path_factory.mktemp("model") / "a.tif", HOUSES), 3.6)


def test_chain_follows_the_drive(driven: tuple[Floats, ScanChain]) -> None:
    truth, chain = driven
    assert not chain.lost
    from_start = chain.all_poses(chain.poses)
    length = np.linalg.norm(from_start[-1, :2])
    assert length == pytest.approx(np.linalg.norm(truth[-1, :2] - truth[0, :2]), abs=0.4)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_drive_is_found_from_a_start_that_is_off(
    driven: tuple[Floats, ScanChain], model: SurfaceModel, seed: int
) -> None:
    truth, chain = driven
    random = np.random.default_rng(seed)
    away = random.uniform(0, 2 * np.pi)
    start = (
        LOW[0] + truth[0, 0] + 15 * np.cos(away), LOW[1] + truth[0, 1] + 15 * np.sin(away),
        truth[0, 2] + np.deg2rad(15),
    )  # fmt: skip
    found = localise(chain, model, start, (20.0, 20.0, 0.4), seed, parameters=FEW)
    poses = chain.all_poses(found.poses) - [*LOW, 0.0]
    off = np.linalg.norm(poses[:, :2] - truth[:, :2], axis=1)
    assert off.max() < 1.0
    assert off.mean() < 0.5
    assert found.share[found.sure].mean() > 0.6


def test_model_of_another_place_is_refused(
    driven: tuple[Floats, ScanChain], tmp_path: Path
) -> None:
    truth, chain = driven
    houses = [(8, 60, 30, 90), (50, 15, 95, 25), (20, 5, 30, 45), (60, 60, 80, 95)]
    other = read_surface_model(_surface(tmp_path / "b.tif", houses), 3.6)
    start = (LOW[0] + truth[0, 0], LOW[1] + truth[0, 1], float(truth[0, 2]))
    with pytest.raises(NotFoundError, match="surface model"):
        localise(chain, other, start, (20.0, 20.0, 0.4), 1, parameters=FEW)


@pytest.mark.parametrize(("east_m", "north_m"), [(35.0, -25.0), (40.0, 30.0), (-4.0, 45.0)])
def test_a_start_that_is_wrong_is_refused_or_doubted(
    driven: tuple[Floats, ScanChain], model: SurfaceModel, east_m: float, north_m: float
) -> None:
    """The drive began elsewhere than within the reach of what was said."""
    truth, chain = driven
    start = (LOW[0] + truth[0, 0] + east_m, LOW[1] + truth[0, 1] + north_m, float(truth[0, 2]))
    found = None
    with suppress(NotFoundError):
        found = localise(chain, model, start, (6.0, 6.0, 0.2), 1, parameters=FEW)
    # What `find_path` tells a doubt from: too few points on edges, or a better place around.
    assert found is None or found.share[found.sure].mean() < 0.8 or found.margin.share < 0.1


def test_model_without_buildings_is_refused(
    driven: tuple[Floats, ScanChain], tmp_path: Path
) -> None:
    _, chain = driven
    empty = read_surface_model(_surface(tmp_path / "c.tif", []), 3.6)
    with pytest.raises(NotFoundError, match="surface model"):
        localise(chain, empty, (1010.0, 2030.0, 0.0), (5.0, 5.0, 0.1), 1, parameters=FEW)


def test_edges_lie_on_walls_and_ground_below_houses(model: SurfaceModel) -> None:
    def at(x: float, y: float) -> float:
        row, column = int(y / model.cell_m), int(x / model.cell_m)
        return float(model.distance_m[row, column])

    assert at(25.0, 22.4) < 0.3
    assert abs(at(25.0, 22.6)) < 0.3
    assert at(25.0, 27.5) == pytest.approx(5.0, abs=0.6)
    places = np.array([[1025.0, 2016.0], [1025.0, 2031.0], [900.0, 2000.0]])
    told = model.ground_under(places)
    np.testing.assert_allclose(told[:2], 5.0, atol=2.1)
    assert told[1] == pytest.approx(5.0, abs=0.01)
    assert np.isnan(told[2])


def test_faulty_models_are_refused(tmp_path: Path) -> None:
    text = tmp_path / "text.tif"
    text.write_text("no picture")
    with pytest.raises(InputError, match=r"no GeoTIFF.*Copy"):
        read_surface_model(text, 3.6)
    with pytest.raises(InputError, match="no such file"):
        read_surface_model(tmp_path / "none.tif", 3.6)
    turned = tmp_path / "turned.tif"
    with rasterio.open(
        turned, "w", driver="GTiff", width=4, height=4, count=1, dtype="float32",
        transform=rasterio.Affine(1.0, 0.3, 0.0, 0.3, -1.0, 0.0),
    ) as file:  # fmt: skip
        file.write(np.zeros((4, 4), np.float32), 1)
    with pytest.raises(InputError, match=r"along north.*gdalwarp"):
        read_surface_model(turned, 3.6)
    degrees = tmp_path / "degrees.tif"
    with rasterio.open(
        degrees, "w", driver="GTiff", width=4, height=4, count=1, dtype="float32",
        crs="EPSG:4326", transform=from_origin(4.0, 52.0, 1e-5, 1e-5),
    ) as file:  # fmt: skip
        file.write(np.zeros((4, 4), np.float32), 1)
    with pytest.raises(InputError, match=r"degrees.*metres"):
        read_surface_model(degrees, 3.6)
    empty = tmp_path / "empty.tif"
    with rasterio.open(
        empty, "w", driver="GTiff", width=4, height=4, count=1, dtype="float32", nodata=0.0,
        transform=from_origin(0.0, 4.0, 1.0, 1.0),
    ) as file:  # fmt: skip
        file.write(np.zeros((4, 4), np.float32), 1)
    with pytest.raises(InputError, match="no heights"):
        read_surface_model(empty, 3.6)


@pytest.mark.parametrize(
    ("own", "rival", "sharp", "why"),
    [
        (0.5, 0.49, 0.6, "fits it as well 5 m away"),
        (-0.1, 0.2, 0.6, "fits it as well 5 m away"),
        (0.5, 0.2, 0.35, "35 % of the points near its edges lie on them"),
        (0.5, 0.47, 0.41, "nearly as well 5 m away, and 41 % .* less than 68 %"),
        (0.5, 0.47, 0.72, None),
        (0.5, 0.35, 0.45, None),
    ],
)
def test_a_place_that_is_no_better_than_others_is_refused(
    own: float, rival: float, sharp: float, why: str | None
) -> None:
    margin = Margin(own, rival, (3.0, -4.0))
    if why is None:
        _must_be_here(margin, sharp, LocaliseParameters())
        return
    with pytest.raises(NotFoundError, match=why):
        _must_be_here(margin, sharp, LocaliseParameters())
