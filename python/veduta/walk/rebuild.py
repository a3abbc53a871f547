"""A walk again from its edited `walk.json`: order, kinds and places of what was found before."""

from __future__ import annotations

from pathlib import Path

from veduta.place.manifest import Walk, WalkKey, WalkTransition
from veduta.place.place import Place
from veduta.run.digests import file_digest
from veduta.run.errors import InputError
from veduta.run.names import real_path
from veduta.run.options import Options
from veduta.run.page import Table
from veduta.run.progress import Progress
from veduta.run.verb import VerbCall, VerbResult, run_verb
from veduta.run.work import Work
from veduta.walk.document.load import DOCUMENT, read_document
from veduta.walk.document.schema import TransitionRecord, WalkDocument

VERSION = "1"
PLACE = "place.json"
FILM = "walk.mp4"
Models = tuple[str, str]


def run_rebuild(
    document: Path, out: Path, progress: Progress, *, force: bool = False
) -> VerbResult:
    """Make the walk that a `walk.json` says, of the pictures and models beside it, into OUT.

    InputError where the document names what is not there.
    """
    said = read_document(document)
    folder = real_path(document).parent
    place = Place.load(folder)
    if not place.walks:
        raise InputError(folder / PLACE, "holds no walk", "Make it again with `veduta walk`.")
    before = place.walks[0]
    walk = rebuilt(document, said, before)
    in_place = real_path(out) == folder
    inputs = [file_digest(document)]
    if not in_place:
        inputs.append(file_digest(folder / PLACE))
    call = VerbCall("walk (rebuild)", VERSION, folder.name, Options(), [*inputs], in_place=in_place)

    def make(work: Work) -> None:
        with work.step("rebuild") as step:
            place.walks[0] = walk
            place.save(work.folder)
            (work.folder / DOCUMENT).write_bytes(document.read_bytes())
            step.counts["key positions"] = len(walk.keys)
            step.counts["transitions"] = len(walk.transitions)
        if _is_moved(before, walk):
            work.doubt("key positions were moved, but not the points seen from outside")
        _tell(work, walk, film=(folder / FILM).is_file())

    return run_verb(call, out, make, progress, force=force)


def rebuilt(path: Path, said: WalkDocument, before: Walk) -> Walk:
    """The walk of a document. before: that of the place, which has the pictures and models."""
    pictures = {key.id: key for key in before.keys}
    keys: list[WalkKey] = []
    for key in said.keys:
        if key.id not in pictures:
            raise InputError(
                path, f"key position {key.id} has no picture in {PLACE}",
                "Take it away, or run `veduta walk` again over its pictures.",
            )  # fmt: skip
        keys.append(pictures[key.id].model_copy(update={"transform": key.transform}))
    numbers = {key.id: number for number, key in enumerate(keys)}
    if len(numbers) != len(keys):
        raise InputError(path, "names a key position twice", "Name each once.")
    transitions = [_transition(path, one, numbers, _models(said)) for one in said.transitions]
    return before.model_copy(update={"keys": keys, "transitions": transitions})


def _is_moved(before: Walk, walk: Walk) -> bool:
    places = {key.id: key.transform for key in before.keys}
    return any(key.transform != places[key.id] for key in walk.keys)


def _models(said: WalkDocument) -> dict[tuple[str, str], Models]:
    """The models of both ends, by the ends; the way back has them exchanged."""
    found = {}
    for one in said.transitions:
        if one.forth is not None and one.back is not None:
            found[one.start, one.end] = (one.forth, one.back)
            found.setdefault((one.end, one.start), (one.back, one.forth))
    return found


def _transition(
    path: Path, said: TransitionRecord, numbers: dict[str, int],
    models: dict[tuple[str, str], Models],
) -> WalkTransition:  # fmt: skip
    ends = {"start": numbers[said.start], "end": numbers[said.end]}
    if said.kind != "morph":
        return WalkTransition(**ends, kind=said.kind, score_db=said.score_db)
    found = models.get((said.start, said.end))
    for name in found or ():
        if not (path.parent / name).is_file():
            raise InputError(path.parent / name, "is not there", "Run `veduta walk` again.")
    if found is None:
        raise InputError(
            path, f"the transition from {said.start} to {said.end} has no models to morph",
            "Make it a fade or a cut, or run `veduta walk` again with --links"
            f" {said.start}:{said.end}.",
        )  # fmt: skip
    return WalkTransition(
        **ends, kind="morph", forth=found[0], back=found[1], score_db=said.score_db
    )


def _tell(work: Work, walk: Walk, *, film: bool) -> None:
    kinds = [one.kind for one in walk.transitions]
    work.measure("key_positions", len(walk.keys))
    for kind in ("morph", "fade", "cut"):
        work.measure(f"transitions_{kind}", kinds.count(kind))
    if film:
        work.doubt(f"{FILM} is of the walk before: it is not made again")
    names = [f"{walk.keys[one.start].id} to {walk.keys[one.end].id}" for one in walk.transitions]
    rows = [
        [name, one.kind, one.score_db] for name, one in zip(names, walk.transitions, strict=True)
    ]
    work.table(Table("Transitions", ["from, to", "kind", "predicted dB"], rows))
    work.file(DOCUMENT, "the document that the walk follows")
    work.file(PLACE, "the place that `veduta view` shows")
    work.summary = (
        f"{len(walk.keys)} key positions: {kinds.count('morph')} transitions morph,"
        f" {kinds.count('fade')} cross-fade, {kinds.count('cut')} are cut"
    )
