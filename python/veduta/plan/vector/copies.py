"""How many entities a drawing shows once all blocks are taken apart, without taking any apart."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ezdxf.document import Drawing as DxfDocument
    from ezdxf.layouts import BlockLayout, Modelspace

MOST_SHOWN = 20_000_000
"""Arrays of blocks, and blocks in blocks, make more than this out of a few kilobytes."""


def shown_count(document: DxfDocument, most: int = MOST_SHOWN) -> int:
    """The entities of the model space with those of its blocks, each copy counted; at most `most`.

    A block within itself counts as nothing there.
    """
    from ezdxf.entities import Insert  # not at the top: pictures need none of it

    known: dict[str, int] = {}

    def count(layout: BlockLayout | Modelspace) -> int:
        total = 0
        for insert in layout.query("INSERT"):
            name = str(insert.dxf.get("name", "")).lower()
            copies = insert.mcount if isinstance(insert, Insert) else 1
            total += max(1, abs(int(copies))) * known.get(name, 0)
        return min(most, total + len(layout))

    for name in _sorted_blocks(document):
        known[name] = count(document.blocks.get(name))
    return count(document.modelspace())


def _sorted_blocks(document: DxfDocument) -> list[str]:
    """The names of all blocks, each after those that it holds, as far as they are no circle."""
    holds = {
        block.name.lower(): sorted(
            {str(insert.dxf.get("name", "")).lower() for insert in block.query("INSERT")}
        )
        for block in document.blocks
    }
    done: dict[str, bool] = {}
    ordered: list[str] = []
    path: list[tuple[str, int]] = []
    for start in holds:
        if start in done:
            continue
        done[start] = False
        path.append((start, 0))
        while path:
            name, at = path.pop()
            inner = holds[name]
            if at == len(inner):
                done[name] = True
                ordered.append(name)
                continue
            path.append((name, at + 1))
            if inner[at] in holds and inner[at] not in done:
                done[inner[at]] = False
                path.append((inner[at], 0))
    return ordered
