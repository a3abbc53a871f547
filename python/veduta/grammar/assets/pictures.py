"""The pictures of assets: their names among the textures of a call, and those that a project has.

A name is `asset:PATH` with the path in the folder in which assets are looked for, `asset2:PATH` in
the third of these folders, and ends in `#K` where the picture is image K of a binary glTF file: the
same on every machine.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any
from urllib.parse import unquote

from veduta.formats.glb_head import head_of
from veduta.formats.model_pictures import beside, file_of, image_number
from veduta.formats.mtl_read import read_mtl
from veduta.grammar.project import SearchPath
from veduta.run.names import real_path

MOST_HEAD = 4 * 2**20
"""Bytes of the document of a binary glTF file that is looked into for pictures."""
_INIT_FROM = re.compile(rb"<init_from>\s*(?:<ref>)?([^<]{1,1000})<")


def picture_name(where: str, search: SearchPath) -> str:
    """The name of a picture, as `formats.model_pictures` has it, among the textures of a call."""
    file, number = file_of(where)
    ending = "" if number is None else f"#{number}"
    real = str(real_path(file))
    folders = [str(real_path(folder)) for folder in search.folders]
    for place, folder in enumerate(folders):
        if os.path.commonpath([folder, real]) == folder:
            own = Path(real).relative_to(folder).as_posix()
            return f"asset{place or ''}:{own}{ending}"
    return f"asset:{Path(os.path.relpath(real, folders[0])).as_posix()}{ending}"


def pictures_of_files(files: Iterable[tuple[Path, Path]]) -> Iterator[str]:
    """The pictures that asset files may show, each file with the folder that it is looked for in.

    As `formats.model_pictures` names them. Heads and materials alone are read: what computed names
    lead to is known only when lots are derived.
    """
    for root, path in files:
        match path.suffix.lower():
            case ".mtl":
                yield from _of_mtl(path, root)
            case ".glb":
                yield from _of_glb(path, root)
            case ".dae":
                yield from _below(_INIT_FROM.findall(path.read_bytes()), path, root)


def _of_mtl(path: Path, root: Path) -> Iterator[str]:
    try:
        materials = read_mtl(path.read_text(encoding="utf-8", errors="replace").splitlines())
    except ValueError:
        return
    for material in materials.values():
        found = material.picture and beside(material.picture, path.parent, root)
        if found:
            yield str(found)


def _of_glb(path: Path, root: Path) -> Iterator[str]:
    document = head_of(path, MOST_HEAD)
    for material in (document or {}).get("materials", ()):
        yield from _of_material(document or {}, material, path, root)


def _of_material(document: dict[str, Any], material: Any, path: Path, root: Path) -> Iterator[str]:
    try:
        number = image_number(document, material)
        image = {} if number is None else document["images"][number]
        uri = image.get("uri", "data:")
    except (KeyError, IndexError, TypeError, AttributeError):
        return
    if number is None:
        return
    if isinstance(uri, str) and uri.startswith("data:"):
        yield f"{real_path(path)}#{number}"
    else:
        found = beside(unquote(str(uri)), path.parent, root)
        if found:
            yield str(found)


def _below(names: Iterable[bytes], path: Path, root: Path) -> Iterator[str]:
    for name in names:
        text = unquote(name.decode("utf-8", errors="replace").strip())
        found = beside(text, path.parent, root)
        if found:
            yield str(found)
