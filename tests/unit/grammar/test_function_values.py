"""Values of functions and operators, each worked out by hand from what the reference says of it."""

from __future__ import annotations

from pathlib import Path

import pytest
from rule_values import values_of

_MISSING = (
    ('isNull("lintel")', "false"),
    ('isNull("\\ue000")', "true"),
    ("isNull(sqrt(-4))", "true"),
    ('isNull(["sill", "\\ue000", "quoin"])', "[false,true,false]"),
    ("isinf(3/0)", "true"),
    ("isinf(sqrt(-4))", "false"),
)
_CONVERTED = (
    ("str(2.75 - 3/4)", "2"),
    ("str(0012)", "12"),
    ('bool("F")', "true"),
    ('bool("f")', "false"),
    ('bool("oak")', "true"),
    ("bool(-0.5)", "true"),
    ('float("007.25")', "7.25"),
    ("float(false)", "0"),
    ('floatArray(["8", "stone", "4+4"])', "[8,nan,4]"),
    ("boolArray([3, 0, -1])", "[true,false,true]"),
    ('stringArray(["", "true"])', "[,true]"),
)
_TEXTS = (
    ('find("bay arch bay", "bay", 1)', "9"),
    ('find("bay arch bay", "oriel", 0)', "-1"),
    ('count("mezzanine", "z")', "2"),
    ('substring("abcdefgh", 3, 6)', "def"),
    ('substring("abcdefgh", -4, 2)', "ab"),
    ('substring("abcdefgh", 6, 2)', ""),
    ('findLast("bay arch bay", "bay")', "9"),
    ('getPrefix("north.wall.png", ".")', "north"),
    ('getSuffix("north.wall.png", ".")', "png"),
    ('getRange("north.wall.png", ".", ".")', "wall"),
    ('replace("brick on brick", "brick", "stone")', "stone on stone"),
    ('fileBasename("a/b/door.02.glb")', "door.02"),
    ('fileDirectory("a/b/door.02.glb")', "a/b/"),
    ('fileExtension("a/b/door.02.glb")', "glb"),
)
_LISTS = (
    ('listAdd("ash;elm;", "oak;")', "ash;elm;oak;"),
    ('listClean(";;ash;;;elm")', "ash;elm;"),
    ('listCount("ash;elm;ash;", "ash")', "2"),
    ('listCount("ash;elm;larch;", "*l*")', "2"),
    ('listCount("ash;elm;larch;", "l*")', "1"),
    ('listIndex("ash;elm;larch;", "*ch")', "2"),
    ('listRemove("ash;elm;ash;", "ash")', "elm;ash;"),
    ('listRemoveAll("ash;elm;ash;", "ash")', "elm;"),
    ('listRemoveAll("ash;;elm;", "")', "ash;;elm;"),
    ('listRetainAll("ash;elm;larch;", "*a*")', "ash;larch;"),
    ('listToArray("ash;elm;")', "[ash,elm]"),
    ('listFromArray(["ash", "elm"])', "ash;elm;"),
)
_OPERATORS = (
    ("[5,7] .- [1,2]", "[4,5]"),
    ("6 ./ [2,4]", "[3,1.5]"),
    ("-7 .% [4,-5]", "[-3,-2]"),
    ("[9,9;1,1] .> [8,10;0,2]", "[true,false;true,false]"),
    ("true .&& [true;false]", "[true;false]"),
    ('[4;5] .+ "m"', "[4m;5m]"),
    ("[3,4] == [3;4]", "false"),
    ("[3,4] < [3,5]", "true"),
    ("[10 : -4 : 1]", "[10,6,2]"),
    ("[3 : 1]", "[]"),
    ("[3 : 0 : 3]", "[]"),
)
_ARRAYS_OF = "row = [10,20,30,40]\nblock = [1,2;3,4;5,6]\n"
_ARRAYS = (
    ("row[[3,0]]", "[40,10]"),
    ("row[row .> 15 .&& row .< 40]", "[20,30]"),
    ("row[9]", "0"),
    ("block[4]", "5"),
    ("block[[2,0], 1]", "[6;2]"),
    ("block[0:1, [1,0]]", "[2,1;4,3]"),
    ("findFirst(row, 30, 0)", "2"),
    ("findFirst(row, 29.5, 1)", "2"),
    ("setElems(row, [0,3], [1,4])", "[1,20,30,4]"),
    ("setElems(row, row .>= 30, 0)", "[10,20,0,0]"),
    ("setElems(block, [0,2], [1], 9)", "[1,9;3,4;5,9]"),
    ("setElems([7], 2, 5)", "[7,0,5]"),
    ("sortIndices([30,10,20])", "[1,2,0]"),
    ("sortRowIndices([2,1;1,9;1,3])", "[2,1,0]"),
    ("sum([true,true,false])", "2"),
    ('sum(["a","rc","h"])', "arch"),
    ("transpose([1,2;3,4;5,6])", "[1,3,5;2,4,6]"),
    ('splitString("12x34x", "x")', "[12,34,]"),
    ('splitString("a1b22c", "$[0-9]+")', "[a,b,c]"),
    ('max("beech", "oak")', "oak"),
)


@pytest.mark.parametrize(
    ("definitions", "examples"),
    [
        ("", _MISSING),
        ("", _CONVERTED),
        ("", _TEXTS),
        ("", _LISTS),
        ("", _OPERATORS),
        (_ARRAYS_OF, _ARRAYS),
    ],
    ids=["missing", "converted", "texts", "lists", "operators", "arrays"],
)
def test_values(definitions: str, examples: tuple[tuple[str, str], ...], tmp_path: Path) -> None:
    found = values_of(definitions, [expression for expression, _ in examples], tmp_path)
    assert dict(zip([e for e, _ in examples], found, strict=True)) == dict(examples)


def test_what_cannot_be_derived_has_no_value(tmp_path: Path) -> None:
    assert values_of("", ["1 + 1", "notThere(1)"], tmp_path) == ["2", None]


def test_more_places_than_an_array_has_are_refused(tmp_path: Path) -> None:
    many = "setElems([0], [1:30000] .* 0, [1:30000] .* 0, 1)"
    assert values_of("", [many], tmp_path) == [None]
