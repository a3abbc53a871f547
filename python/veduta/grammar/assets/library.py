"""Assets by name: built-in ones, and files of the rule file's project.

An asset that is not there leaves the box of its scope, in a colour of its own, and is named.
"""

from __future__ import annotations

import contextlib
import difflib
import hashlib
import os
from dataclasses import replace
from pathlib import Path

from veduta import _core
from veduta.formats.obj_read import LARGEST_BYTES
from veduta.grammar.assets.asset import Asset, Slot
from veduta.grammar.assets.catalogue import PREFIX, builtin, builtin_names, parts_of
from veduta.grammar.assets.from_file import SUFFIXES, read_asset
from veduta.grammar.assets.pictures import picture_name, pictures_of_files
from veduta.grammar.assets.primitives import missing_box, primitive
from veduta.grammar.picture_sources import as_texture
from veduta.grammar.project import SearchPath
from veduta.grammar.surfaces.catalogue import PREFIX as TEXTURES
from veduta.grammar.surfaces.catalogue import sizes_m, sources_digest
from veduta.grammar.textures import MAX_TEXTURES, mean_of
from veduta.place.material import Colour
from veduta.run.errors import InputError

MOST_FILES, MOST_FOLDERS = 2_000, 10_000
"""Files and folders below a rule file that are looked at where asset names are computed."""
_READ = (*SUFFIXES, ".mtl")


class Library:
    """What `i` may insert. search: where files are looked for; a folder alone is one, too.

    missing: why an asset that rules name is not there, by its name. pictures: where those of
    the assets so far are, by the names that they have among the textures of a call.
    """

    def __init__(self, search: SearchPath | Path) -> None:
        self.search = search if isinstance(search, SearchPath) else SearchPath.of(search)
        self.missing: dict[str, str] = {}
        self.pictures: dict[str, str] = {}
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
        rules.add_asset(
            name, *faces, asset.box_m, *looks,
            in_plane=asset.in_plane, panel=asset.panel, uv=asset.uv,
        )  # fmt: skip

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
            if asset.uv is not None:
                total.update(asset.uv.tobytes())
        for root, path in self.files() if computed else ():
            total.update(f"{path.relative_to(root)} {path.stat().st_size}".encode())
            total.update(hashlib.sha256(path.read_bytes()).digest())
        return total.hexdigest()

    def textures(self, rules: _core.GrammarRules) -> tuple[dict[str, str], tuple[str, ...]]:
        """The pictures of the assets that the rules may name, and what is to be said of them.

        Where names are computed, those of all asset files count, as far as there is room.
        """
        written, computed = rules.asset_names
        for name in written:
            with contextlib.suppress(InputError):
                _ = self[name]
        found = dict(self.pictures)
        for where in pictures_of_files(self.files()) if computed else ():
            if len(found) > MAX_TEXTURES:
                break
            name = picture_name(where, self.search)
            if name not in found and _is_sound(where):
                found[name] = as_texture(where)
        if len(found) <= MAX_TEXTURES:
            return found, ()
        note = f"assets have more than {MAX_TEXTURES} pictures: of the others the mean is shown"
        return dict(list(found.items())[:MAX_TEXTURES]), (note,)

    def computed_missing(self, rules: _core.GrammarRules) -> list[str]:
        """Why assets are not there whose names the rules compute, by the names."""
        written = set(rules.asset_names[0])
        return [why for name, why in sorted(self.missing.items()) if name not in written]

    def notes(self) -> list[str]:
        """What is missing of the assets that are there, such as their pictures."""
        return [f"{name}: {note}" for name, asset in self._known.items() for note in asset.notes]

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
        return self._with_pictures(read_asset(name, path))

    def _with_pictures(self, asset: Asset) -> Asset:
        """With the names of pictures among textures, and without those that cannot be read."""
        slots, notes = list(asset.slots), list(asset.notes)
        for number, slot in enumerate(slots):
            if slot.picture is None:
                continue
            name = picture_name(slot.picture, self.search)
            try:
                mean = mean_of(as_texture(slot.picture))
            except InputError as error:
                slots[number] = replace(slot, picture=None)
                notes.append(f"a picture is not shown, but the colour of its material: {error}")
                continue
            self.pictures[name] = as_texture(slot.picture)
            slots[number] = replace(slot, picture=name, mean=mean)
        return replace(asset, slots=tuple(slots), notes=tuple(dict.fromkeys(notes)))

    def files(self) -> list[tuple[Path, Path]]:
        """Asset files of all folders that are searched, each with its folder, once."""
        seen: dict[Path, Path] = {}
        for folder in self.search.folders:
            for path in _files_below(folder):
                seen.setdefault(path, folder)
        return [(folder, path) for path, folder in seen.items()]


def textured(slot: Slot) -> tuple[str, tuple[float, float] | None, Colour] | None:
    """The texture of a slot by its name among textures, its size (m), and its mean colour (sRGB).

    No size where it lies by the asset's own places; None without a texture.
    """
    if slot.picture is not None:
        return slot.picture, None, slot.mean
    name = f"{TEXTURES}{slot.texture}"
    size = sizes_m().get(name)
    return None if size is None else (name, size, slot.mean)


def _is_sound(picture: str) -> bool:
    """Whether a picture can be read."""
    try:
        mean_of(as_texture(picture))
    except InputError:
        return False
    return True


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
