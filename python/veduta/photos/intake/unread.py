"""What lies in the folder and is no photo that is read: each file is named, with the reason."""

from __future__ import annotations

from pathlib import Path

from veduta.imaging.heic import HEIC_SUFFIXES
from veduta.imaging.read import SUFFIXES
from veduta.photos.intake.given import Given
from veduta.run.errors import InputError
from veduta.run.names import real_path

POSITIONS = "geo.txt"
"""As OpenDroneMap calls a file of positions."""
_RAW = (
    *(".cr2", ".cr3", ".crw", ".nef", ".nrw", ".arw", ".srf", ".sr2", ".dng", ".orf", ".rw2"),
    *(".raf", ".pef", ".srw", ".x3f", ".3fr", ".iiq", ".mrw", ".raw", ".erf", ".kdc"),
)
_OTHER = (".bmp", ".gif", ".avif", ".jxl", ".jp2", ".j2k", ".psd", ".exr", ".hdr", ".tga", ".ppm")
_TWO_EYES = (".insp",)
"""Two pictures of fisheyes in one JPEG, as cameras of panoramas write them."""
_FILMS = (".mp4", ".mov", ".avi", ".mkv", ".webm", ".mpg", ".mpeg", ".m4v")


def photo_suffixes() -> tuple[str, ...]:
    """Of files that are read as photos."""
    return (*SUFFIXES, *HEIC_SUFFIXES)


def why_unread(path: Path) -> str:
    """Why a picture is not read; empty where it is read, or none."""
    suffix = path.suffix.lower()
    if suffix in photo_suffixes():
        return ""
    if suffix in _RAW:
        return "is a raw photo, which is not read: develop it, and save it as JPEG or TIFF"
    if suffix in _OTHER:
        kind = suffix.removeprefix(".").upper()
        return f"is a {kind} picture, which is not read: save it as JPEG, PNG or TIFF"
    if suffix in _TWO_EYES:
        return "holds the pictures of two fisheyes: export it as one panorama (JPEG)"
    return ""


def unread_files(folder: Path, given: Given) -> tuple[tuple[tuple[str, str], ...], tuple[str, ...]]:
    """Pictures of the folder that are not read, as (name, reason), and notes on all other files and
    on folders with photos.

    What the call names itself, and hidden files, are not told.
    """
    try:
        entries = sorted(folder.iterdir())
        paths = [path for path in entries if path.is_file()]
    except OSError as error:
        fault = f"cannot be read ({error.strerror})"
        raise InputError(folder, fault, "Check its permissions.") from error
    own = (given.video, given.from_colmap, given.masks, *given.named)
    named = {real_path(path) for path in own if path is not None}
    seen = [path for path in paths if not path.name.startswith(".")]
    unread = tuple((path.name, why) for path in seen if (why := why_unread(path)))
    known = {name for name, _ in unread}
    others = [
        path
        for path in seen
        if path.name not in known
        and path.suffix.lower() not in photo_suffixes()
        and real_path(path) not in named
    ]
    films = [path.name for path in others if path.suffix.lower() in _FILMS]
    notes = [f"{name}: is a film; give it with --video to use its frames" for name in films]
    rest = [path.name for path in others if path.name not in films]
    if POSITIONS in rest:
        notes.append(f"{POSITIONS}: give it with --positions to use the positions in it")
        rest.remove(POSITIONS)
    if rest:
        notes.append(f"no photos, not used: {', '.join(rest)}")
    inner = [path for path in entries if path.is_dir() and not path.name.startswith(".")]
    notes += [
        f"{path.name}/ has {count} photos, which are not used: give it, or those of all cameras by"
        " --rig"
        for path in inner
        if real_path(path) not in named and (count := _photos_in(path))
    ]
    return unread, tuple(notes)


def _photos_in(folder: Path) -> int:
    """How many photos lie in a folder; 0 where it cannot be read."""
    try:
        return sum(path.suffix.lower() in photo_suffixes() for path in folder.iterdir())
    except OSError:
        return 0
