"""Exporting a place as a folder of static files: the studio, `place.json` and the parts.

What is in the folder is recorded with digests in `veduta-web.json`. A file that is not in the
record, or differs from it, is the user's: the folder is then never replaced, not even with
`force`. The folder appears whole or not at all. The words of the place stand in the head of its page.
"""

from __future__ import annotations

import json
import os
import shutil
import tempfile
from dataclasses import dataclass
from pathlib import Path

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from veduta.formats.place_json import manifest_bytes, read_place
from veduta.place.about import AboutOptions
from veduta.run.atomic import atomic_folder, write_bytes
from veduta.run.digests import bytes_digest, file_digest
from veduta.run.errors import InputError
from veduta.studio.card import (
    CARD,
    CardOptions,
    CardPicture,
    card_picture,
    checked_address,
    page_of,
)
from veduta.studio.content import MANIFEST, place_folder, studio_folder
from veduta.studio.parts import part_files

RECORD = "veduta-web.json"
PAGE = "index.html"
# How many foreign files a message names.
_NAMED = 5


class WebRecord(BaseModel):
    """What an export wrote: path in the folder and SHA-256 of each file."""

    model_config = ConfigDict(extra="forbid", populate_by_name=True)

    schema_: str = Field(default="veduta/web", alias="schema")
    version: int = 1
    files: dict[str, str]


@dataclass(frozen=True)
class ExportResult:
    """`written` is False where the folder was up to date; the card is None without a picture."""

    written: bool
    files: int
    size_bytes: int
    card: CardPicture | None = None


def export_web(
    out: Path,
    web: Path,
    *,
    about: AboutOptions | None = None,
    card: CardOptions | None = None,
    force: bool = False,
) -> ExportResult:
    """Write the place in `out` to the folder `web`; raises InputError where that may not be.

    about: words that take the place of those in `place.json`. card: what a link to it is shown with.
    """
    place = place_folder(out, "export")
    asked = card or CardOptions()
    picture = None if asked.picture is None else card_picture(asked.picture)
    said = _said(studio_folder(), place, about or AboutOptions(), picture, asked.address)
    sources = _sources(studio_folder(), place, said)
    record = WebRecord(files={name: _digest(source) for name, source in sources.items()})
    target = _resolved_target(web, place)
    earlier = _earlier(target)
    size = sum(
        len(source) if isinstance(source, bytes) else source.stat().st_size
        for source in sources.values()
    )
    if earlier == record:
        return ExportResult(False, len(sources), size, picture)
    if earlier is not None and not force:
        raise InputError(
            web,
            "it holds an export of another place, or of this one before it changed",
            "Use --force to replace it, or another folder.",
        )
    _write(sources, record, target)
    return ExportResult(True, len(sources), size, picture)


def _said(
    static: Path, place: Path, about: AboutOptions, picture: CardPicture | None, at: str | None
) -> dict[str, bytes]:
    """The files that are written for this export: the page, its card, and the manifest."""
    told = read_place(place / MANIFEST).model_copy(update=about.given())
    made: dict[str, bytes] = {}
    if about.given():
        made[MANIFEST] = manifest_bytes(told)
    if picture is not None:
        made[CARD] = picture.content
    address = None if at is None else checked_address(at)
    page = (static / PAGE).read_text(encoding="utf-8")
    made[PAGE] = page_of(page, told, address=address, picture=picture).encode()
    return made


def _digest(source: Path | bytes) -> str:
    return bytes_digest(source) if isinstance(source, bytes) else file_digest(source)


def _sources(static: Path, place: Path, said: dict[str, bytes]) -> dict[str, Path | bytes]:
    """Every file of the export: its path in the folder, and where it comes from or its content."""
    studio = {
        path.relative_to(static).as_posix(): path
        for path in sorted(static.rglob("*"))
        if path.is_file()
    }
    files = {MANIFEST: place / MANIFEST, **part_files(place)}
    for name in files:
        if name in studio or name in (RECORD, CARD):
            raise InputError(
                place / MANIFEST,
                f'a part is named "{name}", which is a file of the studio',
                "Give the part another name.",
            )
    return studio | files | said


def _resolved_target(web: Path, place: Path) -> Path:
    target = web.resolve()
    if target == place or target in place.parents or place in target.parents:
        raise InputError(
            web,
            "the export and the place would lie in one another",
            "Choose a folder beside the place.",
        )
    if not target.parent.is_dir():
        raise InputError(
            target.parent, "there is no such folder", "Make it first, or choose another place."
        )
    if not os.access(target.parent, os.W_OK):
        raise InputError(target.parent, "this user may not write there", "Choose another folder.")
    return target


def _earlier(target: Path) -> WebRecord | None:
    """The record of an untouched earlier export; None where the folder is new or empty."""
    if not target.exists():
        return None
    if not target.is_dir():
        raise InputError(target, "it is a file", "Name a folder.")
    if not any(target.iterdir()):
        return None
    record = _read_record(target)
    if record is None:
        raise InputError(
            target,
            "it is not empty, and `veduta export` did not write it",
            "Choose another folder, or empty this one.",
        )
    foreign = _foreign_files(target, record)
    if foreign:
        more = f" and {len(foreign) - _NAMED} more" if len(foreign) > _NAMED else ""
        raise InputError(
            target,
            f"it holds files of yours: {', '.join(foreign[:_NAMED])}{more}",
            "Move them away, or choose another folder; Veduta does not replace them.",
        )
    return record


def _read_record(target: Path) -> WebRecord | None:
    try:
        return WebRecord.model_validate_json((target / RECORD).read_bytes())
    except (FileNotFoundError, ValidationError):
        return None


def _foreign_files(target: Path, record: WebRecord) -> list[str]:
    """Files that are not in the record, or no longer what it says."""
    foreign = []
    for path in sorted(target.rglob("*")):
        name = path.relative_to(target).as_posix()
        if name == RECORD or (path.is_dir() and not path.is_symlink()):
            continue
        if path.is_symlink() or record.files.get(name) != file_digest(path):
            foreign.append(name)
    return foreign


def _write(sources: dict[str, Path | bytes], record: WebRecord, target: Path) -> None:
    """Write beside the target, then put the whole in its place."""
    # A full export cannot be renamed over a folder that has files: set that one aside first.
    aside = _set_aside(target)
    try:
        with atomic_folder(target) as temporary:
            for name, source in sources.items():
                copy = temporary / name
                copy.parent.mkdir(parents=True, exist_ok=True)
                if isinstance(source, bytes):
                    write_bytes(copy, source)
                else:
                    shutil.copyfile(source, copy)
            content = json.dumps(record.model_dump(by_alias=True), indent=1) + "\n"
            write_bytes(temporary / RECORD, content.encode())
    except BaseException:
        if aside is not None:
            aside.rename(target)
        raise
    if aside is not None:
        shutil.rmtree(aside)


def _set_aside(target: Path) -> Path | None:
    if not target.exists():
        return None
    aside = Path(tempfile.mkdtemp(prefix=f".{target.name}.", suffix=".old", dir=target.parent))
    os.replace(target, aside)
    return aside
