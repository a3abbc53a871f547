"""How many entities blocks make is known before any is taken apart."""

from __future__ import annotations

from pathlib import Path

import ezdxf
import pytest

from veduta.plan.vector.copies import shown_count
from veduta.plan.vector.open_dxf import open_dxf
from veduta.run.errors import InputError

SPACED = {"row_spacing": 1.0, "column_spacing": 1.0}


def test_copies_are_counted() -> None:
    document = ezdxf.new()
    inner, outer = document.blocks.new("inner"), document.blocks.new("outer")
    for _ in range(3):
        inner.add_line((0, 0), (1, 0))
    outer.add_blockref("INNER", (0, 0), dict(SPACED, row_count=5, column_count=2))
    space = document.modelspace()
    space.add_blockref("outer", (0, 0))
    space.add_blockref("inner", (0, 0))
    space.add_line((0, 0), (1, 1))
    # inner 3; outer 1 + 10 * 3; the space 3 of its own, 31 and 3.
    assert shown_count(document) == 3 + 31 + 3
    assert shown_count(document, 10) == 10


def test_circles_of_blocks_end() -> None:
    document = ezdxf.new()
    one, two = document.blocks.new("one"), document.blocks.new("two")
    one.add_blockref("two", (0, 0))
    two.add_blockref("one", (0, 0))
    document.modelspace().add_blockref("one", (0, 0))
    assert shown_count(document) < 10


@pytest.mark.parametrize("nested", [False, True])
def test_a_small_file_of_many_copies_is_refused(nested: bool, tmp_path: Path) -> None:
    document = ezdxf.new()
    document.blocks.new("b0").add_line((0, 0), (1, 0))
    if nested:
        for level in range(1, 31):
            block = document.blocks.new(f"b{level}")
            for _ in range(2):
                block.add_blockref(f"b{level - 1}", (0, 0))
        document.modelspace().add_blockref("b30", (0, 0))
    else:
        size = dict(SPACED, row_count=30_000, column_count=30_000)
        document.modelspace().add_blockref("b0", (0, 0), size)
    path = tmp_path / "array.dxf"
    document.saveas(path)
    with pytest.raises(InputError, match=r"array\.dxf: repeats its blocks to more than 20,000,000"):
        open_dxf(path)
