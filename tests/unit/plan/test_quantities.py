"""Sizes are read from all ways to write them, and nothing else is taken for one."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from veduta.plan.scale.quantities import Quantity, read_quantities

TIMES = st.sampled_from(["x", "X", "×", " x ", " × ", " X ", " by "])
CENTIMETRES = st.integers(100, 2999)


def _kinds(text: str, kind: str) -> list[Quantity]:
    return [one for one in read_quantities(text) if one.kind == kind]


@given(
    CENTIMETRES, CENTIMETRES, TIMES, st.sampled_from([".", ","]), st.sampled_from(["", "m", " m"])
)
def test_two_sides_in_metres(a: int, b: int, times: str, point: str, unit: str) -> None:
    sides = [f"{value / 100:.2f}".replace(".", point) + unit for value in (a, b)]
    found = _kinds(times.join(sides), "size")
    assert len(found) == 1
    assert found[0].values == pytest.approx((a / 100, b / 100))
    assert found[0].trust == 1.0


@given(
    st.integers(2, 60), st.integers(0, 11), st.integers(2, 60), st.integers(0, 11), TIMES,
    st.sampled_from(["{f}'{i}", "{f}'{i}\"", "{f}'-{i}\"", "{f}' {i}\"", "{f}’{i}”", "{f}ft {i}in"])
)  # fmt: skip
def test_two_sides_in_feet(f: int, i: int, g: int, j: int, times: str, style: str) -> None:
    text = style.format(f=f, i=i) + times + style.format(f=g, i=j)
    found = _kinds(text, "size")
    truth = ((12 * f + i) * 0.0254, (12 * g + j) * 0.0254)
    assert any(one.values == pytest.approx(truth) and one.trust == 1.0 for one in found)


@given(st.integers(4, 60), st.integers(0, 11), st.integers(4, 60), st.integers(0, 11))
def test_feet_are_found_where_their_marks_were_lost(f: int, i: int, g: int, j: int) -> None:
    truth = ((12 * f + i) * 0.0254, (12 * g + j) * 0.0254)
    found = _kinds(f"{f}{i} × {g}{j}", "size")
    assert any(one.values == pytest.approx(truth) and 0 < one.trust < 1 for one in found)


@given(
    st.integers(10, 9999),
    st.sampled_from(["m2", " m2", "m²", " m²", " sq m", " sqm", " sq. m", "㎡", " kvm", " qm"]),
    st.sampled_from([".", ","]),
)
def test_areas(tenths: int, unit: str, point: str) -> None:
    found = _kinds(f"{tenths / 10:.1f}".replace(".", point) + unit, "area")
    assert [one.values[0] for one in found] == pytest.approx([tenths / 10])


@given(st.integers(30, 9999), st.sampled_from([" sq ft", " sq.ft.", "sqft", " ft²", " Sq. Ft."]))
def test_areas_in_square_feet(feet: int, unit: str) -> None:
    found = _kinds(f"{feet}{unit}", "area")
    assert [one.values[0] for one in found] == pytest.approx([feet * 0.09290304])


def test_both_units_of_one_size() -> None:
    found = _kinds("4.94m x 3.06m (16'2\" x 10'0\")", "size")
    assert [one.values for one in found] == [
        pytest.approx((4.94, 3.06)),
        pytest.approx((16 * 0.3048 + 2 * 0.0254, 3.048)),
    ]
    assert [one.values[0] for one in _kinds("82 sq m / 883 sq ft", "area")] == pytest.approx(
        [82.0, 883 * 0.09290304]
    )


@pytest.mark.parametrize(
    ("text", "feet"),
    [
        ("39'5°×4'10\"", (39 + 5 / 12, 4 + 10 / 12)),
        ("102°×4'10", (10 + 2 / 12, 4 + 10 / 12)),
        ("103°×88°", (10 + 3 / 12, 8 + 8 / 12)),
        ('125" ×117°', (12 + 5 / 12, 11 + 7 / 12)),
        ("67*×8'8", (6 + 7 / 12, 8 + 8 / 12)),
        ("12'11'×10'2", (12 + 11 / 12, 10 + 2 / 12)),
    ],
)
def test_marks_of_feet_and_inches_that_were_misread(text: str, feet: tuple[float, float]) -> None:
    found = _kinds(text, "size")
    likeliest = max(found, key=lambda one: one.trust)
    assert likeliest.values == pytest.approx([0.3048 * one for one in feet])


@pytest.mark.parametrize("text", ['36" x 24"', '12" x 12"', "20° x 30°"])
def test_inches_of_a_hob_or_a_tile_are_no_room(text: str) -> None:
    assert read_quantities(text) == []


def test_inches_of_a_room_are_a_reading() -> None:
    sizes = [one.values for one in _kinds('133" x 117"', "size")]
    assert pytest.approx((133 * 0.0254, 117 * 0.0254)) in sizes
    assert pytest.approx(((13 + 3 / 12) * 0.3048, (11 + 7 / 12) * 0.3048)) in sizes


@pytest.mark.parametrize(
    ("text", "metres"),
    [
        ("3450", 3.45),
        ("3 450", 3.45),
        ("345", 3.45),
        ("5.00 m", 5.0),
        ("5,00", 5.0),
        ("12'-6\"", 3.81),
        ("12'-6 1/2\"", 3.8227),
        ("2700 mm", 2.7),
        ("270 cm", 2.7),
        ('3450"', 3.45),
        ("3450°", 3.45),
        ("345°", 3.45),
    ],
)
def test_lengths_of_dimension_lines(text: str, metres: float) -> None:
    found = _kinds(text, "length")
    likeliest = max(found, key=lambda one: one.trust)
    assert likeliest.values[0] == pytest.approx(metres)


@given(st.integers(1000, 30000))
def test_whole_numbers_are_millimetres_first(number: int) -> None:
    likeliest = max(_kinds(str(number), "length"), key=lambda one: one.trust)
    assert likeliest.values[0] == pytest.approx(number / 1000)


@pytest.mark.parametrize(
    ("text", "ratio"),
    [("1:100", 100), ("Scale 1 : 50", 50), ("M 1/200", 200), ('1/4" = 1\'-0"', 48)],
)
def test_ratios(text: str, ratio: float) -> None:
    assert [one.values[0] for one in _kinds(text, "ratio")] == [ratio]


@pytest.mark.parametrize(
    "text",
    [
        "Bedroom 2",
        "EI 60",
        "dB 30",
        "A14/A21/A28",
        "3H+K+S",
        "h=2350",
        "m²",
        "N",
        "PO10",
        "1:37",
        "",
    ],
)
def test_what_is_no_size(text: str) -> None:
    assert read_quantities(text) == []


@given(st.text("0123456789.,'\"x×mft²qin -/:=ab", max_size=30))
def test_any_text_gives_sane_values_or_nothing(text: str) -> None:
    for one in read_quantities(text):
        assert all(0 < value < 5001 for value in one.values)
        assert len(one.values) == (2 if one.kind == "size" else 1)
        assert 0 < one.trust <= 1
