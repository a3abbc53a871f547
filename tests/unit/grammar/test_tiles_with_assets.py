"""Assets in tiles and in CityJSON, against the separate model of the same lot."""

from __future__ import annotations

import json
from collections import Counter
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from veduta import _core
from veduta.formats.cityjson_text import CLASSES, KINDS
from veduta.grammar.assets.library import Library
from veduta.grammar.building import build_part
from veduta.grammar.deriving import deriver
from veduta.grammar.levels import FULL
from veduta.grammar.lot import Lot
from veduta.grammar.options import GrammarOptions
from veduta.grammar.project import SearchPath
from veduta.grammar.town import PROVENANCES
from veduta.place.part import Part

RULES = """
attr pane = "casement"
Lot --> extrude(world.up, 8) comp(f) { side : Front | top : Roof | bottom : NIL }
Front --> set(material.name, "wall") split(x) { { 2.7 : Bay }* }
Bay --> split(x) { ~1 : Wall. | 1.3 : Column | ~1 : Wall. }
Column --> split(y) { { 1 : Wall. | 1.9 : Window }* }
Window --> set(material.name, "window") color("#204060") s('1, '1, 0) i("builtin/window-" + pane)
Roof --> set(material.name, "roof") [ s('1, '1, 0) t('0.4, '0.4, 0) Stack ] Tiles.
Stack --> set(material.name, "chimney") s(0.8, 0.8, 1.4) i("builtin/chimney-stack")
"""
PLACE = (30.0, -12.0, 4.0)
Triangles = tuple[NDArray[np.int64], NDArray[np.float64]]


def lot(name: str = "house", **given: str) -> Lot:
    outline = np.array([[0.0, 0.0], [11.0, 2.0], [10.0, 9.0], [-1.0, 8.0]])
    return Lot(name, name, (outline,), (0.0, 0.0, 0.0), dict(given))


@pytest.fixture(scope="module")
def made() -> tuple[Part, _core.DerivedLots]:
    by = deriver((("rules.cga", RULES),), SearchPath.of(Path()), GrammarOptions())
    lots = by.together([lot()], FULL)
    columns = lots.columns(0)
    assert len(columns.instance_feature) > 20
    return build_part(columns, "house", by.library.assets_of(columns)), lots


def drawn(buffers: _core.TileBuffers) -> Triangles:
    """Feature and corners (m, z up) of all triangles, as glTF says that they are drawn."""
    features, corners = [], []
    low, step = np.array(buffers.grid)
    for _, positions, feature, indices, *_ in buffers.merged:
        ids = np.frombuffer(feature, "<f4").astype(np.int64)
        at = np.frombuffer(positions, "<u2").reshape(-1, 4)[:, :3] * step + low
        triangles = np.frombuffer(indices, "<u2" if len(ids) <= 65535 else "<u4").reshape(-1, 3)
        features.append(ids[triangles[:, 0]])
        corners.append(at[triangles])
    for _, positions, indices, _, _, moves, turns, feature, scales, _ in buffers.repeated:
        own = np.frombuffer(positions, "<i2").reshape(-1, 4)[:, :3].astype(float)
        triangles = np.frombuffer(indices, "<u2").reshape(-1, 3)
        ids = np.frombuffer(feature, "<u2").astype(np.int64)
        move = np.frombuffer(moves, "<f4").reshape(-1, 3)
        turn = Rotation.from_quat(np.frombuffer(turns, "<i2").reshape(-1, 4))
        scale = np.frombuffer(scales, "<f4").reshape(-1, 3) if scales else np.ones_like(move)
        for k, number in enumerate(ids.tolist()):
            at = (turn[k].apply(own * scale[k]) + move[k]) * buffers.step_m
            features.append(np.full(len(triangles), number))
            corners.append(at[triangles])
    y_up = np.concatenate(corners)
    z_up = np.stack([y_up[..., 0], -y_up[..., 2], y_up[..., 1]], axis=-1)
    return np.concatenate(features), z_up - PLACE


def area(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    crossed = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    found: NDArray[np.float64] = np.linalg.norm(crossed, axis=1) / 2
    return found


def test_a_tile_shows_what_the_model_shows(made: tuple[Part, _core.DerivedLots]) -> None:
    part, lots = made
    buffers = lots.tile([0], [PLACE], CLASSES, PROVENANCES)
    feature, corners = drawn(buffers)
    found = np.bincount(feature, area(corners), minlength=len(part.features))
    assert found == pytest.approx(part.feature_area_m2, rel=2e-2, abs=2e-3)
    low, high = part.bounds_m  # around the boxes of assets
    assert corners.min(axis=(0, 1)) == pytest.approx(low, abs=2e-2)
    assert corners.max(axis=(0, 1)) == pytest.approx(high, abs=2e-2)
    extent = lots.extent(0)
    assert extent is not None
    assert extent[0] == pytest.approx(low, abs=1e-3)
    assert extent[1] == pytest.approx(high, abs=1e-3)
    assert part.instances is not None
    assert buffers.triangles == len(part.triangles.indices) + part.instances.triangle_count


def test_windows_are_instances_and_have_the_colours_of_their_slots(
    made: tuple[Part, _core.DerivedLots],
) -> None:
    part, lots = made
    buffers = lots.tile([0], [PLACE], CLASSES, PROVENANCES)
    assert part.instances is not None
    shared = [one for one in buffers.repeated if one[8]]
    stands = max(len(group.feature) for group in part.instances.groups)
    assert max(len(one[5]) // 12 for one in shared) == stands
    colours = {
        tuple(round(255 * channel) for channel in colour)
        for code, _, colour, *_ in buffers.materials
        if CLASSES[code] == "window"
    }
    told = {
        tuple(round(255 * channel) for channel in part.materials[row].colour)
        for group in part.instances.groups
        if len(group.feature) == stands
        for row in group.materials
    }
    assert told <= colours
    assert (0x20, 0x40, 0x60) in colours  # the frame has none of its own


def test_cityjson_has_the_faces_of_assets(made: tuple[Part, _core.DerivedLots]) -> None:
    part, lots = made
    body, installations, vertices, _ = lots.city(0, PLACE, CLASSES, KINDS)
    points = np.array(json.loads(vertices)) * 0.001 - PLACE
    geometry = json.loads(body)
    kinds = [surface["type"] for surface in geometry["semantics"]["surfaces"]]
    codes = Counter(CLASSES[code] for code in part.features.class_code.tolist())
    assert Counter(kinds)["Window"] == codes["window"]
    assert [CLASSES[code] for code, *_ in installations] == ["chimney"]
    assert points.min(axis=0) == pytest.approx(part.bounds_m[0], abs=2e-2)
    assert points.max(axis=0) == pytest.approx(part.bounds_m[1], abs=2e-2)


def test_a_box_stands_for_an_asset_that_is_nowhere() -> None:
    by = deriver((("rules.cga", RULES),), SearchPath.of(Path()), GrammarOptions())
    both = [lot("good"), lot("bad", pane="porthole")]
    lots = by.together(both, FULL)
    assert [by.fault(lots, row, both[row]) for row in (0, 1)] == [None, None]
    (told,) = by.library.missing.values()
    assert "builtin/window-porthole" in told
    assert "is no asset that Veduta brings along" in told
    counts = [len(lots.columns(row).instance_feature) for row in (0, 1)]
    assert counts[0] == counts[1] > 20
    assert by.library["builtin/window-porthole"].slots[0].name == "missing"


def test_slots_must_fit_the_faces() -> None:
    rules = _core.GrammarRules([("rules.cga", RULES)])
    asset = Library(Path())["builtin/window-casement"]
    faces = (asset.points_m, asset.corners, asset.offsets, asset.box_m)
    with pytest.raises(ValueError, match="no faces of points"):
        rules.add_asset("one", *faces, asset.face_slot, [(None, (1.0, 1.0, 1.0), None)])
    with pytest.raises(ValueError, match="no faces of points"):
        rules.add_asset("one", *faces, asset.face_slot[1:], [(None, (1.0, 1.0, 1.0), None)] * 3)


DOORS = """
Lot --> extrude(world.up, 3) comp(f) { front : split(x) { { 1.5 : Door }* } | all : NIL }
Door --> set(material.name, "door") color("#304050") s(1, 2.2, 0) i("builtin/door-single@0")
"""


@pytest.mark.parametrize("front_m", [1.5, 150.0])
def test_textures_of_assets_lie_in_tiles_as_in_models(front_m: float) -> None:
    """One door is merged, a hundred share a mesh; each place has the model's coordinates."""
    by = deriver((("rules.cga", DOORS),), SearchPath.of(Path()), GrammarOptions())
    outline = np.array([[0.0, 0.0], [front_m, 0.0], [front_m, 5.0], [0.0, 5.0]])
    lots = by.together([Lot("street", "street", (outline,), (0.0, 0.0, 0.0), {})], FULL)
    name, mean = "builtin/textures/wood", (0.5, 0.5, 0.5)
    place = [(0.0, 0.0, 0.0)]
    near = lots.tile([0], place, CLASSES, PROVENANCES, [(name, mean)], mapped=True)
    (wood,) = [n for n, row in enumerate(near.materials) if row[4] == 0]
    assert near.materials[wood][2] == pytest.approx((0x30 / 255, 0x40 / 255, 0x50 / 255))
    far = lots.tile([0], place, CLASSES, PROVENANCES, [(name, mean)])
    assert not far.uv_steps
    assert (24, 32, 40) in {tuple(round(255 * c) for c in row[2]) for row in far.materials}

    mesh = Library(Path())["builtin/door-single@0"].shared_mesh
    assert mesh.uv is not None
    merged = [(one[1], one[6]) for one in near.merged if one[0] == wood]
    shared = [(one[1], one[9]) for one in near.repeated if one[0] == wood]
    assert (len(merged), len(shared)) == ((1, 0) if front_m < 2 else (0, 1))
    positions, uvs = (merged + shared)[0]
    at = np.frombuffer(positions, "<i2" if shared else "<u2").reshape(-1, 4)[:, :3].astype(float)
    at = np.stack([at[:, 0], -at[:, 2], at[:, 1]], axis=1)
    uv = np.frombuffer(uvs, "<u2").reshape(-1, 2) * near.uv_steps[wood]
    own = mesh.positions_m[mesh.indices[mesh.slot == mesh.slots.index("leaf")]].reshape(-1, 3)
    # Both fill their boxes: of the leaf alone, which is not stretched on its own.
    at, own = ((one - one.min(axis=0)) / np.ptp(one, axis=0) for one in (at, own))
    known = mesh.uv[mesh.indices[mesh.slot == mesh.slots.index("leaf")]].reshape(-1, 2)
    off = np.abs(at[:, None] - own[None]).max(axis=2) < 1e-3
    assert off.any(axis=1).all()
    turn = uv[:, None] - known[None]
    agrees = np.abs(turn - np.round(turn)).max(axis=2) < 2e-3
    assert (off & agrees).any(axis=1).all()
