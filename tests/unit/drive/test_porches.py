"""Porches stay: they are told from cars, trees and balconies, and named."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.drive.build.beside import column_spacing, points_beside
from veduta.drive.build.facade_planes import facade_planes
from veduta.drive.build.segment import Geometry, frame_of, reconstruct, texture
from veduta.drive.options import DriveOptions, MeshOptions
from veduta.drive.read.own import read_own
from veduta.drive.read.segments import cut_segments, driven_line
from veduta.synthetic.drives import (
    Street,
    StreetOptions,
    TruckOptions,
    build_street,
    scan_street,
    write_drive,
)

LENGTH_M = 50.0


def built(porches: float, seed: int, folder: Path, trees: float = 0.5) -> tuple[Street, Geometry]:
    street = build_street(StreetOptions(length_m=LENGTH_M, porches=porches, trees=trees), seed)
    write_drive(scan_street(street, TruckOptions(), seed), folder)
    record = read_own(folder)
    options = DriveOptions()
    spacing = column_spacing(record, options)
    segments = cut_segments(driven_line(record.path(), spacing, 0.0), spacing)
    segment = next(one for one in segments if one.side == "left" and one.fate == "build")
    frame = frame_of(segment, options, record.height_m)
    return street, reconstruct(segment, frame, points_beside(record, segment, options), options)


def roofs(street: Street) -> NDArray[np.float64]:
    """(k, 2, 3) the boxes of the porches' roofs that the truck passes."""
    height = street.walls[:, 1, 2] - street.walls[:, 0, 2]
    found = street.walls[np.isclose(height, 0.25)]
    return found[(found[:, 0, 1] > 2.0) & (found[:, 1, 1] < LENGTH_M - 2.0)]


@pytest.mark.parametrize("seed", [11, 12, 13])
def test_porches_are_kept_before_their_walls(seed: int, tmp_path: Path) -> None:
    street, geometry = built(1.0, seed, tmp_path, trees=0.0)
    depths, frame = geometry.layers.depths, geometry.frame
    places = frame.origins[:, 1]
    for low, high in roofs(street):
        inside = (places > low[1] + 0.3) & (places < high[1] - 0.3)
        assert depths.porch[inside].mean() > 0.9
        front = frame.origins[inside, 0] - depths.main[inside]
        assert abs(np.median(front) - high[0]) < 0.15
        # The wall above its roof is there, too, where it is: not in the porch's plane.
        above = frame.vertices(geometry.background.depth)[:, inside]
        upper = above[(above[..., 2] > 4.2) & geometry.background.wall[:, inside]]
        assert len(upper) > 0
        assert (upper[:, 0] < high[0] - 1.0).mean() > 0.9


@pytest.mark.parametrize("seed", [11, 14])
def test_cars_trees_and_balconies_are_none(seed: int, tmp_path: Path) -> None:
    _, geometry = built(0.0, seed, tmp_path)
    assert not geometry.layers.depths.porch.any()


def test_planes_beside_a_porch_name_it(tmp_path: Path) -> None:
    _, geometry = built(1.0, 11, tmp_path)
    done = texture(geometry, [], DriveOptions(mesh=MeshOptions(error_m=0.0)))
    assert any("porch" in plane.named for plane in facade_planes(done))
