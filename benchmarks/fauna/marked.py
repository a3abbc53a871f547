"""Joints of a real dog: from silhouettes alone, and with a part of the frames marked.

`python benchmarks fauna/marked [--no-keep]` prints a table and keeps it in
`benchmarks/results/fauna-marked.md`. Real data is read from `$VEDUTA_DATA`, else from
`../shared/data`.
"""

from __future__ import annotations

import argparse
import os
from functools import partial
from pathlib import Path

import numpy as np
from kept_clips import KeptClips
from numpy.typing import NDArray
from record import Value, keep_or_print

from veduta.fauna.document.plan import load_plan
from veduta.fauna.motion.figure import figure_of
from veduta.fauna.read.annotated import read_annotated
from veduta.fauna.read.between_marks import CarriedMarks, CarryLooks, carried_marks
from veduta.fauna.read.drawn import drawn_figure
from veduta.fauna.read.footage import Footage, read_footage, read_masks
from veduta.fauna.read.limbed import LimbedLooks, LimbedSeen, fit_limbed
from veduta.fauna.read.overlap import overlap
from veduta.fauna.read.silhouettes import SilhouetteLooks, Silhouettes, silhouettes_of
from veduta.fauna.read.starts import scale_of
from veduta.fauna.read.ways import WayLooks, stretches_of
from veduta.fauna.read.windows import windows_of

Floats = NDArray[np.float64]
Row = dict[str, Value]
DATA = Path(os.environ.get("VEDUTA_DATA", Path(__file__).parents[3] / "shared" / "data"))
ANNOTATED_PX = 1080.0
"""The dog's joints were marked in pictures so high (the README beside them)."""
NEAR = 0.08
"""Of the body's length: the bound of the issue."""


def main() -> None:
    """Measure all of it and keep the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kept", type=Path, help="where fits that are done are kept")
    parser.add_argument("--no-keep", action="store_true")
    given = parser.parse_args()
    kept = KeptClips(given.kept)
    folder = DATA / "animals" / "dog"
    footage = read_footage(folder / "frames", None)
    masks = read_masks(folder / "masks", footage)
    found = silhouettes_of(masks, SilhouetteLooks(), "dog", with_cut=True)
    plan = load_plan("quadruped")
    own = read_annotated(folder / "badja_dog.json", len(footage.frames), figure_of(plan).names).px
    marked = {name: at * (footage.size[0] / ANNOTATED_PX) for name, at in own.items()}
    frames = np.flatnonzero(np.any([np.isfinite(at[:, 0]) for at in marked.values()], axis=0))
    whole = np.zeros(footage.frames.shape[:3], dtype=np.bool_)
    whole[found.rows] = found.masks
    half = {joint: at.copy() for joint, at in marked.items()}
    for at in half.values():
        at[frames[1::2]] = np.nan
    carried = carried_marks(footage.frames, whole, half, CarryLooks())
    every = {joint: np.ones(len(whole)) for joint in half}
    rows: list[Row] = []
    for name, pins, trust, held in (
        ("silhouettes alone", {}, {}, frames),
        ("every other labelled frame given, none carried", half, every, frames[1::2]),
        ("every other labelled frame given", carried.px, carried.trust, frames[1::2]),
    ):
        given_marks = CarriedMarks(pins, trust)
        rows += kept.rows(name, partial(measured, name, footage, found, given_marks, marked, held))
    notes = [
        f"Places within {NEAR:.0%} of the length from rump to nose; judged in labelled frames that"
        " the fit was not given. That length is of the plan at rest that covers as much as the"
        f" silhouettes do in the median frame ({length_of(found.masks):.0f} px): no fit has a say"
        " in it. Up to 27 November 2026 it was the fitted one, by which 0.88 of 32 places were"
        " within (the turn was not told then). Both ways of holding the turn and two weights of"
        " marks were tried on these held frames, too, before the length was changed: they are not"
        " unseen.",
        "The dog turns towards the camera and goes back: from silhouettes alone the frames between"
        " are left out, and labelled places in them are not judged. 74 places are visible in the"
        " frames that were held back; what is judged of a figure are those that it has.",
    ]
    keep_or_print("fauna-marked", rows, notes, not given.no_keep)


def measured(
    name: str, footage: Footage, found: Silhouettes, marks: CarriedMarks,
    marked: dict[str, Floats], held: NDArray[np.int64],
) -> list[Row]:  # fmt: skip
    """The rows of one fit; without marks the frames in which the dog turns round are left out."""
    everything = found.masks
    own = {joint: sure[found.rows] for joint, sure in marks.trust.items()}
    parted = stretches_of(found, footage.frames[found.rows], WayLooks(), own)
    ways = parted.right
    if ways is not None:
        found, ways = found.of(np.flatnonzero(~parted.turning)), ways[~parted.turning]
    pins, trust = (
        {joint: values[found.rows] for joint, values in one.items()}
        for one in (marks.px, marks.trust)
    )
    plan = load_plan("quadruped")
    pictures = footage.frames[found.rows]
    seen = fit_limbed(
        found.masks,
        found.rows,
        plan,
        LimbedLooks(),
        lambda: None,
        pins,
        pictures,
        trust,
        found.shown(),
        ways,
    )
    joints = seen.windows.in_picture(seen.fitted.joints(), seen.fitted.px_per_length)
    deep = seen.fitted.deep * seen.fitted.px_per_length
    shape = (found.masks.shape[1], found.masks.shape[2])
    covers = [
        overlap(drawn_figure(seen.fitted.figure, at, deep, shape), mask)
        for at, mask in zip(joints, found.masks, strict=True)
    ]
    length = length_of(everything)
    away = _away(seen, joints, length, found.rows, marked, held)
    carried = any(np.any((one > 0.0) & (one < 1.0)) for one in marks.trust.values())
    return [
        *([carried_row(marks, marked, held, length)] if carried else []),
        {"what": f"dog, {name}: labelled places within 8 % of the length",
         "value": float(np.mean(away < NEAR)), "bound": "0.80"},
        {"what": f"dog, {name}: median distance (of the length)", "value": float(np.median(away)),
         "bound": ""},
        {"what": f"dog, {name}: places judged", "value": len(away), "bound": ""},
        {"what": f"dog, {name}: IoU of the median frame", "value": float(np.median(covers)),
         "bound": "0.85"},
    ]  # fmt: skip


def carried_row(
    carried: CarriedMarks, marked: dict[str, Floats], held: NDArray[np.int64], length: float
) -> Row:
    """What is carried from frame to frame, without a fit, in all held frames. length: px."""
    away = np.concatenate(
        [np.linalg.norm(carried.px[name][held] - at[held], axis=1) for name, at in marked.items()]
    )
    there = np.concatenate([np.isfinite(at[held, 0]) for at in marked.values()])
    near = np.nan_to_num(away[there] / length, nan=1.0) < NEAR
    return {"what": "dog, marks carried by what the pictures show, without a figure",
            "value": float(near.mean()), "bound": "0.80", "places": len(near)}  # fmt: skip


def _away(
    seen: LimbedSeen, joints: Floats, length: float, rows: NDArray[np.int64],
    marked: dict[str, Floats], held: NDArray[np.int64],
) -> Floats:  # fmt: skip
    """(n,) distances in lengths, of the joints that the figure has, in the held frames."""
    figure = seen.fitted.figure
    kept = np.isin(rows, held)
    away = [
        np.linalg.norm(joints[kept, figure.names.index(name)] - at[rows[kept]], axis=1) / length
        for name, at in marked.items()
        if name in figure.names
    ]
    flat = np.concatenate(away)
    return np.asarray(flat[np.isfinite(flat)])


def length_of(masks: NDArray[np.bool_]) -> float:
    """From rump to nose, px: of the plan at rest that covers as much as the silhouettes do."""
    figure = figure_of(load_plan("quadruped"), ("ear", "horn", "beard"))
    body = list(figure.limbs[0].joints)
    at_rest = np.array(figure.limbs[0].part.points)
    way = float(np.linalg.norm(np.diff(at_rest, axis=0), axis=1).sum())
    whole = way + figure.deep[body[0]] + figure.deep[body[-1]]
    return float(whole * scale_of(figure, windows_of(masks, 48)))


if __name__ == "__main__":
    main()
