"""Rules and derivation tree: their sizes add up, and their leaves tile the facade."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from hypothesis import given
from hypothesis import strategies as st

from veduta.facade.derive import RULES, derivation, rule_parameters
from veduta.facade.document import DerivationNode, Element, FacadeBox, RuleParameters

METRES_PER_PX = 0.04


def _facade(left: float, eaves: float, width: float, bottom: float) -> FacadeBox:
    height = bottom - eaves
    sizes = {"width_m": width * METRES_PER_PX, "height_m": height * METRES_PER_PX}
    return FacadeBox(x_px=left, y_px=eaves, width_px=width, height_px=height, **sizes)


def _window(
    facade: FacadeBox, x: float, y: float, width: float, height: float, floor: int | None
) -> Element:
    m = METRES_PER_PX
    return Element(
        class_="window",
        x_px=x,
        y_px=y,
        width_px=width,
        height_px=height,
        x_m=(x - facade.x_px) * m,
        y_m=(facade.y_px + facade.height_px - y - height) * m,
        width_m=width * m,
        height_m=height * m,
        score=0.5,
        floor=floor,
    )


@st.composite
def facades(draw: st.DrawFn) -> tuple[RuleParameters, FacadeBox, list[Element], list[float], float]:
    """Rules of a facade with random floors and windows that do not overlap."""
    ridge, roof = draw(st.integers(0, 80)), draw(st.integers(0, 90))
    heights = draw(st.lists(st.integers(40, 120), min_size=1, max_size=6))
    rows = [float(ridge + roof)]
    for height in heights:
        rows.append(rows[-1] + height)
    gaps = draw(st.lists(st.integers(0, 40), min_size=4, max_size=4))
    widths = draw(st.lists(st.integers(5, 50), min_size=3, max_size=3))
    left = draw(st.integers(0, 60))
    facade = _facade(left, rows[0], sum(gaps) + sum(widths), rows[-1] + draw(st.integers(50, 150)))
    elements = []
    for floor in range(len(heights), 0, -1):
        x = float(left)
        for gap, width in zip(gaps[:3], widths, strict=True):
            if draw(st.booleans()):
                top = rows[len(heights) - floor] + 10
                elements.append(_window(facade, x + gap, top, width, 20, floor))
            x += gap + width
    elements.append(_window(facade, left, 0.0, 10, 10, None))  # a dormer: in no floor
    rules = rule_parameters(rows, float(ridge), facade, elements, METRES_PER_PX)
    return rules, facade, elements, rows, float(ridge)


Drawn = tuple[RuleParameters, FacadeBox, list[Element], list[float], float]


@given(facades())
def test_sizes_add_up(drawn: Drawn) -> None:
    rules, facade, _, rows, ridge = drawn
    assert sum(rules.facade.sizes_m) == pytest.approx(facade.height_m)
    assert rules.building_height_m == pytest.approx(facade.height_m)
    assert rules.roof_height_m == pytest.approx((rows[0] - ridge) * METRES_PER_PX)
    assert len(rules.floors) == len(rows) - 1
    for floor in rules.floors:
        assert sum(floor.sizes_m) == pytest.approx(facade.width_m)
        assert all(size >= 0 for size in floor.sizes_m)
    for split in (rules.facade, *rules.floors):
        assert len(split.symbols) == len(split.sizes_m) == len(set(split.symbols))


@given(facades())
def test_floors_count_from_the_ground(drawn: Drawn) -> None:
    rules, _, elements, rows, _ = drawn
    count = len(rows) - 1
    assert rules.facade.symbols == ["Gf", *(f"Fl_{i}" for i in range(1, count + 1))]
    for i in range(1, count + 1):
        upper, lower = rows[count - i], rows[count - i + 1]
        assert rules.facade.sizes_m[i] == pytest.approx((lower - upper) * METRES_PER_PX)
        windows = sorted((e for e in elements if e.floor == i), key=lambda e: e.x_m)
        split = rules.floors[i - 1]
        assert split.symbols[1::2] == [f"Win_{k + 1}" for k in range(len(windows))]
        assert split.symbols[::2] == [f"Wa_{k + 1}" for k in range(len(windows) + 1)]
        assert split.sizes_m[1::2] == pytest.approx([e.width_m for e in windows])


def _leaves(node: DerivationNode) -> Iterator[DerivationNode]:
    if not node.children:
        yield node
    for child in node.children:
        yield from _leaves(child)


def _inside(node: DerivationNode, parent: DerivationNode) -> bool:
    slack = 1e-9
    return (
        node.x_m >= parent.x_m - slack
        and node.y_m >= parent.y_m - slack
        and node.x_m + node.width_m <= parent.x_m + parent.width_m + slack
        and node.y_m + node.height_m <= parent.y_m + parent.height_m + slack
    )


def _overlap(a: DerivationNode, b: DerivationNode) -> float:
    x = min(a.x_m + a.width_m, b.x_m + b.width_m) - max(a.x_m, b.x_m)
    y = min(a.y_m + a.height_m, b.y_m + b.height_m) - max(a.y_m, b.y_m)
    return max(0.0, x) * max(0.0, y)


@given(facades())
def test_leaves_tile_the_facade(drawn: Drawn) -> None:
    rules, facade, elements, _, _ = drawn
    tree = derivation(rules, facade, elements)
    volume, roof = tree.children
    leaves = list(_leaves(volume))
    assert all(_inside(leaf, volume) for leaf in leaves)
    areas = sum(leaf.width_m * leaf.height_m for leaf in leaves)
    assert areas == pytest.approx(facade.width_m * facade.height_m)
    pairs = [(a, b) for i, a in enumerate(leaves) for b in leaves[:i]]
    assert max((_overlap(a, b) for a, b in pairs), default=0.0) < 1e-9
    assert (roof.symbol, roof.y_m) == ("Rf", pytest.approx(facade.height_m))
    assert roof.height_m == rules.roof_height_m


@given(facades())
def test_windows_stand_in_their_floors(drawn: Drawn) -> None:
    rules, facade, elements, _, _ = drawn
    (front,) = derivation(rules, facade, elements).children[0].children
    cells = [c for floor in front.children for c in floor.children if c.symbol.startswith("Win")]
    windows = [e for e in elements if e.floor is not None]
    assert len(cells) == len(windows)
    for window in windows:
        middle = window.y_m + window.height_m / 2
        assert any(
            cell.x_m == pytest.approx(window.x_m)
            and cell.width_m == pytest.approx(window.width_m)
            and cell.y_m < middle < cell.y_m + cell.height_m
            for cell in cells
        )


@given(facades())
def test_every_inner_node_names_its_rule(drawn: Drawn) -> None:
    rules, facade, elements, _, _ = drawn

    def check(node: DerivationNode) -> None:
        symbol = node.symbol.partition("_")[0]
        if node.children:
            assert node.rule == RULES[symbol]
        for child in node.children:
            check(child)

    check(derivation(rules, facade, elements))


def test_a_facade_without_windows_is_one_wall_a_floor() -> None:
    facade = _facade(0, 20, 100, 220)
    rules = rule_parameters([20.0, 70.0, 120.0], 20.0, facade, [], METRES_PER_PX)
    assert rules.roof_height_m == 0.0
    assert [floor.symbols for floor in rules.floors] == [["Wa_1"]] * 2
    assert rules.facade.sizes_m == pytest.approx([4.0, 2.0, 2.0])
