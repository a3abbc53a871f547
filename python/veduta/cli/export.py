"""`veduta export`: write a place in a form that others can use."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from veduta.cli.export_call import ExportCall
    from veduta.place.place import Place
    from veduta.place.registry import PlaceFormat

SUMMARY = "Write a place in another format, or as a folder that any web server can show"


def run(argv: list[str]) -> int:
    """Parse the arguments and write the export; returns the exit code."""
    from veduta.cli.arguments import parse
    from veduta.cli.export_call import ExportCall
    from veduta.run.errors import InputError

    call = parse(ExportCall, "veduta export", argv)
    if call.to == "list":
        _tell_formats()
        return 0
    given = [call.file is not None, call.to is not None, call.web is not None]
    if sum(given) != 1:
        fault = "nothing says what to write" if not any(given) else "asks for several things"
        raise InputError(
            "veduta export",
            fault,
            "Give one of: a FILE, `--to NAME,... -o FOLDER`, `--web DIR`.",
        )
    if (call.to is None) != (call.folder is None):
        raise InputError("--to and -o", "go together", "Write `--to obj,stl -o FOLDER`.")
    if call.web is None and call.card != type(call.card)():
        raise InputError(
            "--picture and --address", "are for the card of a web page", "Give --web DIR with them."
        )
    return _web(call, call.web) if call.web is not None else _files(call)


def _files(call: ExportCall) -> int:
    """Write the place as one file or several."""
    from veduta.place.registry import format_named, format_of
    from veduta.run.errors import InputError
    from veduta.run.names import real_path
    from veduta.studio.content import place_folder

    targets: list[tuple[PlaceFormat, Path]] = []
    if call.file is not None:
        targets.append((format_of(call.file), call.file))
    folder = call.folder
    if call.to is not None and folder is not None:
        stem = real_path(call.out).name or "place"
        for name in call.to.split(","):
            one = format_named(name.strip())
            targets.append((one, folder / f"{stem}{one.suffix}"))
        if folder.exists() and not folder.is_dir():
            raise InputError(folder, "is a file", "Name a folder.")
    place_folder(call.out, "export")
    for _, target in targets:
        if target.is_dir():
            raise InputError(target, "is a folder", "Name a file.")
        if target.exists() and not call.force:
            raise InputError(target, "is there already", "Use --force, or choose another name.")
    _write(call, targets)
    return 0


def _write(call: ExportCall, targets: list[tuple[PlaceFormat, Path]]) -> None:
    """Make all files in a folder beside the targets, and move them when none is in the way."""
    import tempfile

    from veduta.place.holding import left_out_of, require_held
    from veduta.run.errors import InputError, UnwritableError

    place = _told(call)
    for one, target in targets:
        require_held(place, one, target)
    folder = targets[0][1].parent
    if call.folder is None and not folder.is_dir():
        raise InputError(folder, "there is no such folder", "Make it first.")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=".export.", suffix=".tmp", dir=folder) as name:
            for _, target in targets:
                _make(place, call.out, Path(name) / target.name, target)
            _move(Path(name), targets, force=call.force)
    except OSError as error:
        fault = f"cannot be written ({error.strerror})"
        subject = targets[0][1] if len(targets) == 1 else folder
        raise UnwritableError(subject, fault, "Choose another place.") from error
    for one, target in targets:
        print(f"{target}: {one.title}, {target.stat().st_size / 1e6:.1f} MB")
        lacking = left_out_of(place, one)
        if lacking:
            print(f"  not in it, as the format has no word for them: {', '.join(lacking)}")


def _told(call: ExportCall) -> Place:
    """The place, with the words that were given."""
    from veduta.place.place import Place

    told = Place.load(call.out)
    place = told.untiled()
    if place is not told:
        print(
            "its buildings are those of its city model, without pictures and without the ground"
            " between lots: tiles hold many of them in one. Derive it with --separate to keep both."
        )
    for note in place.notes:
        print(f"note: {note}")
    for name, words in call.about.given().items():
        setattr(place, name, words)
    return place


def _make(place: Place, out: Path, made: Path, target: Path) -> None:
    """Write the place to `made`; errors name the target."""
    from veduta.place.flatten import TooManyTrianglesError
    from veduta.run.errors import InputError

    try:
        place.write(made)
    except TooManyTrianglesError as error:
        raise InputError(out, str(error), "Write .glb, which has them once each.") from error
    except InputError as error:
        if str(error.subject) != str(made):
            raise
        raise InputError(target, error.fault, error.remedy) from error


def _move(work: Path, targets: list[tuple[PlaceFormat, Path]], *, force: bool) -> None:
    """What was made to where it belongs: what a target needs beside it first."""
    from veduta.run.errors import InputError

    named = [target.name for _, target in targets]
    folder = targets[0][1].parent
    made = sorted(work.iterdir(), key=lambda file: (file.name in named, file.name))
    for file in made:
        there = folder / file.name
        if there.is_dir():
            raise InputError(there, "is a folder", "Move it away, or choose another name.")
        if there.exists() and not force:
            raise InputError(there, "is there already", "Use --force, or choose another name.")
    for file in made:
        file.replace(folder / file.name)


def _web(call: ExportCall, web: Path) -> int:
    from veduta.studio.export import export_web

    result = export_web(call.out, web, about=call.about, card=call.card, force=call.force)
    if result.card is not None and result.card.is_small:
        width, height = result.card.size_px
        print(f"the card of a link is {width} x {height} px, no larger than --picture")
    if result.written:
        print(f"{web}: {result.files} files, {result.size_bytes / 1e6:.1f} MB")
    else:
        print(f"{web}: up to date")
    print(f"To look at it: python3 -m http.server --directory {web} 8000")
    return 0


def _tell_formats() -> None:
    from veduta.place.registry import formats

    for suffix, one in formats().items():
        print(f"{one.name:<12}{suffix:<14}{one.title}")
