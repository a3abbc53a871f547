"""The styles that Veduta brings along: what they derive on plain and on awkward lots."""

from __future__ import annotations

import functools
import re
from pathlib import Path

import numpy as np
import pytest

from veduta import _core
from veduta.grammar.assets.library import Library
from veduta.grammar.building import build_part
from veduta.grammar.rules import (
    STYLES,
    check_rules,
    compile_rules,
    find_rules,
    read_rules,
    style_names,
)
from veduta.grammar.textures import Textures
from veduta.place.part import Part

Ring = list[tuple[float, float, float]]


def ring(*corners: tuple[float, float]) -> Ring:
    return [(float(x), float(y), 0.0) for x, y in corners]


LOTS = {
    "rectangle": [ring((0, 0), (14, 0), (14, 12), (0, 12))],
    "l": [ring((0, 0), (16, 0), (16, 9), (8, 9), (8, 18), (0, 18))],
    "trapezoid": [ring((0, 0), (14, 0), (11, 12), (2, 10))],
    "triangle": [ring((0, 0), (15, 0), (6, 11))],
    "narrow": [ring((0, 0), (3, 0), (3, 14), (0, 14))],
    "corner": [ring((0, 0), (10, 0), (14, 4), (14, 16), (0, 16))],
    "octagon": [[(10 * np.cos(a), 10 * np.sin(a), 0.0) for a in np.arange(8) * np.pi / 4 - 1.9635]],
    "court": [
        ring((0, 0), (26, 0), (26, 22), (0, 22)),
        ring((9, 8), (9, 15), (17, 15), (17, 8)),
    ],
    "garden": [ring((0, 0), (21, 0), (21, 28), (0, 28))],
}
LEVELS = (0, 1, 2, 3)
LIBRARY = Library(STYLES)
TEXTURES = Textures({})
FIGURE_6_7 = ("21221", "22223", "12223", "22221", "21212", "11222", "21223", "11212", "22222")
"""What the nine facades of the thesis chose for the floors 1 to 5."""


@functools.cache
def rules_of(style: str) -> _core.GrammarRules:
    rules = compile_rules(read_rules(find_rules(style)))
    LIBRARY.add_written_to(rules)
    return rules


def part_of(derived: _core.DerivedLot) -> Part:
    return build_part(derived, "lot", LIBRARY.assets_of(derived), TEXTURES)


def derive(style: str, lots: list[list[Ring]], **attributes: bool | float | str) -> list[Part]:
    found = rules_of(style).derive(lots, [5] * len(lots), attributes=[attributes] * len(lots))
    parts = []
    for derived in found:
        assert not isinstance(derived, str), derived
        assert np.isfinite(derived.positions_m).all()
        assert "" not in derived.feature_class
        parts.append(part_of(derived))
    return parts


def classes(part: Part) -> set[str]:
    return {part.features.semantic(row).value for row in range(len(part.features))}


def triangles(part: Part) -> int:
    """All that are seen, those of repeated assets too."""
    repeated = part.instances.triangle_count if part.instances else 0
    return len(part.triangles.indices) + repeated


def top_of(part: Part, semantic: str) -> float:
    """The highest point of a class (m)."""
    rows = [r for r in range(len(part.features)) if part.features.semantic(r).value == semantic]
    chosen = np.isin(part.polygon_feature[part.triangles.polygon], rows)
    return float(part.positions_m[part.triangles.indices[chosen], 2].max())


@pytest.mark.parametrize("style", style_names())
def test_every_lot_derives_at_every_level(style: str) -> None:
    """No slivers are left out, the classes are there, each level has more than the one below."""
    counts = []
    for level in LEVELS:
        parts = derive(style, list(LOTS.values()), LOD=float(level))
        wanted = {"wall", "roof"} | ({"window", "door"} if level else set())
        for name, part in zip(LOTS, parts, strict=True):
            assert wanted <= classes(part), (name, level)
            assert part.notes == (), (name, level)
            assert float(part.feature_area_m2.min()) > 0.0
        counts.append([triangles(part) for part in parts])
    boxes, panels, detail, near = counts
    assert all(a < b < c < d for a, b, c, d in zip(boxes, panels, detail, near, strict=True))
    assert max(boxes) < 300


@pytest.mark.parametrize("style", style_names())
def test_every_level_has_assets_as_fine_as_it_says(style: str) -> None:
    """`LOD` reaches all parts: blocks alone below 2, what is for near by at 3 alone."""
    used = {}
    for level in LEVELS:
        found = rules_of(style).derive(
            list(LOTS.values()), [5] * len(LOTS), attributes=[{"LOD": float(level)}] * len(LOTS)
        )
        used[level] = {
            name for one in found if not isinstance(one, str) for name in one.asset_names
        }
    assert used[0] == set()
    assert used[1] <= {"builtin/block"}
    assert {name.partition("@")[2] for name in used[2]} <= {"", "1", "2"}
    assert any(name.startswith("builtin/window") and name.endswith("@0") for name in used[3])
    coarse = {name for name in used[3] if name.endswith(("@1", "@2"))}
    hoods = {"builtin/window-hood@1", "builtin/window-hood-round@1"}
    assert coarse <= {"builtin/quoin@1", "builtin/keystone@1"} | hoods


@pytest.mark.parametrize("style", style_names())
@pytest.mark.parametrize("height_m", [5.0, 9.0, 16.0])
def test_the_height_of_a_lot_is_kept_to(style: str, height_m: float) -> None:
    (part,) = derive(style, [LOTS["rectangle"]], height=height_m)
    above = 2.4 if style == "modern-slab" else 0.3  # stair tower and lift house; copings
    assert 0.6 * height_m < top_of(part, "roof") < height_m + above


@pytest.mark.parametrize("style", style_names())
@pytest.mark.parametrize("height_m", [3.0, 4.5, 6.5, 8.5])
def test_low_and_narrow_lots_are_houses(style: str, height_m: float) -> None:
    """As in old towns: a few metres wide and high, with a door that a person fits through."""
    for width_m in (2.2, 4.0, 8.0):
        lot = [ring((0, 0), (width_m, 0), (width_m, 9), (0, 9))]
        (part,) = derive(style, [lot], height=height_m, LOD=1.0)
        assert {"wall", "roof", "door", "window"} <= classes(part), width_m
        assert part.notes == ()
        assert 1.7 < top_of(part, "door") < height_m
        assert top_of(part, "window") < height_m


@pytest.mark.parametrize("style", style_names())
def test_the_same_seed_gives_the_same_building(style: str) -> None:
    rules = rules_of(style)
    first, again, other = rules.derive([LOTS["garden"]] * 3, [7, 7, 8])
    assert not isinstance(first, str)
    assert not isinstance(again, str)
    assert not isinstance(other, str)
    assert first.positions_m.tobytes() == again.positions_m.tobytes()
    assert first.looks == again.looks
    assert (first.positions_m.tobytes(), first.looks) != (other.positions_m.tobytes(), other.looks)


@pytest.mark.parametrize("style", style_names())
def test_openings_lie_behind_the_wall(style: str) -> None:
    """At street distance a reveal shows: no window of the front's ground floor is flush."""
    (part,) = derive(style, [LOTS["rectangle"]], LOD=1.0, height=0.0)
    rows = [r for r in range(len(part.features)) if part.features.semantic(r).value == "door"]
    chosen = np.isin(part.polygon_feature[part.triangles.polygon], rows)
    corners = part.positions_m[part.triangles.indices[chosen]]
    assert (np.abs(corners[..., 1]) > 0.1).all()


@pytest.mark.parametrize("style", style_names())
def test_every_attribute_is_documented(style: str) -> None:
    """A group, a text, and what it takes: a range, words, a colour, or true and false."""
    text = find_rules(style).read_text("utf-8")
    found = re.findall(r"((?:^@.*\n)+)attr (\w+) = (.*)", text, re.MULTILINE)
    kinds = dict(rules_of(style).attributes)
    # What a part keeps to itself has the part's name before it.
    assert {name for _, name, _ in found} == {name for name in kinds if "." not in name}
    assert {"LOD", "height", "storeys"} <= set(kinds)
    for notes, name, default in found:
        if "@Hidden" in notes:  # what roads say, and nobody has to
            continue
        assert "@Group(" in notes, name
        assert "@Description(" in notes, name
        told = re.search(r"@(Range\(min=|Enum\(|Color)", notes)
        assert told or default.endswith(("true", "false")), name


@pytest.mark.parametrize("style", style_names())
def test_the_ends_of_all_ranges_derive(style: str) -> None:
    """Each attribute at both ends of its range, and at each of its words, on two lots."""
    text = find_rules(style).read_text("utf-8")
    found = re.findall(r"((?:^@.*\n)+)attr (\w+) = ", text, re.MULTILINE)
    tried: list[dict[str, float | str]] = []
    for notes, name in found:
        for low, high in re.findall(r"@Range\(min=([\d.]+), max=([\d.]+)\)", notes):
            tried += [{name: float(low)}, {name: float(high)}]
        for words in re.findall(r"@Enum\(([^)]*)\)", notes):
            tried += [{name: word} for word in re.findall(r'"([^"]*)"', words)]
    assert len(tried) >= 10
    for lot in (LOTS["trapezoid"], LOTS["garden"]):
        given = [{"LOD": 2.0} | each for each in tried]
        for each, derived in zip(
            given,
            rules_of(style).derive([lot] * len(given), [3] * len(given), attributes=given),
            strict=True,
        ):
            assert not isinstance(derived, str), (each, derived)
            assert part_of(derived).notes == (), each


@pytest.mark.parametrize(
    "style", [name for name in style_names() if "sides" in dict(rules_of(name).attributes)]
)
def test_open_sides_have_windows(style: str) -> None:
    """At level 1 a window is one pane; one that looks along x is on a side of the lot."""
    counts = {}
    for sides in ("blind", "open"):
        (part,) = derive(style, [LOTS["rectangle"]], sides=sides, LOD=1.0)
        windows = [
            r for r in range(len(part.features)) if part.features.semantic(r).value == "window"
        ]
        chosen = np.isin(part.polygon_feature, windows)
        counts[sides] = int((np.abs(part.triangles.polygon_normal[chosen][:, 0]) > 0.99).sum())
    assert counts["blind"] == 0
    assert counts["open"] >= 6


@pytest.mark.parametrize("path", sorted((STYLES / "parts").glob("*.cga")), ids=lambda p: p.stem)
def test_parts_are_sound(path: Path) -> None:
    verdict = check_rules(read_rules(path))
    assert verdict.errors == 0, verdict.told
    assert verdict.underived == ""
    assert _core.grammar_format(path.name, path.read_text("utf-8")) == path.read_text("utf-8")


# ---- table 6.2 of the thesis --------------------------------------------------------------------


def test_the_floors_of_haussmann_are_those_of_table_6_2() -> None:
    """The variations of the table, at the frequencies of figure 6.7 with one added to each.

    Behind them stand those that are not in the table, each as often as one that was never chosen.
    """
    text = find_rules("haussmann").read_text("utf-8")
    assert len(re.findall(r"^\w+(?:\([^)]*\))? -->", text, re.MULTILINE)) >= 40
    floors = ("FirstFloor", "SecondFloor", "ThirdFloor", "FourthFloor", "FifthFloor")
    counts = zip(floors, (2, 2, 2, 2, 3), (0, 2, 1, 1, 1), strict=True)
    for place, (floor, variations, others) in enumerate(counts):
        (body,) = re.findall(rf"^{floor} -->\n((?:    .*\n)+)", text, re.MULTILINE)
        said = [int(value) for value in re.findall(r"(\d+)% :", body)]
        chosen = [facade[place] for facade in FIGURE_6_7]
        truth = [
            100 * (chosen.count(str(number)) + 1) / (len(chosen) + variations + others)
            for number in range(1, variations + others + 1)
        ]
        assert [*said, 100 - sum(said)] == pytest.approx(truth, abs=0.7), floor


# ---- shapes of the parts, against closed forms --------------------------------------------------


def areas_of(rules: str, library: str) -> dict[tuple[str, float], float]:
    """The areas (m2) that rules leave of an upright face of 2 by 3 m, by class and place.

    The place is how far the surface lies behind the face (m); surfaces across it do not count.
    """
    head = f'import {library} : "parts/{library}.cga"\nattr LOD = 1\n'
    start = "Lot --> extrude(3) comp(f) { front : Face | all : NIL }\n"
    files = [("main.cga", f"{head}{start}Face --> {rules}")]
    for path in (STYLES / "parts").iterdir():
        files.append((f"parts/{path.name}", path.read_text("utf-8")))
    lot = [ring((0, 0), (2, 0), (2, 2), (0, 2))]
    compiled = _core.GrammarRules(files)
    LIBRARY.add_written_to(compiled)
    (derived,) = compiled.derive([lot], [0])
    assert not isinstance(derived, str), derived
    part = part_of(derived)
    found: dict[tuple[str, float], float] = {}
    for triangle, polygon in zip(part.triangles.indices, part.triangles.polygon, strict=True):
        a, b, c = part.positions_m[triangle].astype(np.float64)
        if np.ptp([a[1], b[1], c[1]]) < 1e-6:
            semantic = part.features.semantic(int(part.polygon_feature[polygon])).value
            key = (semantic, round(float(a[1]), 3))
            found[key] = found.get(key, 0.0) + float(np.linalg.norm(np.cross(b - a, c - a)) / 2)
    return found


WALL = 'set(material.name, "wall") '


def test_a_round_arch_has_the_area_of_its_tangents() -> None:
    """Jambs of 2 m under tangents of a half circle of 1 m.

    Two neighbours that differ by the angle t bound a kite of the area tan(t / 2). The sides and the
    top of the face are tangents, too.
    """
    arch = 6 * np.tan(np.pi / 16) + 4 * np.tan(np.pi / 32)
    found = areas_of(WALL + 'arches.OpeningRound("casement", 0.2, "#ffffff")', "arches")
    assert found == pytest.approx({("window", 0.2): 4 + arch, ("wall", 0.0): 2 - arch}, abs=1e-5)


def test_a_pointed_arch_and_the_wall_around_it_make_up_the_face() -> None:
    """Two arcs of 60 degrees on a triangle, over jambs, with tangents a little outside."""
    found = areas_of(WALL + 'arches.OpeningPointed("planks", 0.2, "#ffffff")', "arches")
    door = found["door", 0.2]
    exact = 2 * (3 - np.sqrt(3)) + 4 * np.pi / 3 - np.sqrt(3)
    assert exact < door < exact + 0.025
    assert found["wall", 0.0] == pytest.approx(6 - door, abs=1e-3)  # 0.866 for half the root of 3


def test_a_gable_is_half_of_its_box() -> None:
    found = areas_of('set(material.name, "cornice") gables.GablePlate(0, "#ffffff")', "gables")
    assert found == pytest.approx({("cornice", 0.0): 3.0}, abs=1e-5)
