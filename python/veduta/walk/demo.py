"""`veduta demo --walk`: a gorge that is made from a seed, walked through, and beside the truth.

OUT/stereo has the pairs of pictures and what is true of them, OUT/walk is what `veduta walk` makes
of the pictures.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.run.digests import result_key
from veduta.run.options import Options
from veduta.run.outputs import Standing, open_out, writing_to
from veduta.run.progress import Progress
from veduta.run.verb import VerbResult
from veduta.synthetic.walks.record import GorgeWalk, write_walk
from veduta.walk.command import VERSION as WALK_VERSION
from veduta.walk.command import run_walk
from veduta.walk.document.load import DOCUMENT, read_document
from veduta.walk.options import WalkOptions

VERSION = "1"
STEREO, WALK = "stereo", "walk"
GORGE = GorgeWalk(keys=4, step_m=3.0, width_px=480, height_px=270, pool=True)


@dataclass(frozen=True)
class Compared:
    """A transition beside the truth. Metres; how: what became of it."""

    names: str
    found_m: float | None
    true_m: float
    how: str


@dataclass(frozen=True)
class WalkDemo:
    """What the demo came to. water: the largest share of a view in which it was found."""

    call: VerbResult
    transitions: tuple[Compared, ...] = ()
    water: float = 0.0


def run_walk_demo(
    out: Path, seed: int, progress: Progress, *, force: bool, gorge: GorgeWalk | None = None
) -> WalkDemo:
    """Make the gorge's pictures, walk through them, compare; the same call again is up to date."""
    made = replace(gorge or GORGE, seed=seed)
    key = result_key("demo walk", f"{VERSION}, walk {WALK_VERSION}", Options(), vars(made))
    with open_out(out, "demo", key, force=force) as folder:
        if folder.standing is not Standing.UP_TO_DATE or not (out / STEREO).is_dir():
            work = folder.work_folder(STEREO)
            with writing_to(out):
                write_walk(work, made)
            folder.publish(STEREO, key, work)
        call = run_walk(out / STEREO, out / WALK, WalkOptions(), progress, force=force)
        folder.finish()
    if call.failure is not None:
        return WalkDemo(call)
    return compared(call, out)


def compared(call: VerbResult, out: Path) -> WalkDemo:
    """The walk in OUT beside the poses that its pictures were taken from."""
    said = read_document(out / WALK / DOCUMENT)
    centres = _centres(out / STEREO / "poses.txt")
    numbers = {key.id: number for number, key in enumerate(said.keys)}
    rows = []
    for one in said.transitions:
        ends = centres[[numbers[one.start], numbers[one.end]]]
        true_m = float(np.linalg.norm(ends[1] - ends[0]))
        rows.append(Compared(f"{one.start} to {one.end}", one.distance_m, true_m, one.kind))
    return WalkDemo(call, tuple(rows), max(key.water for key in said.keys))


def _centres(poses: Path) -> NDArray[np.float64]:
    """(n, 3) of the left cameras."""
    return np.loadtxt(poses).reshape(-1, 3, 4)[:, :, 3]
