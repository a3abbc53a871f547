"""Whether the cameras of a component can be: small ones may settle on a focal length that is none.

Three photos that look nearly one way fit a focal length ten times too long as well as the true one.
What a larger component says of the same camera is held against it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import pycolmap

from veduta.photos.cameras.component import Component
from veduta.photos.intake.read import PhotoRecord


@dataclass(frozen=True)
class FocalParameters:
    """shortest, longest: of a focal length as a share of the photo's longer side, 7 and 430 mm of
    a 35 mm camera. stated: factor by which one may differ from what EXIF states. alike: factor by
    which one may differ from that of a larger component whose photos may be of the same camera.
    """

    shortest: float = 0.2
    longest: float = 12.0
    stated: float = 2.0
    alike: float = 3.0


def cameras_by_group(component: Component, groups: Mapping[int, int]) -> dict[int, pycolmap.Camera]:
    """The camera of each group of photos, where all of a group share one."""
    structure = component.structure
    found: dict[int, set[int]] = {}
    for image in structure.image_ids:
        found.setdefault(groups[image], set()).add(structure.camera_of[image])
    return {
        group: structure.cameras[next(iter(cameras))]
        for group, cameras in found.items()
        if len(cameras) == 1
    }


def focal_lengths(component: Component, groups: Mapping[int, int]) -> dict[int, float]:
    """The focal length (px) of each group of photos, in the middle."""
    by_group: dict[int, list[float]] = {}
    for row, image in enumerate(component.structure.image_ids):
        focal = component.structure.camera(row).mean_focal_length()
        by_group.setdefault(groups[image], []).append(float(focal))
    return {group: float(np.median(focals)) for group, focals in by_group.items()}


def absurd(
    component: Component,
    photos: Mapping[int, PhotoRecord],
    larger: Mapping[int, float],
    parameters: FocalParameters | None = None,
) -> str:
    """Why a component's focal lengths cannot be true; empty where they can.

    photos: by image id. larger: focal lengths of groups in a larger component.
    """
    known = parameters or FocalParameters()
    groups = {image: photo.group for image, photo in photos.items()}
    for group, focal in focal_lengths(component, groups).items():
        photo = next(
            photos[image] for image in component.structure.image_ids if groups[image] == group
        )
        side = max(photo.width_px, photo.height_px)
        if not known.shortest <= focal / side <= known.longest:
            return f"a focal length of {focal:.0f} px is none of photos of {side} px"
        if photo.focal_px is not None and _differ(focal, photo.focal_px, known.stated):
            return (
                f"its photos would have a focal length of {focal:.0f} px, where EXIF states"
                f" {photo.focal_px:.0f} px"
            )
        if photo.focal_px is None and _differ(focal, larger.get(group, focal), known.alike):
            return (
                f"its photos would have a focal length of {focal:.0f} px, where others of the same"
                f" kind have {larger[group]:.0f} px"
            )
    return ""


def _differ(one: float, other: float, factor: float) -> bool:
    return not 1.0 / factor <= one / other <= factor
