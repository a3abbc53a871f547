"""Lots from OBJ: faces and their objects, axes, and lines that cannot be read."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from veduta.grammar.lots import Lots, read_lots
from veduta.grammar.options import LotOptions
from veduta.run.errors import InputError

TWO = """# two lots
v 0 5 0
v 10 5 0
v 10 5 -8
v 0 5 -8
v 20 5 0
v 30 5 0
v 30 5 -8
o left
usemtl green
f 1/1/1 2/2/1 3/3/1 4/4/1
o right side
f -2 -1 3
f 5 6 7
"""


def read(folder: Path, text: str, **options: object) -> Lots:
    path = folder / "lots.obj"
    path.write_text(text)
    return read_lots(path, LotOptions.model_validate(options))


def test_y_is_up_and_z_looks_south(tmp_path: Path) -> None:
    found = read(tmp_path, TWO.split("o right")[0])
    (lot,) = found.lots
    assert (lot.name, found.crs, found.origin_m[2] + lot.anchor_m[2]) == ("left", None, 5.0)
    assert lot.rings_m[0].tolist() == [[0, 0], [10, 0], [10, 8], [0, 8]]
    assert any("y is up" in note for note in found.notes)


def test_z_up_when_asked(tmp_path: Path) -> None:
    text = "v 0 0 2\nv 6 0 2\nv 6 4 2\nv 0 4 2\nf 1 2 3 4\n"
    found = read(tmp_path, text, up="z")
    (lot,) = found.lots
    assert lot.rings_m[0].tolist() == [[0, 0], [6, 0], [6, 4], [0, 4]]
    assert (lot.name, found.origin_m[2] + lot.anchor_m[2]) == ("lots", 2.0)


def test_faces_that_share_edges_are_one_lot(tmp_path: Path) -> None:
    text = """v 0 0 0
v 4 0 0
v 4 0 -4
v 0 0 -4
v 8 0 0
v 8 0 -4
v 20 0 0
v 24 0 0
v 24 0 -4
g all
f 1 2 3 4
f 2 3 6 5
f 7 8 9
"""
    found = read(tmp_path, text)
    assert [lot.name for lot in found.lots] == ["all-1", "all-2"]
    areas = []
    for lot in found.lots:
        x, y = lot.rings_m[0].T
        areas.append(0.5 * float(x @ np.roll(y, -1) - y @ np.roll(x, -1)))
    assert areas == pytest.approx([32, 8])


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("v 0 0\nf 1 1 1\n", "line 1"),
        ("v 0 0 0\nv 1 0 0\nf 1 2\n", "line 3"),
        ("v 0 0 0\nv 1 0 0\nv 1 0 1\nf 1 2 4\n", "line 4"),
        ("v 0 0 0\nv 1 0 0\nv 1 0 1\nf 0 1 2\n", "line 4"),
        ("v 0 0 0\nv 1 0 0\nv 1 0 1\nf 1 two 3\n", "line 4"),
        ("v 0 0 0\nv nan 0 0\nv 1 0 1\nf 1 2 3\n", "not finite"),
        ("# nothing\n", "no lot that can be used"),
    ],
)
def test_what_cannot_be_read_names_the_line(tmp_path: Path, text: str, told: str) -> None:
    with pytest.raises(InputError, match=told):
        read(tmp_path, text)


def test_layers_are_for_packages(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="has no layers"):
        read(tmp_path, TWO, layer="lots")
