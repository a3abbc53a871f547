"""Assets by name: built-in ones, and files of the rule file's project.

An asset that is not there leaves the box of its scope, in a colour of its own, and is named.
"""

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
from veduta.grammar.assets.primitives import missing_box, primitive
from veduta.grammar.project import SearchPath
from veduta.grammar.surfaces.catalogue import PREFIX as TEXTURES
from veduta.grammar.surfaces.catalogue import sizes_m, sources_digest
from veduta.run.errors import InputError

MOST_FILES, MOST_FOLDERS = 2_000, 10_000
"""Files and folders below a rule file that are looked at where asset names are computed."""
_READ = (*SUFFIXES, ".mtl")


class Library:
    """What `i` may insert. search: where files are looked for; a folder alone is one, too.

    missing: why an asset that rules name is not there, by its name.
    """

    def __init__(self, search: SearchPath | Path) -> None:
        self.search = search if isinstance(search, SearchPath) else SearchPath.of(search)
        self.missing: dict[str, str] = {}
        self._known: dict[str, Asset] = {}
        self._views: dict[tuple[str, tuple[bool, bool]], Asset] = {}

    def __getitem__(self, name: str) -> Asset:
        """The asset; InputError where there is none."""
        if name not in self._known:
            self._known[name] = self._found(name)
        return self._known[name]

    def add_to(self, rules: _core.GrammarRules, name: str) -> None:
        """Hand an asset to the engine; where there is none, the box that stands for it."""
        try:
            asset = self[name]
        except InputError as error:
            self.missing[name] = str(error)
            asset = self._known[name] = missing_box(name)
        slots = [(slot.colour, slot.fallback, textured(slot)) for slot in asset.slots]
        faces = (asset.points_m, asset.corners, asset.offsets)
        labels = None
        if asset.groups:
            names = [slot.name for slot in asset.slots]
            labels = (names, asset.face_group.tolist(), list(asset.groups))
        looks = (asset.face_slot, slots, labels)
        rules.add_asset(name, *faces, asset.box_m, *looks, in_plane=asset.in_plane)

    def add_written_to(self, rules: _core.GrammarRules) -> None:
        """Hand over the assets whose names stand in the rules.

        And the sizes of the built-in textures, which lie in metres.
        """
        rules.add_textures(sizes_m())
        for name in rules.asset_names[0]:
            self.add_to(rules, name)

    def assets_of(self, derived: _core.DerivedLot) -> tuple[Asset, ...]:
        """The assets that a building was made with, as its columns count them."""
        seen = zip(derived.asset_names, derived.asset_views, strict=True)
        return tuple(self._seen(name, view) for name, view in seen)

    def _seen(self, name: str, view: tuple[bool, bool]) -> Asset:
        """An asset as it is or from another side, which is made once."""
        if view == (False, False):
            return self[name]
        if (name, view) not in self._views:
            self._views[name, view] = self[name].seen(*view)
        return self._views[name, view]

    def digest(self, rules: _core.GrammarRules) -> str:
        """The digest of all assets that the rules may name, those that are missing among them."""
        written, computed = rules.asset_names
        total = hashlib.sha256(sources_digest().encode())
        for name in written:
            try:
                asset = self[name]
            except InputError:
                total.update(f"{name} is missing".encode())
                continue
            total.update(f"{name} {asset.slots} {asset.groups}".encode())
            columns = (asset.points_m, asset.corners, asset.offsets, asset.face_slot)
            for column in (*columns, asset.face_group):
                total.update(column.tobytes())
        for root, path in self._files() if computed else ():
            total.update(f"{path.relative_to(root)} {path.stat().st_size}".encode())
            total.update(hashlib.sha256(path.read_bytes()).digest())
        return total.hexdigest()

    def told_missing(self) -> list[str]:
        """What to say of the assets that are missing."""
        return [f"{why} A box stands for it." for why in self.missing.values()]

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
        asset = builtin(name) or primitive(name)
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
            raise InputError(
                name, "is no OBJ, GLB or COLLADA file", f"Built-in assets begin with {PREFIX}"
            )
        path = self.search.find(name)
        if path is None:
            looked = ", ".join(str(folder) for folder in self.search.folders)
            fault = f"does not exist in any folder in which it is looked for ({looked})"
            raise InputError(name, fault, "Check the name in the rule file.")
        return read_asset(name, path)

    def _files(self) -> list[tuple[Path, Path]]:
        """Asset files of all folders that are searched, each with its folder, once."""
        seen: dict[Path, Path] = {}
        for folder in self.search.folders:
            for path in _files_below(folder):
                seen.setdefault(path, folder)
        return [(folder, path) for path, folder in seen.items()]


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
