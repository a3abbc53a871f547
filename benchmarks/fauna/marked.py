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
from veduta.fauna.read.drawn import drawn_figure
from veduta.fauna.read.footage import Footage, read_footage, read_masks
from veduta.fauna.read.limbed import LimbedLooks, LimbedSeen, fit_limbed
from veduta.fauna.read.overlap import overlap
from veduta.fauna.read.silhouettes import SilhouetteLooks, Silhouettes, silhouettes_of

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
    found = silhouettes_of(read_masks(folder / "masks", footage), SilhouetteLooks(), "dog")
    plan = load_plan("quadruped")
    own = read_annotated(folder / "badja_dog.json", len(footage.frames), figure_of(plan).names).px
    marked = {name: at * (footage.size[0] / ANNOTATED_PX) for name, at in own.items()}
    frames = np.flatnonzero(np.any([np.isfinite(at[:, 0]) for at in marked.values()], axis=0))
    rows: list[Row] = []
    for name, held in (
        ("silhouettes alone", frames),
        ("every other labelled frame given", frames[1::2]),
    ):
        pins = {}
        if len(held) < len(frames):
            pins = {joint: at.copy() for joint, at in marked.items()}
            for at in pins.values():
                at[held] = np.nan
        rows += kept.rows(name, partial(measured, name, footage, found, pins, marked, held))
    notes = [
        f"Places within {NEAR:.0%} of the length from rump to nose; judged in labelled frames that"
        " the fit was not given. Nothing was tuned with the dog.",
    ]
    keep_or_print("fauna-marked", rows, notes, not given.no_keep)


def measured(
    name: str, footage: Footage, found: Silhouettes, pins: dict[str, Floats],
    marked: dict[str, Floats], held: NDArray[np.int64],
) -> list[Row]:  # fmt: skip
    """The rows of one fit."""
    own = {joint: at[found.rows] for joint, at in pins.items()}
    plan = load_plan("quadruped")
    pictures = footage.frames[found.rows]
    seen = fit_limbed(found.masks, found.rows, plan, LimbedLooks(), lambda: None, own, pictures)
    joints = seen.windows.in_picture(seen.fitted.joints(), seen.fitted.px_per_length)
    deep = seen.fitted.deep * seen.fitted.px_per_length
    shape = (found.masks.shape[1], found.masks.shape[2])
    covers = [
        overlap(drawn_figure(seen.fitted.figure, at, deep, shape), mask)
        for at, mask in zip(joints, found.masks, strict=True)
    ]
    away = _away(seen, joints, deep, found.rows, marked, held)
    return [
        {"what": f"dog, {name}: labelled places within 8 % of the length",
         "value": float(np.mean(away < NEAR)), "bound": "0.80"},
        {"what": f"dog, {name}: median distance (of the length)", "value": float(np.median(away)),
         "bound": ""},
        {"what": f"dog, {name}: places judged", "value": len(away), "bound": ""},
        {"what": f"dog, {name}: IoU of the median frame", "value": float(np.median(covers)),
         "bound": "0.85"},
    ]  # fmt: skip


def _away(
    seen: LimbedSeen, joints: Floats, deep: Floats, rows: NDArray[np.int64],
    marked: dict[str, Floats], held: NDArray[np.int64],
) -> Floats:  # fmt: skip
    """(n,) distances in lengths, of the joints that the figure has, in the held frames."""
    figure = seen.fitted.figure
    body = list(figure.limbs[0].joints)
    way = np.linalg.norm(np.diff(joints[:, body], axis=1), axis=2).sum(axis=1)
    length = float(np.median(way) + deep[body[0]] + deep[body[-1]])
    kept = np.isin(rows, held)
    away = [
        np.linalg.norm(joints[kept, figure.names.index(name)] - at[rows[kept]], axis=1) / length
        for name, at in marked.items()
        if name in figure.names
    ]
    flat = np.concatenate(away)
    return np.asarray(flat[np.isfinite(flat)])


if __name__ == "__main__":
    main()
