"""What a call is asked to do: the files that may be photos and what else is given, not read yet."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from pydantic import JsonValue

from veduta.formats.colmap_folder import ModelFiles, models_in
from veduta.imaging.read import MAX_FILE_BYTES
from veduta.photos.intake.given import NOTHING_ELSE, Given
from veduta.photos.intake.masks import Mask, masks_in, read_mask, with_masks
from veduta.photos.intake.rig import (
    LARGEST_FILE,
    RIG_FILE,
    RigFile,
    camera_folders,
    mounted,
    read_rig_file,
)
from veduta.photos.intake.source import Source
from veduta.photos.intake.unread import photo_suffixes, unread_files, why_unread
from veduta.photos.intake.video import Video, video_of
from veduta.run.digests import input_digest
from veduta.run.errors import InputError

MOST_PHOTOS = 20_000
_ADD = "Put at least two photos of the same place into it (JPEG, PNG, TIFF, WebP)."


@dataclass(frozen=True)
class Call:
    """The photos of a folder in the order of their names.

    folder: what the results are named after; the film where there is no folder.
    copies: files with the content of an earlier one, as (name, name of the earlier one).
    unreadable: files that the system does not let us read, as (name, reason).
    unread: pictures that are not read, as (name, reason).
    models: the components of a COLMAP model to start from. rig: what a file says of the rig that
    took the photos. notes: what else is to be told.
    """

    folder: Path
    sources: tuple[Source, ...]
    copies: tuple[tuple[str, str], ...] = ()
    unreadable: tuple[tuple[str, str], ...] = ()
    masks: tuple[Mask, ...] = ()
    unread: tuple[tuple[str, str], ...] = ()
    video: Video | None = None
    models: tuple[ModelFiles, ...] = ()
    rig: RigFile | None = None
    notes: tuple[str, ...] = ()

    def inputs(self) -> JsonValue:
        """What the result depends on: names and digests."""
        photos: list[JsonValue] = [[source.name, source.sha256] for source in self.sources]
        set_aside = (*self.copies, *self.unreadable, *self.unread)
        aside: list[JsonValue] = [list(pair) for pair in set_aside]
        masks: list[JsonValue] = [[mask.path.name, mask.sha256] for mask in self.masks]
        video: JsonValue = None if self.video is None else [self.video.name, self.video.sha256]
        models: list[JsonValue] = [list(model.sha256) for model in self.models]
        rig: list[JsonValue] = [] if self.rig is None else [self.rig.sha256]
        return [photos, aside, masks, video, models, *rig]


def plan_call(folder: Path | None, given: Given = NOTHING_ELSE, *, rig: bool = False) -> Call:
    """The photos in a folder, not in folders below it; InputError where there are not two.

    rig: they are in folders below it, one for each camera of a rig.
    """
    _require_sense(folder, given)
    if rig:
        return _of_a_rig(folder, given)
    video = video_of(given.video) if given.video else None
    models = models_in(given.from_colmap) if given.from_colmap else ()
    masks = masks_in(given.masks) if given.masks else ()
    if video is not None:
        _require_sizes(masks, video)
    if folder is None:
        return Call(given.video or Path(), (), masks=masks, video=video)
    sources, copies, unreadable, files = _found(folder)
    if len(sources) < 2 and video is None:
        raise InputError(folder, _too_few(files, len(sources)), _what_to_do(folder, files))
    taken, notes = (sources, ()) if video else with_masks(sources, masks)
    unread, other = unread_files(folder, given)
    notes = (*notes, *other)
    return Call(
        folder,
        taken,
        copies,
        unreadable,
        masks,
        unread=unread,
        video=video,
        models=models,
        notes=notes,
    )


def _of_a_rig(folder: Path | None, given: Given) -> Call:
    """The photos in the folders of a rig's cameras, called FOLDER/NAME."""
    for name, file in (
        ("--video", given.video),
        ("--from-colmap", given.from_colmap),
        ("--masks", given.masks),
    ):
        if file is not None:
            remedy = "Leave one of the two out."
            raise InputError(name, "has no use with --rig, which takes photos alone", remedy)
    if folder is None:
        raise InputError("DIR", "is not given", "Name the folder that has one for each camera.")
    sources: list[Source] = []
    copies: list[tuple[str, str]] = []
    unreadable: list[tuple[str, str]] = []
    unread: list[tuple[str, str]] = []
    aside_notes: list[str] = []
    inner = _camera_folders(folder)
    for one in inner:
        # Two cameras that see nothing may have the same picture.
        found = _found(one, f"{one.name}/", {})
        sources += found[0]
        copies += found[1]
        unreadable += found[2]
        own, told_of = unread_files(one, given)
        unread += [(f"{one.name}/{name}", why) for name, why in own]
        aside_notes += [f"{one.name}: {note}" for note in told_of]
    taken, notes = mounted(folder, sources)
    path = folder / RIG_FILE
    told = None
    if path.exists():
        told = read_rig_file(path, input_digest(path, LARGEST_FILE), [one.name for one in inner])
    why = "lies beside the cameras' folders"
    unread += [(one.name, why) for one in _paths(folder)]
    notes = (*notes, *aside_notes)
    aside = (tuple(copies), tuple(unreadable))
    return Call(folder, taken, *aside, unread=tuple(unread), rig=told, notes=notes)


def _camera_folders(folder: Path) -> list[Path]:
    _paths(folder)
    return camera_folders(folder, frozenset(photo_suffixes()))


def _require_sense(folder: Path | None, given: Given) -> None:
    if folder is None and given.video is None:
        raise InputError("DIR", "is not given", "Name a folder of photos, or a film with --video.")
    if given.from_colmap is None:
        return
    if folder is None or given.video is not None:
        remedy = "Give the photos that the model was made of as DIR, and no --video."
        raise InputError("--from-colmap", "takes photos, not a film", remedy)
    if given.masks is not None:
        remedy = "Leave out --masks: nothing is looked for where a model is given."
        raise InputError("--masks", "has no use with --from-colmap", remedy)


def _require_sizes(masks: Sequence[Mask], video: Video) -> None:
    """InputError for a mask of another size than the frames: said before the film is read."""
    for mask in masks:
        frame = f"{mask.path.stem.lower().removesuffix('.jpg')}.jpg"
        if video.is_frame_name(frame):
            read_mask(mask.path, frame, video.size_px)


_Pairs = tuple[tuple[str, str], ...]


def _found(
    folder: Path, prefix: str = "", known: dict[str, str] | None = None
) -> tuple[tuple[Source, ...], _Pairs, _Pairs, int]:
    """Sources, copies, unreadable files, and how many files there are in all.

    prefix: of their names. known: names of files that were found elsewhere, by their digests.
    """
    sources: list[Source] = []
    known = {} if known is None else known
    copies: list[tuple[str, str]] = []
    unreadable: list[tuple[str, str]] = []
    paths = _paths(folder)
    for path in paths:
        name = prefix + path.name
        try:
            digest = input_digest(path, MAX_FILE_BYTES)
        except InputError as error:
            unreadable.append((name, error.fault))
            continue
        first = known.setdefault(digest, name)
        if first != name:
            copies.append((name, first))
        else:
            sources.append(Source(name, path, digest))
    return tuple(sources), tuple(copies), tuple(unreadable), len(paths)


def _paths(folder: Path) -> list[Path]:
    if not folder.exists():
        raise InputError(folder, "does not exist", "Name a folder of photos.")
    if not folder.is_dir():
        raise InputError(folder, "is a file, not a folder", "Name the folder that it lies in.")
    try:
        found = sorted(
            path
            for path in folder.iterdir()
            if path.suffix.lower() in photo_suffixes() and not path.name.startswith(".")
        )
    except OSError as error:
        fault = f"cannot be read ({error.strerror})"
        raise InputError(folder, fault, "Check its permissions.") from error
    if len(found) > MOST_PHOTOS:
        fault = f"holds {len(found)} photos, more than {MOST_PHOTOS}"
        raise InputError(folder, fault, "Divide them into several folders.")
    return found


def _what_to_do(folder: Path, files: int) -> str:
    """What to do about a folder without photos: where some may lie instead, if anywhere."""
    if files:
        return _ADD
    try:
        there = sorted(folder.iterdir())[:MOST_PHOTOS]
        inner = [path for path in there if path.is_dir() and _holds_photos(path)]
    except OSError:  # of a folder in it
        return _ADD
    if inner:
        others = f" ({len(inner)} folders in it hold photos)" if len(inner) > 1 else ""
        rig = ", or say --rig if each is of one camera of a rig" if len(inner) > 1 else ""
        return (
            f"Name {inner[0]}, which holds some{others}: folders in folders are not looked into"
            f"{rig}."
        )
    foreign = [path.name for path in there if why_unread(path)]
    if foreign:
        return f"Save {foreign[0]} and the others as JPEG, PNG, TIFF or WebP."
    return _ADD


def _holds_photos(folder: Path) -> bool:
    return any(path.suffix.lower() in photo_suffixes() for path in folder.iterdir())


def _too_few(files: int, usable: int) -> str:
    if not files:
        return "holds no photos"
    if usable == 0:
        return "holds no photo that can be read"
    return "holds one photo" if files == 1 else "holds one photo, if copies are counted once"
