"""Assets by name: built-in ones, and files beside the rule file."""

from __future__ import annotations

import difflib
import hashlib
import os
from pathlib import Path

from veduta import _core
from veduta.formats.obj_read import LARGEST_BYTES
from veduta.grammar.assets.asset import Asset, Slot
from veduta.grammar.assets.catalogue import PREFIX, builtin, builtin_names, parts_of
from veduta.grammar.assets.from_file import SUFFIXES, read_asset
from veduta.grammar.surfaces.catalogue import PREFIX as TEXTURES
from veduta.grammar.surfaces.catalogue import sizes_m, sources_digest
from veduta.run.errors import InputError

MOST_FILES, MOST_FOLDERS = 2_000, 10_000
"""Files and folders below a rule file that are looked at where asset names are computed."""
_READ = (*SUFFIXES, ".mtl")


class Library:
    """What `i` may insert; `folder` is that of the rule file, below which files are looked for."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._known: dict[str, Asset] = {}

    def __getitem__(self, name: str) -> Asset:
        """The asset; InputError where there is none."""
        if name not in self._known:
            self._known[name] = self._found(name)
        return self._known[name]

    def add_to(self, rules: _core.GrammarRules, name: str) -> None:
        """Hand an asset to the engine; InputError where there is none."""
        asset = self[name]
        slots = [(slot.colour, slot.fallback, textured(slot)) for slot in asset.slots]
        faces = (asset.points_m, asset.corners, asset.offsets)
        rules.add_asset(name, *faces, asset.box_m, asset.face_slot, slots)

    def add_written_to(self, rules: _core.GrammarRules) -> None:
        """Hand over the assets whose names stand in the rules; InputError where one is none.

        And the sizes of the built-in textures, which lie in metres.
        """
        rules.add_textures(sizes_m())
        for name in rules.asset_names[0]:
            self.add_to(rules, name)

    def assets_of(self, derived: _core.DerivedLot) -> dict[str, Asset]:
        """The assets that a building was made with."""
        return {name: self[name] for name in derived.asset_names}

    def digest(self, rules: _core.GrammarRules) -> str:
        """The digest of all assets that the rules may name; InputError where one is none."""
        written, computed = rules.asset_names
        total = hashlib.sha256(sources_digest().encode())
        for name in written:
            asset = self[name]
            total.update(f"{name} {asset.slots}".encode())
            for column in (asset.points_m, asset.corners, asset.offsets, asset.face_slot):
                total.update(column.tobytes())
        for path in _files_below(self.folder) if computed else ():
            total.update(f"{path.relative_to(self.folder)} {path.stat().st_size}".encode())
            total.update(hashlib.sha256(path.read_bytes()).digest())
        return total.hexdigest()

    def faults(self, rules: _core.GrammarRules) -> list[str]:
        """What is wrong with the assets whose names stand in the rules."""
        told = []
        for name in rules.asset_names[0]:
            try:
                _ = self[name]
            except InputError as error:
                told.append(str(error))
        return told

    def _found(self, name: str) -> Asset:
        asset = builtin(name)
        if asset is not None:
            return asset
        if name.startswith(PREFIX):
            plain = name.partition(":")[0]
            if parts := parts_of(plain):
                parts_told = ", ".join(f"`{plain}:{part}`" for part in parts)
                raise InputError(
                    name, "is no part of it that Veduta brings along", f"There are {parts_told}."
                )
            near = difflib.get_close_matches(name, builtin_names(), n=1, cutoff=0.5)
            hint = f"Did you mean `{near[0]}`?" if near else "docs/assets.md lists those there are."
            raise InputError(name, "is no asset that Veduta brings along", hint)
        if not name.lower().endswith(SUFFIXES):
            raise InputError(name, "is no OBJ or GLB file", f"Built-in assets begin with {PREFIX}")
        return read_asset(name, self.folder)


def textured(slot: Slot) -> tuple[str, tuple[float, float]] | None:
    """The texture of a slot by its name in rule files, with its size (m); None without one."""
    name = f"{TEXTURES}{slot.texture}"
    size = sizes_m().get(name)
    return None if size is None else (name, size)


def _files_below(folder: Path) -> list[Path]:
    """Asset files and their materials, as many as are looked at."""
    found: list[Path] = []
    for seen, (where, folders, names) in enumerate(os.walk(folder)):
        if ".veduta" in folders:  # results of a call, which would change its own key
            folders.clear()
            continue
        folders.sort()
        paths = [Path(where) / name for name in sorted(names) if name.lower().endswith(_READ)]
        found += [path for path in paths if path.is_file() and path.stat().st_size <= LARGEST_BYTES]
        if len(found) >= MOST_FILES or seen >= MOST_FOLDERS:
            break
    return found[:MOST_FILES]
