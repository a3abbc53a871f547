"""What a view between two key positions can be made of besides: five peers."""

from __future__ import annotations

from dataclasses import replace

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta._core import walk_rasterise
from veduta.walk.build.mesh import MorphMesh
from veduta.walk.build.morph import inverse
from veduta.walk.build.render import Layer, Mixing, chained, draw_mesh, mixed
from veduta.walk.build.sampling import sampled
from veduta.walk.build.screen import Screen
from veduta.walk.rig import Image

Matrix = NDArray[np.float64]


def cross_fade(first: Image, second: Image, share: float) -> Image:
    """(a) both pictures, one over the other."""
    return _bytes((1.0 - share) * first.astype(np.float32) + share * second.astype(np.float32))


def dis_flow(first: Image, second: Image, share: float) -> Image:
    """(d) both pictures moved by OpenCV's DIS flow between them."""
    grey = [cv2.cvtColor(image, cv2.COLOR_RGB2GRAY) for image in (first, second)]
    finder = cv2.DISOpticalFlow.create(cv2.DISOPTICAL_FLOW_PRESET_MEDIUM)
    forth = np.asarray(finder.calc(grey[0], grey[1], np.zeros((*grey[0].shape, 2), np.float32)))
    back = np.asarray(finder.calc(grey[1], grey[0], np.zeros((*grey[0].shape, 2), np.float32)))
    pixels = Screen(first.shape[1], first.shape[0], (1.0, 1.0), (0.0, 0.0)).pixels
    own = sampled(first, pixels - share * forth)
    other = sampled(second, pixels - (1.0 - share) * back)
    return _bytes((1.0 - share) * own + share * other)


def nearest_model(
    meshes: tuple[MorphMesh, MorphMesh], images: tuple[Image, Image], poses: tuple[Matrix, Matrix],
    share: float, screen: Screen,
) -> Image:  # fmt: skip
    """(b) the nearer local model as it is. poses: cam_from_first and cam_from_second."""
    which = 0 if share <= 0.5 else 1
    still = _still(meshes[which], poses[which], screen, images[which])
    return mixed(still, replace(still, weight=np.zeros_like(still.weight)), 0.0)[0]


def both_depths(
    meshes: tuple[MorphMesh, MorphMesh], images: tuple[Image, Image], poses: tuple[Matrix, Matrix],
    share: float, screen: Screen,
) -> Image:  # fmt: skip
    """(e) both local models as they are, moved by their poses and blended."""
    layers = [
        _still(mesh, pose, screen, image)
        for mesh, pose, image in zip(meshes, poses, images, strict=True)
    ]
    return mixed(layers[0], layers[1], share)[0]


def flat_morph(
    meshes: tuple[MorphMesh, MorphMesh], images: tuple[Image, Image], share: float, screen: Screen
) -> Image:
    """(c) the same counterparts and colours, moved in the plane of the pictures."""
    layers = []
    for number, mesh in enumerate(meshes):
        m = share if number == 0 else 1.0 - share
        size = np.array([screen.width_px, screen.height_px])
        placed = ((1.0 - m) * mesh.uv + m * mesh.uv_second) * size
        flat = np.column_stack([placed, mesh.points[:, 2]]).astype(np.float32)
        carried = np.column_stack([mesh.uv, mesh.uv_second, mesh.psi]).astype(np.float32)
        depth, values, which = walk_rasterise(
            flat, carried, mesh.triangles, screen.width_px, screen.height_px, near=0.1
        )
        shaped = values.reshape(screen.height_px, screen.width_px, 5)
        psi = (m * shaped[..., 4])[..., None]
        own = sampled(images[number], shaped[..., :2] * size.astype(np.float32))
        other = sampled(images[1 - number], shaped[..., 2:4] * size.astype(np.float32))
        torn = mesh.torn[np.maximum(which, 0)]
        weight = np.where(torn, Mixing().torn, 1.0) * (which >= 0)
        colour = ((1.0 - psi) * own + psi * other).astype(np.float32)
        layers.append(Layer(colour, weight.astype(np.float32), np.where(which >= 0, 1.0, depth)))
    return mixed(layers[0], layers[1], share)[0]


def second_pose(cam_from_first: Matrix, second_from_first: Matrix) -> Matrix:
    """cam_from_second."""
    return chained(cam_from_first, inverse(second_from_first))


def _still(mesh: MorphMesh, pose: Matrix, screen: Screen, image: Image) -> Layer:
    nowhere = np.column_stack([np.eye(3), np.zeros(3)])
    # Nothing is held against the other picture.
    mixing = Mixing(alone=0.0, doubt=np.inf)
    return draw_mesh(mesh, 0.0, nowhere, pose, screen, image, image, mixing)


def _bytes(values: NDArray[np.floating]) -> Image:
    return np.clip(np.round(values), 0, 255).astype(np.uint8)
