"""The built-in assets, and the tools they are made with, against closed forms."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
import trimesh

from veduta.grammar.assets.asset import CREASE_RAD, Asset, Slot, corner_normals
from veduta.grammar.assets.catalogue import LEVELS, builtin, builtin_names, described, parts_of
from veduta.grammar.assets.library import Library
from veduta.grammar.assets.modelling import Model, arc, rectangle
from veduta.run.errors import InputError


def model() -> Model:
    return Model(Slot("stone"))


def closed(asset: Asset) -> trimesh.Trimesh:
    """The asset's triangles with points that coincide joined."""
    indices, _, _ = asset.triangles
    return trimesh.Trimesh(
        asset.points_m[asset.corners[indices]].reshape(-1, 3),
        np.arange(3 * len(indices)).reshape(-1, 3),
        process=True,
    )


def volume(made: Model) -> float:
    mesh = closed(made.asset("piece"))
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    return float(mesh.volume)


def test_a_box_looks_outwards() -> None:
    made = model()
    made.box((1.0, 2.0, 3.0), (2.0, 4.0, 6.0), "stone")
    assert volume(made) == pytest.approx(6.0)


@pytest.mark.parametrize("axis", ["x", "y", "z"])
def test_a_prism_has_its_area_times_its_length(axis: str) -> None:
    made = model()
    made.prism([(0.0, 0.0), (2.0, 0.0), (0.0, 1.0)], (1.0, 4.0), "stone", axis=axis)
    assert volume(made) == pytest.approx(3.0)


def test_a_lathe_is_a_stack_of_frusta() -> None:
    made = model()
    made.lathe([(2.0, 0.0), (1.0, 3.0)], (5.0, 1.0), "stone", sides=12)
    # A regular polygon's area: n / 2 r^2 sin(2 pi / n). A frustum: h / 3 (A + B + sqrt(A B)).
    share = 12 / 2 * math.sin(2 * math.pi / 12)
    assert volume(made) == pytest.approx(3.0 / 3.0 * share * (4.0 + 1.0 + 2.0))


def test_a_frame_is_mitred() -> None:
    made = model()
    made.sweep(
        [(0.0, 0.0), (0.1, 0.0), (0.1, 0.2), (0.0, 0.2)],
        rectangle((0.0, 0.0), (1.0, 2.0)),
        "stone",
        closed=True,
    )
    # The rectangle less the one within it, 0.2 m thick.
    assert volume(made) == pytest.approx((1.0 * 2.0 - 0.8 * 1.8) * 0.2)


def test_a_bar_along_an_open_path_is_closed() -> None:
    made = model()
    made.tube(arc((0.0, 0.0), 1.0, 0.0, 180.0, 24), 0.05, "stone", sides=6)
    section = 6 / 2 * 0.05**2 * math.sin(2 * math.pi / 6)
    assert volume(made) == pytest.approx(section * math.pi, rel=0.01)


def test_normals_of_corners_are_means_over_smooth_faces() -> None:
    made = model()
    made.lathe([(1.0, 0.0), (1.0, 1.0)], (0.0, 0.0), "stone", sides=12)
    asset = made.asset("drum")
    _, _, normal = asset.triangles
    found = corner_normals(asset.corners, asset.offsets, normal)
    face = np.repeat(np.arange(len(asset.offsets) - 1), np.diff(asset.offsets))
    for corner, point in enumerate(asset.corners.tolist()):
        near = [
            normal[face[other]]
            for other in np.flatnonzero(asset.corners == point)
            if normal[face[other]] @ normal[face[corner]] >= math.cos(CREASE_RAD)
        ]
        mean = np.sum(near, axis=0)
        assert found[corner] == pytest.approx(mean / np.linalg.norm(mean))
    sides = np.abs(found[:, 1]) < 0.5
    # A drum's sides are round: the normal is that of the cylinder.
    flat = asset.points_m[asset.corners[sides]][:, [0, 2]]
    assert np.allclose(found[sides][:, [0, 2]], flat / np.linalg.norm(flat, axis=1, keepdims=True))


@pytest.mark.parametrize("name", builtin_names())
def test_each_asset_is_sound_at_each_level(name: str) -> None:
    levels = [builtin(f"{name}@{level}") for level in range(LEVELS)]
    counts = []
    for asset in levels:
        assert asset is not None
        mesh = asset.shared_mesh
        counts.append(len(mesh.indices))
        assert np.allclose(np.linalg.norm(mesh.normals, axis=1), 1.0, atol=1e-4)
        low, high = asset.box_m
        assert np.array_equal(asset.box_m, levels[0].box_m)  # type: ignore[union-attr]
        # A coarse level may leave the box by less than what is seen from afar.
        assert (asset.points_m >= low - 0.1).all()
        assert (asset.points_m <= high + 0.1).all()
        assert (high - low > 0.01).all()
    assert counts == sorted(counts, reverse=True)
    assert counts[0] < 1500
    assert counts[2] < 120
    finest = levels[0]
    assert finest is not None
    plain = builtin(name)
    assert plain is not None
    assert np.array_equal(finest.points_m, plain.points_m)
    assert set(finest.face_slot.tolist()) <= set(range(len(finest.slots)))
    assert described(name)


def test_levels_that_there_are_not() -> None:
    assert builtin("builtin/window-casement@3") is None
    assert builtin("builtin/window-casement@") is not None
    assert builtin("builtin/nothing") is None
    assert builtin("window-casement") is None


@pytest.mark.parametrize("name", [name for name in builtin_names() if "dormer" in name])
@pytest.mark.parametrize("level", range(LEVELS))
def test_the_parts_of_a_dormer_are_the_whole(name: str, level: int) -> None:
    whole = builtin(f"{name}@{level}")
    assert whole is not None
    found = []
    for part in parts_of(name):
        own = builtin(f"{name}:{part}@{level}")
        assert own is not None
        np.testing.assert_array_equal(own.box_m, whole.box_m)
        found += faces_of(own)
    assert sorted(found) == sorted(faces_of(whole))


def faces_of(asset: Asset) -> list[tuple[str, tuple[tuple[float, ...], ...]]]:
    """The slot and the corners of each face."""
    ends = zip(asset.offsets, asset.offsets[1:], strict=False)
    rings = [asset.points_m[asset.corners[a:b]].tolist() for a, b in ends]
    names = [asset.slots[slot].name for slot in asset.face_slot.tolist()]
    return [(name, tuple(map(tuple, ring))) for name, ring in zip(names, rings, strict=True)]


def test_a_part_that_is_none_is_told() -> None:
    assert builtin("builtin/dormer-arched:door@1") is None
    assert builtin("builtin/window-casement:pane") is None
    with pytest.raises(InputError, match="dormer-arched:window"):
        Library(Path())["builtin/dormer-arched:door@1"]
