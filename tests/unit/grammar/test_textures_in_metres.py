"""Built-in textures on what rules derive: in metres, at near levels, on what they belong to."""

from __future__ import annotations

import numpy as np
import pytest

from veduta import _core
from veduta.grammar.assets.asset import Asset, Slot
from veduta.grammar.assets.library import Library
from veduta.grammar.assets.modelling import Model
from veduta.grammar.building import build_part
from veduta.grammar.rules import STYLES, compile_rules, find_rules, read_rules, style_names
from veduta.grammar.surfaces.catalogue import PREFIX, sizes_m, texture_names
from veduta.grammar.textures import Textures, find_textures, texture_faults
from veduta.place.flatten import flattened
from veduta.place.part import Part
from veduta.run.errors import InputError

SQUARE = [[(0.0, 0.0, 0.0), (10.0, 0.0, 0.0), (10.0, 6.0, 0.0), (0.0, 6.0, 0.0)]]
WIDTH_M, HEIGHT_M = sizes_m()["builtin/textures/ashlar"]
CELLS = """
Lot --> extrude(world.up, 5) comp(f) { front : Front | all : NIL }
Front --> texture("builtin/textures/ashlar") split(x) { 3 : A. | ~1 : Rest }
Rest --> split(y) { 2 : B. | ~1 : C. }
"""


def derived(rules: str) -> _core.DerivedLot:
    compiled = _core.GrammarRules([("a.cga", rules)])
    Library(STYLES).add_written_to(compiled)
    (found,) = compiled.derive([SQUARE], [0])
    assert isinstance(found, _core.DerivedLot), found
    return found


def part_of(rules: str) -> Part:
    return build_part(derived(rules), "lot", textures=Textures({}))


def test_it_lies_in_metres_and_goes_on_from_cell_to_cell() -> None:
    part = part_of(CELLS)
    assert len(part.polygon_feature) == 3
    np.testing.assert_allclose(part.uv[:, 0], part.positions_m[:, 0] / WIDTH_M, atol=1e-5)
    np.testing.assert_allclose(part.uv[:, 1], 1 - part.positions_m[:, 2] / HEIGHT_M, atol=1e-5)
    (material,) = part.materials
    assert material.texture is not None
    assert material.texture.invented.all()


def test_a_projection_comes_before_that() -> None:
    rules = CELLS.replace("split(x)", "setupProjection(0, scope.xy, 2, 4) projectUV(0) split(x)", 1)
    part = part_of(rules)
    np.testing.assert_allclose(part.uv[:, 0], part.positions_m[:, 0] / 2, atol=1e-5)
    np.testing.assert_allclose(part.uv[:, 1], 1 - part.positions_m[:, 2] / 4, atol=1e-5)


def test_a_slope_is_measured_along_itself() -> None:
    rules = """
    Lot --> texture("builtin/textures/ashlar") roofHip(byAngle, 60) Faces
    Faces --> comp(f) { bottom : NIL | all : T. }
    """
    part = part_of(rules)
    offsets = part.ring_offsets
    for first, last in zip(offsets[:-1], offsets[1:], strict=True):
        points = part.positions_m[first:last].astype(np.float64)
        metres = part.uv[first:last] * [WIDTH_M, HEIGHT_M]
        # An isometry: distances on the roof are distances on the texture.
        for row in range(len(points)):
            on_roof = np.linalg.norm(points - points[row], axis=1)
            np.testing.assert_allclose(
                np.linalg.norm(metres - metres[row], axis=1), on_roof, atol=1e-4
            )


def test_a_computed_name_that_is_none_is_a_fault() -> None:
    rules = 'Lot --> texture("builtin/textures/" + "aslar")'
    compiled = _core.GrammarRules([("a.cga", rules)])
    Library(STYLES).add_written_to(compiled)
    (found,) = compiled.derive([SQUARE], [0])
    assert isinstance(found, str)
    assert found.startswith("a.cga:1:9: ")
    assert "did you mean `builtin/textures/ashlar`" in found


def test_a_written_name_that_is_none_is_told_before() -> None:
    text = 'Lot --> texture("builtin/textures/slaet")'
    with pytest.raises(InputError, match="Did you mean `builtin/textures/slate`"):
        find_textures(STYLES / "a.cga", [text])
    (told,) = texture_faults([text, 'texture("builtin/textures/zinc")'])
    assert "slaet" in told


@pytest.mark.parametrize("size", [(0.0, 1.0), (-1.0, 1.0), (float("nan"), 1.0)])
def test_a_texture_has_a_size(size: tuple[float, float]) -> None:
    with pytest.raises(ValueError, match="builtin/textures/x"):
        _core.GrammarRules([("a.cga", "Lot --> NIL")]).add_textures({"builtin/textures/x": size})


@pytest.mark.parametrize("style", style_names())
def test_styles_have_textures_at_every_level(style: str) -> None:
    rules = compile_rules(read_rules(find_rules(style)))
    Library(STYLES).add_written_to(rules)
    levels = [{"LOD": float(level)} for level in (0, 1, 1.5, 2, 3)]
    lot = [[(x * 1.3, y, z) for x, y, z in SQUARE[0]]]
    found = rules.derive([lot] * 5, [5] * 5, attributes=levels)
    for lots in found:
        assert isinstance(lots, _core.DerivedLot), lots
        used = {lots.looks[row] for row in lots.polygon_look.tolist()}
        shown = {(look[5], look[4]) for look in used if look[4]}
        assert {name for _, name in shown} <= set(texture_names())
        assert {"wall", "roof"} <= {kind for kind, _ in shown}
        bare = [
            name for kind, name in shown if kind == "window" and not str(name).endswith("stone")
        ]
        assert not bare


def cube(name: str, slot: Slot) -> Asset:
    model = Model(slot)
    model.box((0.0, 0.0, 0.0), (1.0, 1.0, 1.0), slot.name)
    return model.asset(name)


def test_an_asset_lies_in_metres_on_each_side() -> None:
    mesh = cube("cube", Slot("stone", texture="stone")).shared_mesh
    width, height = sizes_m()[PREFIX + "stone"]
    assert mesh.uv is not None
    for face in mesh.indices.reshape(-1, 2, 3):
        uv = mesh.uv[np.unique(face)]
        np.testing.assert_allclose(np.ptp(uv, axis=0), [1 / width, 1 / height], atol=1e-6)
        # Seen from outside, u to the right and v down turn as the corners do.
        a, b, c = mesh.uv[face[0]].astype(np.float64)
        assert (b - a)[0] * (c - a)[1] - (b - a)[1] * (c - a)[0] < 0
    assert cube("bare", Slot("stone")).shared_mesh.uv is None


def test_what_an_asset_is_made_of_is_seen() -> None:
    rules = 'Lot --> color("#a4553f") s(4, 2, 1) i("builtin/block")'
    columns = derived(rules)
    library = Library(STYLES)
    part = build_part(columns, "lot", library.assets_of(columns), Textures({}))
    assert part.instances is not None
    (group,) = part.instances.groups
    assert part.materials[group.materials[0]].texture is not None
    flat = flattened(part)
    assert np.ptp(flat.uv, axis=0).min() > 0.1
    bare = build_part(columns, "lot", library.assets_of(columns))
    assert all(material.texture is None for material in bare.materials)
