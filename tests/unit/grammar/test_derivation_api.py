"""`veduta.grammar` for programs: the tree of shapes, its prior, and one shape derived anew."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from veduta import _core, grammar
from veduta.grammar import Edit, Shape
from veduta.run.errors import InputError

RULES = """
attr tall = 25% : 3 else : 6
Lot --> report("tall", tall) extrude(tall) comp(f) { front : Front(2) | all : Wall. }
Front(w) --> split(x) { { ~w : Bay(split.index) }* }
Bay(i) --> 40% : set(material.name, "window") color("#0000ff") Window. 10% : NIL else : Plain
Plain --> print(tall) split(y) { ~1 : 50% : A. else : B. }
"""
LOT = [[(0, 0), (10, 0), (10, 6), (0, 6)]]


@pytest.fixture(scope="module")
def rules(tmp_path_factory: pytest.TempPathFactory) -> grammar.Rules:
    path = tmp_path_factory.mktemp("rules") / "house.cga"
    path.write_text(RULES)
    return grammar.parse(path)


def seen(derivation: grammar.Derivation) -> list[object]:
    """All that can be asked of a tree."""
    return [
        derivation.log_prior,
        derivation.messages,
        derivation.reports,
        derivation.attributes,
        [
            (s.path, s.name, s.is_leaf, s.parameters, s.choices, s.size_m, s.origin_m, s.colour)
            for s in derivation.shapes()
        ],
    ]


def test_the_tree_is_that_of_the_rules(rules: grammar.Rules) -> None:
    assert (rules.starts, rules.attributes) == (["Lot", "Plain"], {"tall": "number"})
    house = grammar.derive(rules, LOT, seed=3)
    root = house.root
    assert (root.name, root.path, root.parent, root.is_leaf) == ("Lot", (), None, False)
    assert root.size_m == pytest.approx((10, 0, 6))
    assert [child.name for child in root.children] == ["Front"] + ["Wall"] * 5
    front = root.children[0]
    assert front.parameters == {"w": 2.0}
    assert front.size_m == pytest.approx((10, house.attributes["tall"], 0))
    bays = front.children
    assert [bay.parameters["i"] for bay in bays] == [0, 1, 2, 3, 4]
    assert all(bay.parent == front and bay.path == (0, k) for k, bay in enumerate(bays))
    assert house.shape((0, 3)) == bays[3]
    assert house.shape((0, 9)) is None
    assert len(house) == len(list(house.shapes()))
    paths = [shape.path for shape in house.shapes()]
    assert paths == sorted(paths)
    assert house.reports == [("tall", house.attributes["tall"])]


def test_the_prior_is_the_product_of_all_chances(rules: grammar.Rules) -> None:
    for seed in range(20):
        house = grammar.derive(rules, LOT, seed=seed)
        chance = 0.25 if house.attributes["tall"] == 3 else 0.75
        for shape in house.shapes():
            if shape.name == "Bay" and not shape.is_leaf:
                made = [child.name for child in shape.children]
                chance *= {"Window": 0.4, "Plain": 0.5}[made[0]] if made else 0.1
            chance *= 0.5 if shape.name in ("A", "B") else 1.0
        assert grammar.log_prior(house) == pytest.approx(math.log(chance))


def test_polygons_are_those_of_the_columns(rules: grammar.Rules) -> None:
    house = grammar.derive(rules, LOT, seed=1)
    own = np.concatenate([leaf.polygons().corners_m for leaf in house.leaves()])
    columns = house.columns()
    key = lambda points: sorted(map(tuple, np.round(points, 6).tolist()))  # noqa: E731
    assert key(own) == key(columns.positions_m)
    wall = next(shape for shape in house.shapes() if shape.name == "Wall")
    found = wall.polygons()
    assert found.ring_offsets.tolist() == [0, 4]
    assert found.polygon_offsets.tolist() == [0, 1]


@settings(max_examples=30, deadline=None)
@given(
    seed=st.integers(0, 2**53),
    picks=st.lists(st.tuples(st.integers(0, 10_000), st.integers(0, 4)), min_size=1, max_size=4),
)
def test_one_shape_derived_anew_is_a_full_derivation(
    rules: grammar.Rules, seed: int, picks: list[tuple[int, int]]
) -> None:
    house = grammar.derive(rules, LOT, seed=seed)
    for pick, kind in picks:
        shapes = [s for s in house.shapes() if s.path]
        if not shapes:
            return
        shape = shapes[pick % len(shapes)]
        path = shape.path
        try:
            if kind == 0:
                assert grammar.rederive(shape, delete=True) is None
            elif kind == 1:
                grammar.rederive(shape, choices=[pick % 3])
            elif kind == 2:
                grammar.rederive(shape, values={"w": 1.0 + pick % 5})
            elif kind == 3:
                grammar.rederive(shape, values={"tall": 1.0 + pick % 5})
            else:
                grammar.rederive(shape)
        except InputError:
            assert house.shape(path) is not None
        stale = any(fault for _, fault in house.edit_faults)
        whole = grammar.derive(rules, LOT, seed=seed, edits=house.edits)
        assert seen(house) == seen(whole)
        assert stale == bool(whole.edit_faults)


def test_an_edit_can_be_taken_back(rules: grammar.Rules) -> None:
    house = grammar.derive(rules, LOT, seed=5)
    before = seen(house)
    bay = house.root.children[0].children[2]
    assert grammar.rederive(bay, choices=[0]) is not None
    window = house.shape((0, 2))
    assert isinstance(window, Shape)
    assert [child.name for child in window.children] == ["Window"]
    assert window.children[0].surface_class == "window"
    assert window.children[0].colour == (0.0, 0.0, 1.0)
    assert grammar.rederive(window, delete=True) is None
    assert house.shape((0, 2)) is None
    assert [edit.delete for edit in house.edits] == [True]
    assert house.rederive((0, 2)) is not None
    assert (seen(house), house.edits) == (before, ())


def test_shapes_of_an_edited_tree_are_stale(rules: grammar.Rules) -> None:
    house = grammar.derive(rules, LOT, seed=5)
    old = house.root.children[0]
    house.rederive((0,))
    with pytest.raises(grammar.StaleShapeError):
        _ = old.name


def test_what_cannot_be_done_leaves_the_tree(rules: grammar.Rules) -> None:
    house = grammar.derive(rules, LOT, seed=5)
    before = seen(house)
    with pytest.raises(InputError, match="no such shape"):
        house.rederive((0, 99), Edit((0, 99), delete=True))
    with pytest.raises(InputError, match="neither a parameter"):
        grammar.rederive(house.root, values={"wide": 3.0})
    with pytest.raises(InputError, match="is no `Door` any more"):
        house.rederive((0,), Edit((0,), "Door", delete=True))
    assert (seen(house), house.edits) == (before, ())


def test_bad_use_is_told(rules: grammar.Rules) -> None:
    with pytest.raises(InputError, match="encloses nothing"):
        grammar.derive(rules, [[(0, 0), (1, 0), (2, 0)]])
    with pytest.raises(InputError, match="two or three finite numbers"):
        grammar.derive(rules, [[(0, 0), (1, float("nan")), (2, 0)]])
    with pytest.raises(InputError, match="tal: is no attribute of house"):
        grammar.derive(rules, LOT, attributes={"tal": 4})
    with pytest.raises(InputError, match="there is no rule"):
        grammar.derive(rules, LOT, start="Roof")
    with pytest.raises(InputError, match="neither a file nor a style"):
        grammar.parse("nothing")


def test_styles_of_a_file(tmp_path: Path) -> None:
    path = tmp_path / "styled.cga"
    path.write_text("Lot --> Plain.\nstyle Rich\nLot --> Gold.\n")
    named = {style: grammar.parse(path, style=style) for style in (None, "Rich")}
    made = {
        style: grammar.derive(rules, LOT).root.children[0].name for style, rules in named.items()
    }
    assert made == {None: "Plain", "Rich": "Gold"}
    with pytest.raises(InputError, match="Did you mean `Rich`"):
        grammar.parse(path, style="Rch")


def test_what_is_printed_says_what_it_is(rules: grammar.Rules) -> None:
    house = grammar.derive(rules, LOT, seed=3)
    shapes = len(list(house.shapes()))
    columns = house.columns()
    surfaces, polygons = len(columns.feature_name), len(columns.polygon_feature)
    (wall,) = (shape for shape in house.shapes() if shape.path == (1,))
    found = [
        (rules, 'Rules("house.cga", starts=2, attributes=1)'),
        (rules.core, f'GrammarRules("{rules.path}", rules=4, attributes=1)'),
        (house, f'Derivation("house.cga", shapes={shapes})'),
        (house._core, f'Derivation("{rules.path}", shapes={shapes})'),
        (wall.polygons(), "Polygons(polygons=1, corners=4)"),
        (columns, f"DerivedLot(surfaces={surfaces}, polygons={polygons}, assets=0)"),
    ]
    assert [repr(one) for one, _ in found] == [told for _, told in found]


def test_what_lots_became_says_how_many(rules: grammar.Rules) -> None:
    square = [[(0.0, 0.0, 0.0), (5.0, 0.0, 0.0), (5.0, 5.0, 0.0)]]
    empty = [[(0.0, 0.0, 0.0)]]
    given = ([square, empty, square], [1, 2, 3])
    more = {"attributes": [{}] * 3, "edits": [[]] * 3}
    lots = _core.derive_lots(rules.core, *given, **more)
    assert repr(lots) == "DerivedLots(lots=3, failed=1)"
    around = _core.derive_surroundings(rules.core, *given, **more)
    assert repr(around) == "Surroundings(lots=3, failed=1)"
    tile = lots.tile([0, 2], [(0.0, 0.0, 0.0)] * 2, ["wall"], ["invented"])
    surfaces = sum(sum(counts) for counts in tile.counts)
    told = f"TileBuffers(lots=2, surfaces={surfaces}, triangles={tile.triangles})"
    assert repr(tile) == told
    limits = _core.GrammarLimits(depth=1, shapes=2, faces=3, parts=4, seconds=5.5, work=6, memory=7)
    told = "depth=1, shapes=2, faces=3, parts=4, seconds=5.5, work=6, memory=7"
    assert repr(limits) == f"GrammarLimits({told})"
    wanting = _core.GrammarRules([("a.cga", 'Lot --> i("no-such-asset")')])
    (missing,) = wanting.derive([square], [0])
    assert repr(missing) == 'MissingAsset("no-such-asset")'
