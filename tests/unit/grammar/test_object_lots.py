"""Lots from OBJ: faces and their objects, axes, and lines that cannot be read."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from veduta.grammar import object_lots
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


def test_a_bad_face_is_a_failure_of_its_object(tmp_path: Path) -> None:
    found = read(tmp_path, TWO.replace("f 5 6 7", "f 5 6 70"))
    assert [lot.name for lot in found.lots] == ["left"]
    (failure,) = found.failures
    assert failure.subject.endswith(": right side")
    assert failure.reason == "line 14: names a vertex that is not there"


def test_an_object_has_an_end(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(object_lots, "MAX_FACE_CORNERS", 6)
    with pytest.raises(InputError, match=r"more than 6 corners \(line 15\)"):
        read(tmp_path, TWO + "f 1 2 3\n")


def test_vertices_are_the_same_in_pieces(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    whole = read(tmp_path, TWO)
    monkeypatch.setattr(object_lots, "AT_ONCE", 2)
    parts = read(tmp_path, TWO)
    assert [lot.anchor_m for lot in parts.lots] == [lot.anchor_m for lot in whole.lots]
    for one, other in zip(parts.lots, whole.lots, strict=True):
        assert one.rings_m[0].tolist() == other.rings_m[0].tolist()
