"""Cameras fixed to each other that are carried along a street: a rig, with its true poses."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.synthetic.camera import FILM_DIAGONAL_MM, Camera, pose_along
from veduta.synthetic.seeds import stream
from veduta.synthetic.streets.house import Street

BODY_M = 2.1
"""Height of the rig above the ground: carried on a pole."""
LANE_M = 0.1
"""Its distance from the middle of the street, as a share of the width."""


@dataclass(frozen=True)
class Mounted:
    """One camera of a rig: where it is fixed to the body and which way it looks from there.

    right_m, ahead_m, up_m: its place on the body. left_deg: its heading from ahead. pitch_deg: up.
    """

    name: str
    right_m: float
    ahead_m: float
    up_m: float
    left_deg: float
    pitch_deg: float
    focal_mm35: float = 25.0

    @property
    def cam_from_body(self) -> NDArray[np.float64]:
        """(4, 4); of the body x is right, y down and z ahead."""
        turn, pitch = np.deg2rad(-self.left_deg), np.deg2rad(self.pitch_deg)
        about_up = np.array(
            [[np.cos(turn), 0, np.sin(turn)], [0, 1, 0], [-np.sin(turn), 0, np.cos(turn)]]
        )
        about_right = np.array(
            [[1, 0, 0], [0, np.cos(pitch), -np.sin(pitch)], [0, np.sin(pitch), np.cos(pitch)]]
        )
        found = np.eye(4)
        found[:3, :3] = (about_up @ about_right).T
        found[:3, 3] = -found[:3, :3] @ np.array([self.right_m, -self.up_m, self.ahead_m])
        return found


PAIR = (
    Mounted("left", -0.25, 0.0, 0.0, 52.0, 10.0),
    Mounted("ahead", 0.25, 0.05, 0.0, 14.0, 8.0, 21.0),
)
"""Two cameras whose views overlap, half a metre apart."""


def walk_rig(
    street: Street,
    frames: int,
    size_px: tuple[int, int],
    mounted: tuple[Mounted, ...] = PAIR,
    share: tuple[float, float] = (0.1, 0.6),
) -> dict[str, tuple[Camera, ...]]:
    """The cameras of each mount, in the order of the frames, along a part of a street.

    The body sways and nods from frame to frame. share: of the street's length, from where to where.
    """
    rng = stream(street.seed * 977, "walk with a rig")
    found: dict[str, list[Camera]] = {mount.name: [] for mount in mounted}
    for along in np.linspace(*share, frames) * street.length_m:
        middle, way = street.at(float(along))
        left = np.array([-np.sin(way), np.cos(way), 0.0])
        place = np.array([*middle, BODY_M]) - LANE_M * street.width_m * left
        place += rng.normal(0.0, (0.1, 0.1, 0.04))
        way += float(rng.normal(0.0, np.deg2rad(3.0)))
        nod, roll = np.deg2rad(rng.normal(0.0, 1.5, 2))
        ahead = np.array([np.cos(way) * np.cos(nod), np.sin(way) * np.cos(nod), np.sin(nod)])
        body = pose_along(place, ahead, float(roll))
        for mount in mounted:
            focal = mount.focal_mm35 * float(np.hypot(*size_px)) / FILM_DIAGONAL_MM
            middle_px = (size_px[0] / 2, size_px[1] / 2)
            pose = mount.cam_from_body @ body
            found[mount.name].append(Camera(*size_px, focal, middle_px, pose))
    return {name: tuple(cameras) for name, cameras in found.items()}
