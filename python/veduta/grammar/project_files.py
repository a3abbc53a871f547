"""The files of a project, as rules ask for them: names, what tables hold, sizes of pictures."""

from __future__ import annotations

import hashlib
import json
import os
from dataclasses import dataclass, field
from pathlib import Path

from PIL import Image, UnidentifiedImageError

from veduta import _core
from veduta.formats.glb_head import extras_of, head_of
from veduta.grammar.edge_values import Attribute, EdgeList
from veduta.grammar.encodings import decoded
from veduta.grammar.project import SearchPath

MOST_FILES, MOST_FOLDERS = 20_000, 10_000
"""Files and folders of a project that are looked at."""
TEXTS = (".csv", ".txt", ".tsv", ".mtl")
MOST_TEXT = 4 * 2**20
"""Bytes of all tables and materials together, and of the heads of assets."""
PICTURES = (".jpg", ".jpeg", ".png", ".tif", ".tiff", ".webp", ".bmp")


@dataclass(frozen=True)
class ProjectFiles:
    """What rules may ask of files, by the names that they have for them."""

    names: list[str] = field(default_factory=list)
    texts: dict[str, str] = field(default_factory=dict)
    pictures: dict[str, tuple[float, float]] = field(default_factory=dict)
    metadata: dict[str, dict[str, Attribute | EdgeList]] = field(default_factory=dict)

    def digest(self) -> str:
        """Changes with anything that rules can learn of them."""
        told = [self.names, self.texts, self.pictures, self.metadata]
        return hashlib.sha256(json.dumps(told, sort_keys=True).encode()).hexdigest()

    def add_to(self, rules: _core.GrammarRules) -> None:
        """Hand them to the engine."""
        rules.add_files(self.names, self.texts, self.pictures, self.metadata)


def project_files(search: SearchPath, rules: _core.GrammarRules) -> ProjectFiles:
    """The files in the folders of a search, as far as the rules ask for them.

    A name that several folders have is the one of the first, as where rules name it.
    """
    lists, reads = rules.asks_files
    if not lists:
        return ProjectFiles()
    paths = _listed(search)
    found = ProjectFiles(list(paths))
    for name, path in paths.items():
        if name.lower().endswith(PICTURES):
            size = _size(path)
            if size is not None:
                found.pictures[name] = size
    if reads:
        _read_texts(paths, found)
        _read_metadata(paths, found)
    return found


def _listed(search: SearchPath) -> dict[str, Path]:
    paths: dict[str, Path] = {}
    folders = 0
    for root in search.folders:
        for where, below, names in os.walk(root):
            folders += 1
            # Results of a call would change the key of the next one.
            if ".veduta" in below:
                below.clear()
                continue
            below[:] = sorted(name for name in below if not name.startswith("."))
            for name in sorted(names):
                path = Path(where, name)
                if search.holds(path):
                    paths.setdefault(path.relative_to(root).as_posix(), path)
            if len(paths) >= MOST_FILES or folders >= MOST_FOLDERS:
                return dict(list(paths.items())[:MOST_FILES])
    return paths


def _read_texts(paths: dict[str, Path], found: ProjectFiles) -> None:
    """Tables until there is too much of them."""
    room = MOST_TEXT
    for name, path in paths.items():
        size = path.stat().st_size
        if name.lower().endswith(TEXTS) and size <= room:
            room -= size
            found.texts[name] = decoded(path.read_bytes())[0]


def _read_metadata(paths: dict[str, Path], found: ProjectFiles) -> None:
    """What binary glTF files say in the `extras` of their asset, scene and first nodes."""
    room = MOST_TEXT
    for name, path in paths.items():
        if not name.lower().endswith(".glb"):
            continue
        root = head_of(path, room)
        if root is None:
            continue
        room -= len(json.dumps(root))
        told: dict[str, Attribute | EdgeList] = {}
        for extras in extras_of(root):
            told |= {key: value for key, value in extras.items() if key not in told}
        if told:
            found.metadata[name] = told


def _size(path: Path) -> tuple[float, float] | None:
    """Width and height of a picture (px), from its head alone."""
    try:
        with Image.open(path) as image:
            return float(image.width), float(image.height)
    except (OSError, UnidentifiedImageError, Image.DecompressionBombError, ValueError):
        return None
