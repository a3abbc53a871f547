"""From the files to the components: read, features, match, map, cameras."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import closing
from dataclasses import replace

from pycolmap import Reconstruction

from veduta.photos.cameras.component import Component, finish_component
from veduta.photos.cameras.plausible import absurd, cameras_by_group, focal_lengths
from veduta.photos.intake.call import Call
from veduta.photos.intake.from_colmap import HOW, given_model
from veduta.photos.intake.read import PhotoRecord, ReadPhotos, read_photos, with_focal
from veduta.photos.mapping.at_once import require_focal_lengths
from veduta.photos.mapping.mapping import left_out
from veduta.photos.mapping.one_camera import TOLD, mapped_as_of_one_camera
from veduta.photos.mapping.panorama_rigs import snapped, views_among
from veduta.photos.mapping.rigs import map_with_panoramas, mapped_with_rig
from veduta.photos.mapping.settling import Settled, map_settled
from veduta.photos.matching.features import FeaturesJob, memory_of, run_features
from veduta.photos.matching.match import (
    PairRecord,
    count_keypoints,
    match_pairs,
    read_pairs,
    write_database,
)
from veduta.photos.matching.pairs import Pairs, choose_pairs, retrieved_pairs
from veduta.photos.options import PhotosOptions
from veduta.photos.report import Told
from veduta.photos.stages import Stages
from veduta.photos.structure import Structure, structure_of
from veduta.photos.world.position_file import at_positions
from veduta.run.errors import InputError, NotFoundError
from veduta.run.outputs import writing_to
from veduta.run.pool import Task, run_tasks
from veduta.run.progress import StepProgress, no_progress
from veduta.run.report import counted, timed_step

FEATURES_MEMORY = 6 * 1024**3
"""Bytes that all processes together may use while they look for features."""
_UNSOLVED = "was placed, but no cameras could be found for its component: {}"
_NOTHING_HANGS = (
    "Take photos that overlap by more than half with their neighbours, from places that differ:"
    " turning on the spot shows no depth."
)


def find_components(
    call: Call,
    options: PhotosOptions,
    stages: Stages,
    told: Told,
    progress: StepProgress,
    jobs: int | None,
) -> list[Component]:
    """From the files to the components, that with most photos first."""
    with timed_step(told.steps, "read") as step:
        read = read_photos(call.sources, progress)
        if told.positions is not None:
            at_places, notes = at_positions(read.photos, told.positions)
            read = replace(read, photos=at_places)
            told.notes += notes
        if options.camera.focal_px is not None:
            read = replace(read, photos=with_focal(read.photos, options.camera.focal_px))
        told.photos = read.photos
        told.left += read.set_aside
        step.counts |= {"photos": len(read.photos), "set aside": len(told.left)}
        step.rejected.extend(f"{name}: {reason}" for name, reason in told.left)
        _require_two(call, read)
    if call.models:
        return _given(call, read, told)
    if options.map.mapping == "global":
        require_focal_lengths(read.photos)
    pairs = choose_pairs(read.photos, options.match)
    with timed_step(told.steps, "features") as step:
        _features(read, options, stages, progress, jobs)
    with timed_step(told.steps, "match") as step:
        pairs = _retrieved(pairs, read, options, stages)
        told.how = pairs.how
        told.pairs, told.keypoints = _match(read, pairs, options, stages, progress)
        told.steps[-2].counts["keypoints"] = sum(told.keypoints)
        verified = sum(pair.verified > 0 for pair in told.pairs)
        step.counts |= {"pairs": len(told.pairs), "verified": verified}
    with timed_step(told.steps, "map") as step:
        settled, options = _map(read, options, stages, told, progress)
        settled, told.rig = mapped_with_rig(settled, read.photos, options, stages, progress)
        mapped, told.doubts, told.folded = settled.mapped, settled.dropped, settled.folded
        told.starts = mapped.starts
        step.counts |= {"components": len(mapped.models), "doubtful pairs": len(told.doubts)}
        placed = {image for model in mapped.models for image in model.reg_image_ids()}
        unplaced = left_out(read.photos, placed, told.pairs)
        told.left += unplaced
        step.rejected.extend(f"{name}: {reason}" for name, reason in unplaced)
        if not mapped.models:
            raise NotFoundError("cameras", "no photos hang together", _NOTHING_HANGS)
    with timed_step(told.steps, "cameras") as step:
        grown = _structures(mapped.models, read, options, told)
        components, left = finish_components(grown, read.photos, options, progress)
        told.left += left
        told.notes += [note for component in components for note in component.notes]
        told.alarms += doubtful_focal(components[0], read.photos, options)
        step.rejected.extend(f"{name}: {reason}" for name, reason in left)
        step.counts["kinds tried"] = sum(len(component.lens.tried) for component in components)
    return components


def _structures(
    models: Sequence[Reconstruction], read: ReadPhotos, options: PhotosOptions, told: Told
) -> list[Structure]:
    """The columns of what was mapped, with what is known of lenses and of rigs."""
    names = {photo.image_id: photo.name for photo in read.photos}
    held = told.rig is not None and told.rig.held
    given = options.camera.focal_px is not None
    views = views_among(read.photos)
    found = [structure_of(model, names) for model in models]
    return [snapped(replace(one, rig_held=held, focal_held=given, views=views)) for one in found]


def doubtful_focal(
    first: Component, photos: Sequence[PhotoRecord], options: PhotosOptions
) -> list[str]:
    """What to say of the largest component, which is not left out: there would be nothing."""
    if options.camera.focal_px is not None:
        return []
    why = absurd(first, {photo.image_id: photo for photo in photos}, {})
    if not why:
        return []
    return [f"the place may be out of true: {why}. Add photos, or give --focal-px"]


def finish_components(
    grown: Sequence[Structure],
    photos: Sequence[PhotoRecord],
    options: PhotosOptions,
    progress: StepProgress = no_progress,
) -> tuple[list[Component], list[tuple[str, str]]]:
    """What was mapped, with its cameras, and the photos that fall out, as (name, reason).

    A component whose cameras cannot be found is left out; NotFoundError where all are.
    """
    groups = {photo.image_id: photo.group for photo in photos}
    by_id = {photo.image_id: photo for photo in photos}
    components: list[Component] = []
    left: list[tuple[str, str]] = []
    faults: list[NotFoundError] = []
    for number, structure in enumerate(grown):
        progress("cameras", number / len(grown))
        try:
            shared = _sharing(components, structure, groups)
            seed = options.random.seed
            component = finish_component(structure, options.camera, groups, seed, shared)
        except NotFoundError as error:
            faults.append(error)
            left += [(name, _UNSOLVED.format(error.evidence)) for name in structure.names]
            continue
        larger = {} if not components else focal_lengths(components[0], groups)
        why = absurd(component, by_id, larger) if components else ""
        if why:
            left += [(name, _UNSOLVED.format(why)) for name in structure.names]
            continue
        left += component.left
        components.append(component)
    if not components:
        raise faults[0]
    return components, left


def _sharing(
    components: Sequence[Component], structure: Structure, groups: Mapping[int, int]
) -> Component | None:
    """The largest component, where its photos share their cameras with all of these."""
    if not components or components[0].lens.kind.sharing != "shared":
        return None
    known = cameras_by_group(components[0], groups)
    there = all(groups[image] in known for image in structure.image_ids)
    return components[0] if there else None


def _given(call: Call, read: ReadPhotos, told: Told) -> list[Component]:
    """The components of the COLMAP model that is given, in place of all steps to there."""
    with timed_step(told.steps, "given model") as step:
        given = given_model(call.models, read.photos)
        told.how, told.pairs, told.keypoints = HOW, list(given.pairs), list(given.keypoints)
        told.is_given = True
        told.left += given.left
        told.notes += given.notes
        step.counts["components"] = len(given.components)
        step.rejected.extend(f"{name}: {reason}" for name, reason in given.left)
    return list(given.components)


def _require_two(call: Call, read: ReadPhotos) -> None:
    if len(read.photos) < 2:
        raise InputError(
            call.folder,
            f"holds {counted(len(read.photos), 'photo')} that can be used, of {len(call.sources)}"
            + "".join(f"; {name} {reason}" for name, reason in read.set_aside[:3]),
            "Put at least two photos of the same place into it.",
        )


def _features(
    read: ReadPhotos,
    options: PhotosOptions,
    stages: Stages,
    progress: StepProgress,
    jobs: int | None,
) -> None:
    """Look for the features of the photos that have none yet, on all cores."""
    if stages.database().exists():
        return
    waiting = [photo for photo in read.photos if not stages.features(photo).exists()]
    tasks = [
        Task(
            photo.name,
            FeaturesJob(photo.path, options.match, stages.features(photo), photo.mask),
            memory_of(photo.width_px, photo.height_px, options.match),
        )
        for photo in waiting
    ]
    done = len(read.photos) - len(tasks)
    outcomes = run_tasks(
        run_features, tasks, jobs=jobs, started=lambda task: None, memory_budget=FEATURES_MEMORY
    )
    with closing(outcomes):
        for outcome in outcomes:
            if outcome.error is not None:
                raise outcome.error
            if outcome.value is None:
                raise RuntimeError(outcome.traceback or outcome.crash)
            done += 1
            progress("features", done / len(read.photos))


def _retrieved(pairs: Pairs, read: ReadPhotos, options: PhotosOptions, stages: Stages) -> Pairs:
    """The pairs, with those that the features tell."""
    if pairs.kind != "retrieval":
        return pairs
    files = [stages.features(photo) for photo in read.photos]
    return retrieved_pairs(pairs, read.photos, files, options.match, options.random.seed)


def _match(
    read: ReadPhotos,
    pairs: Pairs,
    options: PhotosOptions,
    stages: Stages,
    progress: StepProgress,
) -> tuple[list[PairRecord], list[int]]:
    """The verified pairs, and how many keypoints each photo has."""
    database = stages.database()
    with writing_to(stages.out):
        if not database.exists():
            files = [stages.features(photo) for photo in read.photos]
            camera = options.camera
            write_database(
                database,
                read.photos,
                files,
                per_photo=camera.cameras == "per-photo",
                shared=camera.cameras == "shared",
                fisheye=camera.lens == "fisheye",
            )
        match_pairs(database, pairs, options.match, options.random.seed, progress)
    return read_pairs(database, pairs), count_keypoints(database, read.photos)


def _map(
    read: ReadPhotos, options: PhotosOptions, stages: Stages, told: Told, progress: StepProgress
) -> tuple[Settled, PhotosOptions]:
    """The components, and the options for what follows; a killed run's are not mapped again."""
    ids = [photo.image_id for photo in read.photos]
    around = map_with_panoramas(read.photos, options, stages, progress)
    if around is not None:
        return around, options
    with writing_to(stages.out):
        settled = map_settled(
            stages.database(),
            stages.mapping(),
            ids,
            options.random.seed,
            progress,
            options.map.mapping,
            focal_held=options.camera.focal_px is not None,
        )
    settled, one = mapped_as_of_one_camera(settled, read.photos, options, stages, progress)
    if not one:
        return settled, options
    told.notes.append(TOLD)
    camera = options.camera.model_copy(update={"cameras": "shared"})
    return settled, options.model_copy(update={"camera": camera})
