"""What a call of the verb is asked to do: its inputs, each with a name, and nothing done yet."""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from pydantic import JsonValue

from veduta.facade.cleared import BEFORE
from veduta.facade.label_pictures import set_labels_apart
from veduta.facade.load import DOCUMENT, MAX_BYTES, PHOTO
from veduta.imaging.read import MAX_FILE_BYTES, SUFFIXES
from veduta.run.digests import input_digest
from veduta.run.edited import refuse_other_json
from veduta.run.errors import InputError
from veduta.run.names import real_path

Kind = Literal["photo", "document"]
RESERVED = {"place.json", "report.json", "report.html"}
"""Names that OUT itself uses."""
_OTHER_JSON = {
    "place.json": "says where the buildings of a place stand",
    "report.json": "says how the work went",
    "model.city.json": "is a model that was made from a document",
}
"""Files of OUT that somebody may take for a facade's document."""
_UNUSABLE = re.compile(r"[\x00-\x1f\\:]|^[.\s]|[.\s]$")
_MAX_NAME = 200


@dataclass(frozen=True)
class Input:
    """One photo or document; its results go to the folder `name` in OUT."""

    name: str
    path: Path
    kind: Kind
    digests: tuple[str, ...]

    @property
    def identity(self) -> JsonValue:
        """What a key is made of: the content, and the name that is written into the result."""
        return [self.name, self.path.name, *self.digests]


@dataclass(frozen=True)
class Call:
    """All inputs of one call, of one kind, with different names."""

    kind: Kind
    inputs: tuple[Input, ...]
    left_out: tuple[Path, ...] = ()
    """Pictures of labels that lie between the photos of a folder."""


def plan_call(paths: Sequence[Path]) -> Call:
    """The inputs in the order given; a folder stands for the images in it, by name."""
    found = [_files(path) for path in paths]
    files = _each_once([file for photos, _ in found for file in photos])
    left_out = _each_once([file for _, labels in found for file in labels])
    if not files:
        raise InputError("IMAGE", "no image is named", "Name at least one photo.")
    kinds = {path: _kind(path) for path in files}
    if len(set(kinds.values())) > 1:
        document = next(path for path in files if kinds[path] == "document")
        raise InputError(
            document, "is a document between photos", "Give photos or documents, not both at once."
        )
    _refuse_same_names(files)
    for path in files:
        refuse_other_json(path, _OTHER_JSON, "a facade", _document_meant)
    inputs = tuple(Input(_name(path), path, kinds[path], _digests(path)) for path in files)
    return Call(inputs[0].kind, inputs, tuple(file for file in left_out if file not in files))


def _files(path: Path) -> tuple[list[Path], list[Path]]:
    """The files that a path stands for, and the pictures of labels between them."""
    if not os.path.isdir(path):  # `Path.is_dir` raises where it may not look
        return [path], []
    try:
        images = sorted(
            file for file in path.iterdir() if file.suffix.lower() in SUFFIXES and file.is_file()
        )
    except OSError as error:
        raise _unreadable(path, error) from error
    if not images:
        wanted = ", ".join(SUFFIXES)
        raise InputError(path, f"is a folder without images ({wanted})", "Name another folder.")
    return set_labels_apart(images)


def _each_once(files: list[Path]) -> list[Path]:
    # `Path.resolve` raises RuntimeError at a link to itself.
    return list({real_path(file): file for file in reversed(files)}.values())[::-1]


def _kind(path: Path) -> Kind:
    return "document" if path.suffix.lower() == ".json" else "photo"


def _name(path: Path) -> str:
    """The image's stem; for `OUT/x/facade.json` it is `x`, as it was for the image."""
    if path.name == DOCUMENT:
        return real_path(path).parent.name
    return path.stem


def _refuse_same_names(files: list[Path]) -> None:
    seen: dict[str, Path] = {}
    for path in files:
        name = _name(path)
        if not name or name in RESERVED or _UNUSABLE.search(name) or len(name) > _MAX_NAME:
            raise InputError(path, f"{name!r} cannot name a result folder", "Rename the image.")
        if name in seen:
            raise InputError(
                path,
                f"has the same name as {seen[name]}: the results of both would be in {name}/",
                f"Name one of them, for instance by {seen[name].with_stem('*')}, or rename it."
                if path.with_suffix("") == seen[name].with_suffix("")
                else "Rename one of them, or make two calls.",
            )
        seen[name] = path


def _document_meant(path: Path) -> str:
    """Which file is the document that is meant, as far as one lies there."""
    beside = path.with_name(DOCUMENT)
    known = [beside] if beside.exists() else sorted(path.parent.glob(f"*/{DOCUMENT}"))
    if not known:
        return f"Give the {DOCUMENT} of a building."
    which = "one of its buildings, such as" if known[1:] else "its building:"
    return f"Give the document of {which} {known[0]}"


def _digests(path: Path) -> tuple[str, ...]:
    """The digest of the file, and for a document that of the photo beside it."""
    if _kind(path) == "photo":
        return (input_digest(path, MAX_FILE_BYTES),)
    beside = f"It must lie beside {path.name} as it was written."
    pictures = [path.with_name(PHOTO)]
    pictures += [path.with_name(BEFORE)] if path.with_name(BEFORE).is_file() else []
    return (
        input_digest(path, MAX_BYTES),
        *(input_digest(picture, MAX_FILE_BYTES, beside) for picture in pictures),
    )


def _unreadable(path: Path, error: OSError) -> InputError:
    return InputError(path, f"cannot be read ({error.strerror})", "Check its permissions.")
