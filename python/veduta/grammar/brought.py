"""Rules given as text that import from the styles' parts: derived on one lot, with their assets.

For programs that write rules themselves: nothing is looked for beside the text but what Veduta
brings along.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from pathlib import Path
from posixpath import dirname, join, normpath

from veduta import _core
from veduta.grammar.assets.asset import Asset
from veduta.grammar.assets.library import Library
from veduta.grammar.project import SearchPath
from veduta.grammar.rules import STYLES
from veduta.grammar.surfaces.catalogue import PREFIX, sizes_m
from veduta.grammar.textures import Textures
from veduta.place.material import Texture

Point = tuple[float, float, float]


def with_imports(name: str, text: str) -> list[tuple[str, str]]:
    """The text by its name, and all that it imports of `styles/`, by the names of the imports."""
    files = {name: text}
    waiting = [name]
    while waiting:
        importer = waiting.pop(0)
        for written in _core.grammar_imports(files[importer]):
            found = normpath(join(dirname(importer), written))
            if found not in files and found.startswith(f"{STYLES.name}/"):
                files[found] = _brought(found)
                waiting.append(found)
    return list(files.items())


def derive_text(
    name: str, text: str, lot: Sequence[Point]
) -> tuple[_core.DerivedLot, Sequence[Asset]] | str:
    """What rules make of a lot (corners, m) with seed 0, and the assets in it; or their fault."""
    rules, library = _core.GrammarRules(with_imports(name, text)), _library()
    rules.add_textures(sizes_m())
    for asset in rules.asset_names[0]:
        library.add_to(rules, asset)
    (derived,) = rules.derive([[list(lot)]], [0])
    if not isinstance(derived, _core.DerivedLot):
        return str(derived)
    return derived, library.assets_of(derived)


def brought_textures(assets: Sequence[Asset]) -> dict[str, Texture]:
    """The textures that assets have, by the names that rules have for them."""
    named = {slot.texture for asset in assets for slot in asset.slots}
    known = Textures({})
    return {f"{PREFIX}{name}": known[f"{PREFIX}{name}"] for name in sorted(filter(None, named))}


@cache
def _brought(name: str) -> str:
    return (STYLES.parent / name).read_text(encoding="utf-8")


@cache
def _library() -> Library:
    return Library(SearchPath.of(Path(STYLES)))
