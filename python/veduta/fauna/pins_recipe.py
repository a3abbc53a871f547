"""What is known of an animal's joints beside its silhouettes: marked ones, and painted markers."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from veduta.fauna.document.plan import BodyPlan
from veduta.fauna.motion.figure import Floats, figure_of
from veduta.fauna.options import FootageOptions
from veduta.fauna.read.annotated import read_annotated
from veduta.fauna.read.between_marks import CarriedMarks, CarryLooks, carried_marks
from veduta.fauna.read.footage import Footage, pictures_in
from veduta.fauna.read.joints import MarkedJoints, read_joints, written_joints
from veduta.fauna.read.markers import Marker, MarkerLooks, read_markers, tracked_markers
from veduta.fauna.read.silhouettes import Silhouettes
from veduta.fauna.recipe import Record
from veduta.run.errors import InputError
from veduta.run.work import Work

JOINTS = "joints.csv"
_MOST_BESIDE = 0.1
"""Of the places: more of them beside the frames are those of other pictures."""


def pins_of(
    work: Work, record: Record, footage: Footage, found: Silhouettes, plan: BodyPlan,
    options: FootageOptions,
) -> CarriedMarks:  # fmt: skip
    """px by joint in the frames of the footage, and how far each is trusted; none where nothing is
    given.

    A joint that is marked is taken from there, if it has a painted marker, too. Gaps between marks
    are bridged by what the pictures show.
    """
    names = figure_of(plan).names
    pins: dict[str, Floats] = {}
    if record.markers is not None:
        markers = read_markers(record.markers, names)
        markers = tuple(in_frames(marker, footage, record.markers) for marker in markers)
        with work.step("markers") as step:
            tracked = tracked_markers(
                footage.frames, found.masks, found.rows, markers, MarkerLooks(), record.path.name
            )
            step.counts["markers"] = len(tracked.px)
            step.rejected.extend(f"{name}: its colour is never seen" for name in tracked.unknown)
        pins |= tracked.px
    if record.joints is not None:
        with work.step("joints") as step:
            marked = _marked(record, footage, names, options)
            step.counts["joints"] = len(marked.px)
            step.rejected.extend(f"{name}: no joint of the body plan" for name in marked.unknown)
        corner = np.array(footage.corner, dtype=np.float64)
        pins |= {
            name: footage.at_canvas((places[footage.number] - corner)[:, None])[:, 0]
            for name, places in marked.px.items()
        }
    if not pins:
        return CarriedMarks({}, {})
    work.measure("joints_marked_share", _share(pins))
    with work.step("joints between marks") as step:
        masks = np.zeros(footage.frames.shape[:3], dtype=np.bool_)
        masks[found.rows] = found.masks
        carried = carried_marks(footage.frames, masks, pins, CarryLooks())
        step.counts["joints"] = len(pins)
    work.measure("joints_carried_share", _share(carried.px) - _share(pins))
    whole = {
        name: footage.from_canvas(at[:, None])[:, 0] + np.array(footage.corner)
        for name, at in carried.px.items()
    }
    text = written_joints(whole, carried.trust, footage.number)
    (work.folder / JOINTS).write_text(text, encoding="utf-8")
    work.file(
        JOINTS,
        "joints that were marked, tracked or (with a likelihood below 0.6) carried from frame to"
        " frame, to correct and to give again",
    )
    return carried


def _share(px: dict[str, Floats]) -> float:
    return float(np.mean([np.isfinite(at[:, 0]).mean() for at in px.values()]))


def in_frames(marker: Marker, footage: Footage, path: Path) -> Marker:
    """The same with its frame and place as the footage has them, not the record.

    path: where the marker was told; InputError where its frame was not read.
    """
    if marker.at is None:
        return marker
    rows = np.flatnonzero(footage.number == marker.frame)
    if not len(rows):
        near = int(footage.number[np.abs(footage.number - marker.frame).argmin()])
        fault = f"says where {marker.joint} is in frame {marker.frame}, which is not read"
        every = f"Frames from {footage.number[0]} to {footage.number[-1]} are read"
        raise InputError(path, fault, f"{every}; frame {near} is the next one that is.")
    row, (left, top), (x, y) = int(rows[0]), footage.corner, marker.at
    in_frame = np.tile(np.array([[x - left, y - top]]), (len(footage.number), 1, 1))
    there = footage.at_canvas(in_frame)[row, 0]
    return replace(marker, frame=row, at=(float(there[0]), float(there[1])))


def _marked(
    record: Record, footage: Footage, names: tuple[str, ...], options: FootageOptions
) -> MarkedJoints:
    """The joints in the record's pictures; InputError where they lie beside those."""
    joints = record.joints
    if joints is None:
        return MarkedJoints({}, ())
    files: list[str] = []
    if record.path.is_dir():
        files = [picture.name for picture in pictures_in(record.path)]
    count = max(len(files), int(footage.number[-1]) + 1)
    height, width = footage.whole or footage.framed or footage.size
    if joints.suffix.lower() == ".json":
        found = read_annotated(joints, count, names)
    else:
        found = read_joints(joints, count, names, files, options.individual)
    scale = 1.0 if options.joints_height is None else height / options.joints_height
    places = {name: at * scale for name, at in found.px.items()}
    every = np.concatenate(list(places.values()))
    every = every[np.isfinite(every).all(axis=1)]
    beside = ((every < 0.0) | (every > [width, height])).any(axis=1)
    if len(every) and float(beside.mean()) > _MOST_BESIDE:
        raise InputError(
            joints,
            f"has {int(beside.sum())} of {len(every)} places beside the frames, which are"
            f" {width} x {height} px",
            "Say how high the pictures were in which they were marked (--joints-height).",
        )
    return MarkedJoints(places, found.unknown)
