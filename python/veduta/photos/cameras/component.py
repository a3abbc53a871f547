"""A component with its cameras chosen, adjusted to all observations, cleaned and set upright."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from veduta.photos.cameras.lens import LensChoice, choose_lens, with_cameras
from veduta.photos.cameras.misplaced import without_misplaced
from veduta.photos.cameras.orient import oriented
from veduta.photos.cameras.upright import Upright
from veduta.photos.options import CameraOptions
from veduta.photos.structure import (
    Structure,
    adjusted,
    errors_px,
    without_outliers,
)
from veduta.run.errors import NotFoundError

MOST_ERROR_PX = 4.0
"""Observations that lie further off after the last adjustment are false."""
FEWEST_POINTS = 30
"""The engine places a photo by as many; one that is left with fewer was placed falsely."""
_WEAK = f"the last adjustment leaves it fewer than {FEWEST_POINTS} points: it was placed falsely"
_MISPLACED = (
    "it matches, but where that puts it it would show much that it does not: something that looks"
    " alike stands elsewhere, too"
)
_REMEDY = "Take photos that join the two, or say --cameras per-photo where they have other cameras."
_KEPT_WEAK = f"fewer than {FEWEST_POINTS} points hold what may have been placed falsely"
_KEPT_MISPLACED = "from where it was placed it would show much that it does not"


@dataclass(frozen=True)
class Component:
    """Photos that hang together. level_deg: how level they were held, in the middle.

    upright: what walls and vertical edges said of up; None where they were not asked. left: photos
    that were mapped and fell out, as (name, reason). notes: of photos that should have.
    """

    structure: Structure
    lens: LensChoice
    level_deg: float
    upright: Upright | None = None
    left: tuple[tuple[str, str], ...] = ()
    notes: tuple[str, ...] = ()

    @cached_property
    def errors_px(self) -> NDArray[np.float64]:
        """(o,) distance of each observation from its point's projection."""
        return errors_px(self.structure)


def finish_component(
    mapped: Structure,
    options: CameraOptions,
    groups: Mapping[int, int],
    seed: int,
    shared: Component | None = None,
) -> Component:
    """What the engine mapped, with the cameras that the observations speak for.

    shared: a larger component whose cameras these photos share; they are taken as they are.
    """
    if shared is not None:
        return _with_the_cameras_of(shared, mapped, groups)
    choice = choose_lens(mapped, options, groups, seed)
    free = choice.kind.principal_point == "free"
    structure = with_cameras(mapped, choice.kind, groups)
    # False matches that lie within the bound can hold parts that hang on little, a distant wall,
    # turned against each other: squares never let them go.
    structure = adjusted(structure, free_principal_point=free, false_matches=True)
    structure = without_outliers(structure, MOST_ERROR_PX)
    structure = without_outliers(adjusted(structure, free_principal_point=free), MOST_ERROR_PX)
    placed, doubtful = without_misplaced(structure)
    left = _told(structure, placed, _MISPLACED)
    if left:  # they bent what they were tied to
        placed = without_outliers(adjusted(placed, free_principal_point=free), MOST_ERROR_PX)
    held, weak = without_weak(placed)
    upright = oriented(held)
    left += _told(placed, held, _WEAK)
    notes = (*_kept(doubtful, _KEPT_MISPLACED), *_kept(weak, _KEPT_WEAK), *by_rig_alone(held))
    return Component(upright.structure, choice, upright.level_deg, left=left, notes=notes)


def _with_the_cameras_of(
    larger: Component, mapped: Structure, groups: Mapping[int, int]
) -> Component:
    """Poses and points by the cameras of another component, which stay; NotFoundError where these
    leave nothing that hangs together.
    """
    known = larger.structure
    camera_of = {groups[image]: known.camera_of[image] for image in known.image_ids}
    own = {image: camera_of[groups[image]] for image in mapped.image_ids}
    cameras = {number: known.cameras[number] for number in set(own.values())}
    structure = mapped.with_cameras(cameras, own)
    for _ in range(2):
        structure = adjusted(
            structure, free_principal_point=False, false_matches=True, held=tuple(cameras)
        )
        structure = without_outliers(structure, MOST_ERROR_PX)
        if len(structure.points) < FEWEST_POINTS:
            raise NotFoundError(
                "cameras", "does not hang together with the camera that the others share", _REMEDY
            )
    held, weak = without_weak(structure)
    upright = oriented(held)
    left = _told(structure, held, _WEAK)
    notes = (*_kept(weak, _KEPT_WEAK), *by_rig_alone(held))
    choice = LensChoice(larger.lens.kind, ())
    return Component(upright.structure, choice, upright.level_deg, left=left, notes=notes)


def _told(before: Structure, after: Structure, reason: str) -> tuple[tuple[str, str], ...]:
    """The photos that fell out."""
    return tuple((name, reason) for name in sorted({*before.names} - {*after.names}))


def _kept(names: tuple[str, ...], state: str) -> tuple[str, ...]:
    """A note on photos that would have fallen out."""
    if not names:
        return ()
    return (f"{', '.join(names)}: {state}; kept, as fewer than two photos would be left",)


def by_rig_alone(structure: Structure) -> tuple[str, ...]:
    """A note on photos that show too little, whose places are those of their frame."""
    counts = np.bincount(structure.image_of, minlength=len(structure.names))
    names = [structure.names[row] for row in np.flatnonzero(counts < FEWEST_POINTS)]
    if not structure.frame_of or not names:
        return ()
    by = "the others of their frame" if structure.views else "the other cameras of the rig"
    return (f"{', '.join(names)}: too little to see; placed by {by}",)


def without_weak(structure: Structure) -> tuple[Structure, tuple[str, ...]]:
    """The same without photos that too few points hold; those of a rig hold each other.

    Where fewer than two would be left all stay: then the second names those that are weak.
    """
    counts = np.bincount(structure.image_of, minlength=len(structure.names))
    frame = structure.by_frame()
    counts = np.bincount(frame, weights=counts)[frame]
    return structure.without_doubtful(counts < FEWEST_POINTS)


def component_name(number: int) -> str:
    """A, B, .. Z, AA, AB, ..: what component `sparse/number` is called."""
    name = ""
    number += 1
    while number:
        number, letter = divmod(number - 1, 26)
        name = chr(ord("A") + letter) + name
    return name
