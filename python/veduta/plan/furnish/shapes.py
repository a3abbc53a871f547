"""The shape of an entry of the catalogue at a size."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

from veduta.grammar.assets.asset import Asset, Slot
from veduta.grammar.assets.from_file import read_asset
from veduta.grammar.project import SearchPath
from veduta.plan.furnish.catalogue.entry import Entry, Finish, Size
from veduta.plan.furnish.catalogue.read import Catalogue
from veduta.plan.furnish.models.build import build, fitted
from veduta.run.errors import InputError

_PLAIN = Finish("plain", (0.8, 0.8, 0.8), 0.8, 0.0, 1.0, None)


def asset_of(entry: Entry, size_m: Size, catalogue: Catalogue, *, coarse: bool = False) -> Asset:
    """The object as an asset whose box has this size (width, depth, height).

    InputError where its file cannot be read.
    """
    if entry.model is None:
        return fitted(_from_file(entry.file or "", entry.folder or Path()), size_m)
    textures = tuple(
        (slot, _finish(entry, slot, catalogue).texture) for slot in sorted(entry.finishes)
    )
    return _built(entry.model, textures, size_m, coarse)


def finishes_of(asset: Asset, entry: Entry, catalogue: Catalogue) -> list[Finish]:
    """What each slot of an asset of an entry is made of."""
    if entry.model is not None:
        return [_finish(entry, slot.name, catalogue) for slot in asset.slots]
    return [
        Finish(slot.name, slot.colour or slot.fallback, slot.roughness, slot.metalness, 1.0, None)
        for slot in asset.slots
    ]


def _finish(entry: Entry, slot: str, catalogue: Catalogue) -> Finish:
    return catalogue.finishes.get(entry.finishes.get(slot, ""), _PLAIN)


@lru_cache(maxsize=512)
def _built(
    model: str, textures: tuple[tuple[str, str | None], ...], size_m: Size, coarse: bool
) -> Asset:
    return build(model, [Slot(name, texture=t) for name, t in textures], size_m, coarse=coarse)


@lru_cache(maxsize=64)
def _from_file(name: str, folder: Path) -> Asset:
    path = SearchPath.of(folder).find(name)
    if path is None:
        raise InputError(
            folder / name,
            "does not exist, or lies outside of the catalogue's folder",
            "Check the name in the catalogue.",
        )
    return read_asset(name, path)
