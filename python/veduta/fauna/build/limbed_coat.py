"""The coat of an animal with limbs: its plane, seen once as it was and once mirrored.

The texture has two panels, one over the other: the upper one is the side that was seen, the lower one
all else, of which every pixel is invented.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.fauna.build.limbed_body import Hull
from veduta.fauna.build.limbed_skeleton import Bones
from veduta.fauna.document.coat import Panel, panel_of
from veduta.fauna.motion.figure import Floats
from veduta.place.material import Material, Texture

_BACK, _BELLY = np.array([118.0, 98.0, 76.0]), np.array([196.0, 182.0, 158.0])
_PAINTED_PX = 512


@dataclass(frozen=True, eq=False)
class Worn:
    """vertex: (w,) the hull's vertex of each of the mesh. uv: (w, 2). mirrored: (m,) of triangles."""

    vertex: NDArray[np.int64]
    triangles: NDArray[np.uint32]
    uv: Floats
    mirrored: NDArray[np.bool_]
    material: Material


def dressed(bones: Bones, hull: Hull, coat: Texture | None, seen: str) -> Worn:
    """The hull's triangles in the panels; a vertex on the seam stands in both.

    seen: from where it was, `left`, `right` or `above`.
    """
    panel = panel_of(bones.figure)
    side = -1.0 if seen == "right" else 1.0
    middle = hull.positions[hull.triangles].mean(axis=1)
    normal = hull.normals[hull.triangles].mean(axis=1)[:, bones.across]
    outer = side * normal > 0.0
    if bones.across == 1:
        outer &= side * middle[:, 1] > 0.0
    mirrored = ~outer
    keys = hull.triangles.astype(np.int64) * 2 + mirrored[:, None]
    used, triangles = np.unique(keys, return_inverse=True)
    vertex = used // 2
    plane = hull.positions[vertex][:, [0, 3 - bones.across]] / bones.length_m
    plane[:, 0] -= bones.shift_m / bones.length_m
    uv = panel.uv(plane)
    uv[:, 1] = 0.5 * uv[:, 1] + 0.5 * (used % 2)
    texture = coat or _painted(panel, bones)
    return Worn(
        vertex, triangles.reshape(-1, 3).astype(np.uint32), uv, mirrored,
        Material("coat", roughness=0.85, texture=texture),
    )  # fmt: skip


def _painted(panel: Panel, bones: Bones) -> Texture:
    """A coat by code, for where no footage shows one: every pixel of it is invented."""
    width = _PAINTED_PX
    height = max(8, round(width * panel.size[1] / panel.size[0]))
    up = np.linspace(1.0, 0.0, height)[:, None, None]
    share = np.clip((up - 0.35) / 0.4, 0.0, 1.0) if bones.across == 1 else np.full_like(up, 0.8)
    pixels = np.broadcast_to(_BELLY + (_BACK - _BELLY) * share, (height, width, 3)).copy()
    random = np.random.default_rng(7)
    grain = cv2.GaussianBlur(random.normal(size=(height, width)), (0, 0), 2.0)
    pixels *= 1.0 + 0.25 * grain[..., None]
    both = np.concatenate([pixels, pixels])
    every = np.ones(both.shape[:2], dtype=np.bool_)
    return Texture(np.clip(both, 0.0, 255.0).astype(np.uint8), every)
