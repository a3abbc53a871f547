"""The limits of a derivation as options: each stops what needs more, and nothing else."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from veduta import grammar
from veduta.grammar import LimitOptions
from veduta.grammar.options import GrammarOptions
from veduta.grammar.pipeline import run_derive
from veduta.run.errors import InputError
from veduta.run.progress import Progress

LOT = [[(0, 0), (10, 0), (10, 6), (0, 6)]]
CASES = [
    # Ten A, each within the one before.
    ("max_depth", 9, 10, "Lot --> A(10)\nA(n) --> case n <= 1 : X. else : A(n - 1)", "2:34"),
    # Beside the lot, the 10 parts of the split.
    ("max_shapes", 9, 10, "Lot --> split(x) { 1 : X. }*", "1:"),
    # A prism of 100 sides has 600 corners: as many as 150 faces of four.
    ("max_faces", 149, 150, "Lot --> primitiveCylinder(100) X.", "1:9"),
    ("max_parts", 9, 10, "Lot --> split(x) { 1 : X. }*", "1:9"),
    ("max_parts", 6, 7, "Lot --> scatter(scope, 7, uniform) { X. }", "1:9"),
    ("max_work", 1, 10**6, "Lot --> extrude(3) X.", "1:"),
    ("max_memory", 1, 64, "Lot --> scatter(scope, 99, uniform) { s(1, 1, 1) S }\n"
     "S --> primitiveSphere(30, 30) X.", "2:7"),
    # The function calls itself 2^17 times.
    ("seconds", 0.001, 600.0, "f(n) = case n < 1 : 1 else : f(n - 1) + f(n - 1)\n"
     "Lot --> s(f(16), 1, 1) X.", "1:"),
]  # fmt: skip


def rules_of(folder: Path, text: str) -> grammar.Rules:
    path = folder / "rules.cga"
    path.write_text(text + "\n")
    return grammar.parse(path)


@pytest.mark.parametrize(("name", "little", "enough", "text", "place"), CASES)
def test_each_limit_is_told_with_its_place_and_option(
    tmp_path: Path, name: str, little: float, enough: float, text: str, place: str
) -> None:
    rules = rules_of(tmp_path, text)
    with pytest.raises(InputError) as raised:
        grammar.derive(rules, LOT, limits=LimitOptions.model_validate({name: little}))
    told = str(raised.value)
    assert f"rules.cga:{place}" in told
    option = name.replace("_", "-")
    assert f"--{option} allows more" in told
    assert len(grammar.derive(rules, LOT, limits=LimitOptions.model_validate({name: enough}))) > 1


def test_a_shape_derived_anew_keeps_the_limits(tmp_path: Path) -> None:
    text = "attr n = 2\nLot --> A(n)\nA(k) --> split(x) { 10 / k : X. }*"
    house = grammar.derive(rules_of(tmp_path, text), LOT, limits=LimitOptions(max_parts=5))
    (part,) = house.root.children
    with pytest.raises(InputError, match="--max-parts allows more"):
        grammar.rederive(part, values={"k": 6.0})
    (part,) = house.root.children
    again = grammar.rederive(part, values={"k": 5.0})
    assert again is not None
    assert len(again.children) == 5


def test_a_deeper_tree_than_usual_derives_where_it_is_allowed(tmp_path: Path) -> None:
    rules = rules_of(tmp_path, "Lot --> A(20000)\nA(n) --> case n <= 1 : X. else : A(n - 1)")
    with pytest.raises(InputError, match="--max-depth allows more"):
        grammar.derive(rules, LOT)
    house = grammar.derive(rules, LOT, limits=LimitOptions(max_depth=30_000))
    (leaf,) = house.leaves()
    assert len(leaf.path) == 20_001


def test_the_lots_of_a_call_have_them_and_others_are_another_result(tmp_path: Path) -> None:
    rules = tmp_path / "rules.cga"
    rules.write_text("attr n = 2\nLot --> extrude(3) split(x) { '1 / n : X. }*\n")
    lots = tmp_path / "lots.geojson"
    ring = [[0, 0], [9, 0], [9, 9], [0, 9], [0, 0]]
    features = [
        {
            "type": "Feature",
            "id": f"house {n}",
            "properties": {"n": n},
            "geometry": {
                "type": "Polygon",
                "coordinates": [[[84_000 + 20 * n + x, 446_000 + y] for x, y in ring]],
            },
        }
        for n in (2, 8)
    ]
    crs = {"type": "name", "properties": {"name": "EPSG:28992"}}
    lots.write_text(json.dumps({"type": "FeatureCollection", "crs": crs, "features": features}))
    out = tmp_path / "out"
    quiet = Progress(quiet=True)

    def run(most: int) -> tuple[int, list[str]]:
        options = GrammarOptions(limits=LimitOptions(max_parts=most))
        result = run_derive(str(rules), lots, out, options, quiet, jobs=1, force=True)
        assert not result.up_to_date
        return result.built.count, [one.reason for one in result.failures]

    count, (told,) = run(5)
    assert count == 1
    assert "rules.cga:2:20" in told
    assert "--max-parts allows more" in told
    assert run(8) == (2, [])
    report = json.loads((out / "report.json").read_text())
    assert report["options"]["limits"]["max_parts"] == 8
