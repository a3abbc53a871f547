"""What says which way is up before walls are asked: GPS, the gimbal that held the camera, or the
photos alone.

Photos of people who stand upright say it themselves (`cameras.orient`). From the air the places
that GPS gives lie all over an area and say it better; so does the gimbal of an aircraft.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from veduta.photos.cameras.component import Component
from veduta.photos.cameras.orient import oriented
from veduta.photos.cameras.upright import Upright
from veduta.photos.intake.read import PhotoRecord
from veduta.photos.structure import Structure
from veduta.photos.world.gps_positions import gps_positions
from veduta.photos.world.gps_up import gps_up, overrules

DOWN = -float(np.sin(np.deg2rad(40.0)))
"""z of the mean way that photos look, under which they look down: edges in them lean all ways."""
GIMBAL_RAD = float(np.deg2rad(1.5))
"""How well a gimbal knows its pitch, with what all photos of a flight have in common."""
AGREE_RAD = float(np.deg2rad(10.0))
"""Up of each photo by its gimbal, from the mean of all: beyond, the tags are of something else."""
SEVERAL_WAYS, TOPS_AGREE = 0.25, 0.85
"""Of the rows of photos, how far they spread beside one way; length of their columns' mean."""
GROUND = "the ground, which is taken for level"
GROUND_RAD = float(np.deg2rad(2.0))
"""How level ground is, where nothing else says what is."""


def looks_down(structure: Structure) -> bool:
    """Whether photos of an upright structure look down, on the whole."""
    return float(structure.cam_from_world[:, 2, 2].mean()) < DOWN


def is_held_upright(structure: Structure) -> bool:
    """Whether photos look several ways with their tops all up, as people hold them.

    Then they say up to a degree, and heights of GPS, which drift by ten metres, do not.
    """
    rotations = structure.cam_from_world[:, :, :3]
    spread = np.linalg.svd(rotations[:, 0], compute_uv=False)
    tops = float(np.linalg.norm(rotations[:, 1].mean(axis=0)))
    return bool(spread[1] > SEVERAL_WAYS * spread[0] and tops > TOPS_AGREE)


def which_way_up(component: Component, photos: Sequence[PhotoRecord]) -> Component:
    """The component turned so that z is up by what says it best.

    upright: how well that is known, where photos look down; walls and edges are asked elsewhere.
    """
    structure = component.structure
    found, by = _by_gps(structure, photos), "the positions of GPS"
    if found is None:
        found, by = _by_gimbal(structure, photos), "the gimbal of the camera"
    if found is None:
        if not looks_down(structure):
            return component
        sd = float(np.rad2deg(GROUND_RAD))
        return replace(component, upright=Upright(np.array([0.0, 0.0, 1.0]), 0.0, sd, GROUND))
    up, sd_rad = found
    turned = oriented(structure, up)
    moved = float(np.rad2deg(np.arccos(np.clip(up[2], -1.0, 1.0))))
    upright = Upright(up, moved, float(np.rad2deg(sd_rad)), by)
    return replace(
        component, structure=turned.structure, level_deg=turned.level_deg, upright=upright
    )


_Known = tuple[NDArray[np.float64], float] | None


def _by_gps(structure: Structure, photos: Sequence[PhotoRecord]) -> _Known:
    """Where photos look down, or GPS contradicts what they say."""
    positions = gps_positions(structure, photos, None, None)
    if positions is None or is_held_upright(structure):
        return None
    found = gps_up(structure, positions)
    if found is None or not (looks_down(structure) or overrules(found)):
        return None
    return found.up, found.sd_rad


def _by_gimbal(structure: Structure, photos: Sequence[PhotoRecord]) -> _Known:
    """By the pitch of at least half of the photos, which look down by it; nobody rolls a gimbal."""
    pitch = {photo.name: photo.pitch_deg for photo in photos if photo.pitch_deg is not None}
    rows = [row for row, name in enumerate(structure.names) if name in pitch]
    if 2 * len(rows) < len(structure.names) or not rows:
        return None
    angle = np.deg2rad([pitch[structure.names[row]] for row in rows])
    if float(np.sin(angle).mean()) > DOWN:
        return None
    zero = np.zeros(len(rows))
    own = np.column_stack([zero, -np.cos(angle), np.sin(angle)])
    ups = np.einsum("nji,nj->ni", structure.cam_from_world[rows, :, :3], own)
    mean = ups.mean(axis=0)
    length = float(np.linalg.norm(mean))
    if length < np.cos(AGREE_RAD):
        return None
    unit: NDArray[np.float64] = mean / length
    return unit, GIMBAL_RAD
