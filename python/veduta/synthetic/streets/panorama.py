"""Panoramas all around (equirectangular) of a scene: six rendered faces of a cube, joined."""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence
from datetime import datetime, timedelta

import cv2
import numpy as np
from numpy.typing import NDArray
from PIL import Image

from veduta.synthetic.camera import Camera
from veduta.synthetic.light import Light
from veduta.synthetic.photo import Lens, develop
from veduta.synthetic.render import render
from veduta.synthetic.scene import RayScene
from veduta.synthetic.seeds import stream

XMP = b'<x:xmpmeta><rdf:Description GPano:ProjectionType="equirectangular"/></x:xmpmeta>'
"""What says in a file that it is one."""
MARGIN = 1.02
"""Half the width of a face over its distance: faces overlap, so that no seam is interpolated."""
_FACES = np.array(
    [
        [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
        [[0, 0, -1], [0, 1, 0], [1, 0, 0]],
        [[-1, 0, 0], [0, 1, 0], [0, 0, -1]],
        [[0, 0, 1], [0, 1, 0], [-1, 0, 0]],
        [[1, 0, 0], [0, 0, 1], [0, -1, 0]],
        [[1, 0, 0], [0, 0, -1], [0, 1, 0]],
    ],
    dtype=np.float64,
)
"""(6, 3, 3) each face's axes (right, down, ahead) in those of the panorama, as rows."""
_START = datetime(2024, 5, 17, 9, 30)


def panoramas_of(
    scene: RayScene,
    light: Light,
    poses: Sequence[NDArray[np.float64]],
    width_px: int,
    seed: int,
    samples: int = 2,
) -> Iterator[tuple[bytes, NDArray[np.uint8]]]:
    """The JPEG file and the pixels (w/2, w, 3) of each, one after the other.

    poses: (4, 4) of the panorama from the world; its x is right, y down, z to its middle.
    """
    for row, pose in enumerate(poses):
        number = int(stream(seed, f"panorama {row}").integers(2**31))
        radiance = _radiance(scene, light, pose, width_px, number, samples)
        pixels = develop(radiance, Lens(exposure=0.0, tint=(1.0, 1.0, 1.0), noise=0.006), number)
        exif = Image.Exif()
        exif[306] = (_START + timedelta(seconds=9 * row)).strftime("%Y:%m:%d %H:%M:%S")
        held = io.BytesIO()
        Image.fromarray(pixels).save(held, "JPEG", quality=94, xmp=XMP, exif=exif)
        yield held.getvalue(), pixels


def rays_of(width_px: int) -> NDArray[np.float64]:
    """(w/2, w, 3) unit rays through the pixels' centres, in the panorama's axes."""
    longitude = ((np.arange(width_px) + 0.5) / width_px - 0.5) * 2.0 * np.pi
    latitude = (0.5 - (np.arange(width_px // 2) + 0.5) / (width_px // 2)) * np.pi
    lon, lat = np.meshgrid(longitude, latitude)
    return np.stack([np.cos(lat) * np.sin(lon), -np.sin(lat), np.cos(lat) * np.cos(lon)], axis=2)


def _radiance(
    scene: RayScene,
    light: Light,
    pose: NDArray[np.float64],
    width_px: int,
    number: int,
    samples: int,
) -> NDArray[np.float32]:
    """(w/2, w, 3) linear: each pixel from the face that its ray meets."""
    side = width_px // 3
    focal = side / (2.0 * MARGIN)
    rays = rays_of(width_px)
    nearest = np.einsum("hwc,fc->hwf", rays, _FACES[:, 2]).argmax(axis=2)
    found = np.zeros((*nearest.shape, 3), np.float32)
    for face, axes in enumerate(_FACES):
        turn = np.eye(4)
        turn[:3, :3] = axes
        camera = Camera(side, side, focal, (side / 2, side / 2), turn @ pose)
        shown = np.ascontiguousarray(render(scene, camera, light, samples, number + face))
        local = rays @ axes.T
        with np.errstate(divide="ignore", invalid="ignore"):
            x = (focal * local[..., 0] / local[..., 2] + side / 2 - 0.5).astype(np.float32)
            y = (focal * local[..., 1] / local[..., 2] + side / 2 - 0.5).astype(np.float32)
        sampled = cv2.remap(shown, x, y, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
        own = nearest == face
        found[own] = sampled[own]
    return found
