"""`veduta fauna`: footage, midlines or a document become an animal in a place."""

from __future__ import annotations

from pathlib import Path

from pydantic import JsonValue

from veduta.fauna.build.build import Built, build_animal, goer_of
from veduta.fauna.build.going import Goer, place_of, round_path
from veduta.fauna.build.into_place import place_into
from veduta.fauna.document.coat import COAT, load_coat, save_coat
from veduta.fauna.document.limbed import LimbedAnimal
from veduta.fauna.document.load import DOCUMENT, load_animal, save_animal
from veduta.fauna.document.schema import Animal
from veduta.fauna.limbed_command import make_limbed
from veduta.fauna.limbed_recipe import read_limbed
from veduta.fauna.motion.borrowed import borrowed
from veduta.fauna.options import FaunaOptions
from veduta.fauna.path.terrain import Terrain
from veduta.fauna.path.through import FoundPath
from veduta.fauna.path_command import write_on_path
from veduta.fauna.path_recipe import planned
from veduta.fauna.pictures import gait_picture
from veduta.fauna.recipe import Record, read_record
from veduta.formats.mesh_glb import write_mesh_glb
from veduta.place.material import Texture
from veduta.place.place import Place
from veduta.run.digests import file_digest
from veduta.run.errors import InputError
from veduta.run.names import real_path
from veduta.run.page import Table
from veduta.run.progress import Progress
from veduta.run.verb import VerbCall, VerbResult, run_verb
from veduta.run.work import Work

VERSION = "12"
MODEL = "animal.glb"


def run_fauna(
    record: Record, out: Path, options: FaunaOptions, progress: Progress, *, force: bool = False
) -> VerbResult:
    """Make the animal of a record in OUT; InputError where the record is none."""
    for path in record.files:
        if path is not None and not path.exists():
            raise InputError(path, "there is no such file or folder", "Name what there is.")
    if record.way is not None and record.place is None:
        fault = "says where to go, but not in which place"
        raise InputError(record.way, fault, "Name the place, too (--place).")
    if record.second is not None and record.path.suffix.lower() == ".json":
        fault = "shows how high or wide an animal is, and the document says that already"
        raise InputError(record.second, fault, "Give the footage, or edit the slices.")
    inputs: JsonValue = [None if path is None else _digests(path, out) for path in record.files]
    call = VerbCall(
        command="fauna",
        version=VERSION,
        subject=record.path.stem,
        options=options,
        inputs=inputs,
    )

    def make(work: Work) -> None:
        _make(work, record, options)

    return run_verb(call, out, make, progress, force=force)


def _digests(record: Path, out: Path) -> JsonValue:
    """Of a file, or of all files of a folder but those of OUT, which may lie in it."""
    if record.is_file():
        return [file_digest(record)]
    own = real_path(out)
    files = sorted(
        path for path in record.rglob("*") if path.is_file() and own not in real_path(path).parents
    )
    return [f"{path.relative_to(record)} {file_digest(path)}" for path in files]


def _make(work: Work, record: Record, options: FaunaOptions) -> None:
    animal, coat = _document(work, record, options)
    if record.gaits is not None:
        animal = _with_gaits(animal, record.gaits)
    if isinstance(animal, LimbedAnimal):
        goer = make_limbed(work, animal, coat, options)
    else:
        goer = _limbless(work, animal, coat, options)
    goal: tuple[Place, FoundPath, Terrain] | None = None
    if record.place is not None:
        goal = planned(work, record.place, record.way, goer)
    with work.step("writing"):
        save_animal(animal, work.folder / DOCUMENT)
        if coat is not None:
            save_coat(coat, work.folder / COAT)
            work.file(COAT, "its coat from the footage; half transparent where it is invented")
        write_mesh_glb(goer.mesh, work.folder / MODEL, rigged=True)
        if goal is None:
            place_of(goer).save(work.folder)
        else:
            place, path, _ = goal
            goes = goer.along(path.points_m, closed=path.closed, corners=path.corners)
            place_into(place, goer, goes).save(work.folder)
    if goal is None:
        write_on_path(work, goer, round_path(goer.length_m), None, closed=True)
    else:
        path, terrain = goal[1:]
        write_on_path(
            work, goer, path.points_m, terrain.footing, closed=path.closed, corners=path.corners
        )
    for name, meaning in (
        (MODEL, "the animal with its skeleton and clips (glTF)"),
        (DOCUMENT, "what was found, to edit and to build from again"),
        ("place.json", "the animal on a path, for the studio"),
    ):
        work.file(name, meaning)


def _document(
    work: Work, record: Record, options: FaunaOptions
) -> tuple[Animal | LimbedAnimal, Texture | None]:
    """The animal in the record, and its coat."""
    if record.path.suffix.lower() == ".json":
        with work.step("document"):
            animal = load_animal(record.path)
            worn = animal.coat if isinstance(animal, LimbedAnimal) else animal.body.coat
            return animal, None if worn is None else load_coat(record.path.parent / worn)
    if record.plan is not None or options.animal.limbless is None:
        limbed = read_limbed(work, record, options)
        return limbed.animal, limbed.coat
    marked = record.joints or record.markers
    if marked is not None:
        fault = f"has joints of a body plan, and a {options.animal.kind} is read by its axis alone"
        raise InputError(marked, fault, "Choose --kind quadruped or lizard, or give a --plan.")
    read = read_record(work, record, options)
    return read.described.animal, read.coat


def _with_gaits(animal: Animal | LimbedAnimal, file: Path) -> LimbedAnimal:
    other = load_animal(file)
    if not isinstance(animal, LimbedAnimal) or not isinstance(other, LimbedAnimal):
        whose = "the other one" if isinstance(animal, LimbedAnimal) else "this one"
        fault = f"has gaits for legs, and {whose} has none"
        raise InputError(file, fault, "Give two animals with legs.")
    return borrowed(animal, other, file.name)


def _limbless(work: Work, animal: Animal, coat: Texture | None, options: FaunaOptions) -> Goer:
    with work.step("motion") as step:
        built = build_animal(animal, options.motion, coat)
        step.counts["clips"] = len(built.gaits)
        step.counts["states"] = max(gait.states for gait in built.gaits)
        step.counts["refused states"] = max(gait.refused for gait in built.gaits)
    _tell(work, animal, built)
    return goer_of(animal, built)


def _tell(work: Work, animal: Animal, built: Built) -> None:
    source, motion = animal.source, animal.motion
    for doubt in (*animal.doubts, *built.doubts):
        work.doubt(doubt)
    if source.left_out:
        count = len(source.left_out)
        work.note(f"{count} of {source.frames} frames were left out: the steps say why")
    if animal.body.heights == "measured":
        high = max(piece.half_height for piece in animal.body.slices)
        wide = max(piece.half_width for piece in animal.body.slices)
        work.note(
            f"it is {2.0 * high * animal.length.metres:.2g} m high where it is"
            f" highest, {high / wide:.2g} times its width"
        )
    for gait in built.gaits:
        if gait.states:
            work.picture(
                f"New motion: {gait.name}",
                "a walk through the motion graph along its course; early blue, late red",
                gait_picture(gait),
                wide=True,
            )
    work.table(
        Table(
            "Clips",
            ("clip", "seconds", "stride (m)", "loops", "states in its graph", "threshold"),
            [
                (
                    gait.name, float(gait.times_s[-1]), gait.stride * animal.length.metres,
                    "yes" if gait.loops else "no", gait.states or None, gait.threshold or None,
                )
                for gait in built.gaits
            ],
        )
    )  # fmt: skip
    rows = [
        ("length (m)", animal.length.metres, animal.length.provenance, animal.length.score),
        ("widths", None, animal.body.widths, animal.body.score),
        ("heights", None, animal.body.heights, None),
        ("states of the axis", len(motion.states), motion.provenance, motion.score),
        ("speed (lengths/s)", motion.speed, motion.speed_provenance, None),
    ]
    work.table(Table("What is known", ("what", "value", "from", "score"), rows))
    if built.wave is not None:
        work.measure("wave_hz", built.wave.frequency_hz)
        work.measure("wave_share", built.wave.share)
    work.measure("length_m", animal.length.metres)
    work.measure("speed_lengths_s", motion.speed)
    work.measure("frames_used", source.used)
    work.fact("length", f"{animal.length.metres:.3g} m ({animal.length.provenance})")
    work.fact("frames", f"{source.used} of {source.frames}")
    work.fact("clips", ", ".join(gait.name for gait in built.gaits))
    work.summary = (
        f"A {animal.kind} of {animal.length.metres:.3g} m from {source.used} of {source.frames}"
        f" frames, with the clips {', '.join(gait.name for gait in built.gaits)}"
    )
