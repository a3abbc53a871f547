"""What a walker sees on the way from one key position to the next: the same as the player draws.

Two meshes, each with both pictures: that of the one position morphing onwards and that of the next
morphing backwards. Equation (1) moves their vertices, (2) mixes their colours; where both see a
surface they are weighed by the morph parameter, where one is before the other the nearer is seen.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta._core import walk_rasterise
from veduta.walk.build.mesh import MOVING, MorphMesh
from veduta.walk.build.morph import inverse
from veduta.walk.build.sampling import sampled
from veduta.walk.build.screen import Screen
from veduta.walk.rig import Image

Matrix = NDArray[np.float64]
NEAR_M = 0.3


@dataclass(frozen=True)
class Mixing:
    """tolerance: by how much (a share) a surface may lie behind another to be the same. torn: the
    weight of what spans a break in depth. floor: the least weight of a mesh at its own far end.
    alone: share of the way over which what hides a model, and its own breaks, come to count.
    moving: the weight of what moves, and leave: share of the way over which it is left behind.
    solid: the weight from which a surface hides what is behind it. doubt: grey levels by which both
    pictures may differ where a surface lies in them, each smoothed by smooth_px; where they differ by
    more its weight sinks to doubted (both chosen on `laser/kitti00`).
    """

    tolerance: float = 0.3
    torn: float = 0.02
    floor: float = 1e-4
    alone: float = 0.12
    moving: float = 0.0004
    leave: float = 0.3
    solid: float = 1.0
    doubt: float = 30.0
    smooth_px: float = 1.5
    doubted: float = 0.05


@dataclass(frozen=True, eq=False)
class Layer:
    """A mesh drawn. colour: (h, w, 3) float32; weight: (h, w), 0 where nothing is; depth: (h, w)."""

    colour: NDArray[np.float32]
    weight: NDArray[np.float32]
    depth: NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class Transition:
    """Both meshes of a transition, and the pose between its ends."""

    forth: MorphMesh
    back: MorphMesh
    second_from_first: Matrix
    first_image: Image
    second_image: Image


def draw_between(
    transition: Transition, m: float, cam_from_first: Matrix, screen: Screen, mixing: Mixing = Mixing()
) -> tuple[Image, NDArray[np.bool_]]:
    """The picture at m (0..1) of a camera; and (h, w) where anything is seen."""
    first_from_second = inverse(transition.second_from_first)
    own = draw_mesh(
        transition.forth, m, first_from_second, cam_from_first, screen,
        transition.first_image, transition.second_image, mixing,
    )  # fmt: skip
    cam_from_second = chained(cam_from_first, first_from_second)
    other = draw_mesh(
        transition.back, 1.0 - m, transition.second_from_first, cam_from_second, screen,
        transition.second_image, transition.first_image, mixing,
    )  # fmt: skip
    return mixed(own, other, m, mixing)


def chained(after: Matrix, before: Matrix) -> Matrix:
    """(3, 4) of one pose after another."""
    return np.column_stack([after[:, :3] @ before[:, :3], after[:, :3] @ before[:, 3] + after[:, 3]])


def draw_mesh(
    mesh: MorphMesh, m: float, own_from_other: Matrix, cam_from_own: Matrix, screen: Screen,
    own_image: Image, other_image: Image, mixing: Mixing = Mixing(),
) -> Layer:  # fmt: skip
    """A mesh at m of its way: equations (1) and (2)."""
    arrived = mesh.destinations @ own_from_other[:, :3].T + own_from_other[:, 3]
    points = (1.0 - m) * mesh.points + m * arrived
    seen, depth = screen.project(points @ cam_from_own[:, :3].T + cam_from_own[:, 3])
    placed = np.column_stack([np.nan_to_num(seen, nan=-1e6), depth]).astype(np.float32)
    # A picture lies on its surface as its camera threw it there: in proportion to the depth.
    own_depth = mesh.depth_m[:, None]
    carried = np.column_stack([mesh.uv * own_depth, own_depth, mesh.uv_second, mesh.psi])
    carried = carried.astype(np.float32)
    drawn, flat, which = walk_rasterise(
        placed, carried, mesh.triangles, screen.width_px, screen.height_px, near=NEAR_M
    )
    values = flat.reshape(screen.height_px, screen.width_px, 6)
    places = values[..., 0:2] / np.maximum(values[..., 2:3], 1e-6), values[..., 3:5]
    own, other = _sampled(own_image, places[0]), _sampled(other_image, places[1])
    share = (m * values[..., 5])[..., None]
    seen_there = which >= 0
    torn = np.where(seen_there, mesh.torn[np.maximum(which, 0)], False)
    away = left_behind(m, mixing)
    least = np.where(torn, mixing.torn, _believed((own_image, other_image), places, mixing))
    weight = (1.0 - away * (1.0 - least)) * seen_there
    if mesh.marks is not None:
        moving = seen_there & mesh.marked(MOVING)[np.maximum(which, 0)]
        gone = _eased(m, mixing.leave)
        weight = np.where(moving, mixing.moving**gone, weight)
    return Layer((1.0 - share) * own + share * other, weight.astype(np.float32), drawn)


def _believed(
    images: tuple[Image, Image], places: tuple[NDArray[np.floating], NDArray[np.floating]],
    mixing: Mixing,
) -> NDArray[np.float32]:  # fmt: skip
    """(h, w) 0..1: how far both pictures show the same where a surface lies in each. A surface at the
    wrong depth lies in the other picture where that shows something else.
    """
    if not np.isfinite(mixing.doubt):
        return np.ones(places[0].shape[:2], dtype=np.float32)
    smoothed = (
        np.asarray(cv2.GaussianBlur(image, (0, 0), mixing.smooth_px), dtype=np.float32)
        for image in (image.astype(np.float32) for image in images)
    )
    one, other = (_sampled(image, place) for image, place in zip(smoothed, places, strict=True))
    apart = np.abs(one - other).mean(axis=-1) / mixing.doubt
    alike = np.exp(-np.minimum(apart * apart, 60.0))
    return np.asarray(mixing.doubted + (1.0 - mixing.doubted) * alike, dtype=np.float32)


def left_behind(m: float, mixing: Mixing = Mixing()) -> float:
    """0 at a model's own key position, where its picture is what is seen, and 1 from `alone` on."""
    return _eased(m, mixing.alone)


def _eased(m: float, until: float) -> float:
    """From 0 at m = 0 to 1 from `until` on."""
    if until <= 0.0:
        return 1.0
    share = min(1.0, max(0.0, m / until))
    return share * share * (3.0 - 2.0 * share)


def _sampled(image: Image | NDArray[np.float32], uv: NDArray[np.floating]) -> NDArray[np.float32]:
    height, width = image.shape[:2]
    return sampled(image, uv * np.array([width, height], dtype=np.float32))


def mixed(own: Layer, other: Layer, m: float, mixing: Mixing = Mixing()) -> tuple[Image, NDArray[np.bool_]]:
    """Both layers as one picture."""
    total = np.zeros(own.weight.shape, dtype=np.float32)
    colour = np.zeros_like(own.colour)
    for layer, before, share in ((own, other, 1.0 - m), (other, own, m)):
        with np.errstate(invalid="ignore"):
            behind = np.nan_to_num(layer.depth / before.depth - 1.0, nan=0.0, posinf=1e3)
        solid = np.minimum(before.weight / mixing.solid, 1.0)
        hidden = left_behind(1.0 - share, mixing) * solid * (np.maximum(behind, 0.0) / mixing.tolerance) ** 2
        weight = layer.weight * max(share, mixing.floor) * np.exp(-np.minimum(hidden, 60.0))
        colour += weight[..., None] * layer.colour
        total += weight
    seen = total > 1e-9
    picture = colour / np.maximum(total, 1e-12)[..., None]
    if not seen.all():
        # Nothing was ever seen here: what is around it closes over the hole.
        picture = cv2.inpaint(np.clip(picture, 0, 255).astype(np.uint8), (~seen).astype(np.uint8), 3, cv2.INPAINT_TELEA).astype(np.float32)
    return np.clip(np.round(picture), 0, 255).astype(np.uint8), seen
