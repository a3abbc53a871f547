"""The animal on its path as a clip of its own: `on-path.glb` and `animal.x3d`."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from veduta.fauna.build.going import Goer
from veduta.fauna.motion.figure import Floats
from veduta.fauna.motion.steps import Heights
from veduta.fauna.motion.transfer import TransferLooks, Walked, walked
from veduta.formats.mesh_glb import write_mesh_glb
from veduta.formats.x3d_skin import write_mesh_x3d
from veduta.run.work import Work

ON_PATH, X3D = "on-path.glb", "animal.x3d"
_MOST_SECONDS = 240.0
"""A longer way is no clip that anybody edits: its beginning is written."""
_SLIDES, _SINKS_M = 0.01, 0.02
"""Of a stride, and metres: what stands may not slide or sink farther."""


def write_on_path(
    work: Work, goer: Goer, path: Floats, ground: Heights | None, *, closed: bool,
    corners: tuple[int, ...] = (),
) -> None:  # fmt: skip
    """The animal as it goes along a path (n, 3); ground: of the terrain, else it is flat.

    corners: rows of the path at which it turns on the spot.
    """
    clips = goer.mesh.clips
    if goer.walker is not None:
        with work.step("transfer") as step:
            path, closed, cut = _first_part(goer, path, closed=closed)
            kept = [row for row in corners if row < len(path) - 1]
            done = walked(
                goer.walker, path, ground or _flat, closed=closed, looks=TransferLooks(),
                corners=kept,
            )  # fmt: skip
            step.counts["keys"] = len(done.clip.times_s)
        _tell(work, goer, done)
        if cut:
            work.note(f"{ON_PATH} has the first {_MOST_SECONDS:g} s of the path")
        mesh = replace(goer.mesh, clips=(done.clip,))
        write_mesh_glb(mesh, work.folder / ON_PATH, rigged=True)
        work.file(ON_PATH, "the animal on its path, feet planted, with start and stop (glTF)")
        clips = (*clips, done.clip)
    write_mesh_x3d(replace(goer.mesh, clips=clips), work.folder / X3D)
    work.file(X3D, "the animal with interpolators for all of its clips (X3D 4, HAnim)")


def _flat(places: Floats) -> Floats:
    return np.zeros(len(places))


def _first_part(goer: Goer, path: Floats, *, closed: bool) -> tuple[Floats, bool, bool]:
    """The path, or as much of it as is gone in the longest time."""
    walker = goer.walker
    if walker is None:
        return path, closed, False
    speed = walker.stride_m / float(walker.clip.times_s[-1])
    arcs = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])
    most = speed * _MOST_SECONDS + goer.length_m
    if arcs[-1] <= most:
        return path, closed, False
    return path[: max(4, int(np.searchsorted(arcs, most)))], False, True


def _tell(work: Work, goer: Goer, done: Walked) -> None:
    walker = goer.walker
    if walker is None:
        return
    work.measure("path_aside_lengths", done.aside_m / goer.length_m)
    if not walker.legs:
        return
    slides = done.slides_m / walker.stride_m
    work.measure("path_foot_slides_strides", slides)
    work.measure("path_foot_sinks_m", done.sinks_m)
    if slides > _SLIDES or done.sinks_m > _SINKS_M:
        work.doubt(
            f"on its path a standing foot slides by {slides:.1%} of a stride and sinks by"
            f" {100.0 * done.sinks_m:.1f} cm at worst"
        )
