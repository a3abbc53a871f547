"""Cameras that are known: where the photos of the real sets were taken, and how far off we are."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.formats.colmap_text import read_images

Centres = Mapping[str, NDArray[np.float64]]


def fountain_centres(folder: Path) -> dict[str, NDArray[np.float64]]:
    """Of `fountain-P11/cameras`, in metres, by the photos' names.

    A file holds K (3 x 3), a row of zeros, R (3 x 3), the centre and the size.
    """
    found = {}
    for path in sorted(folder.glob("*.camera")):
        numbers = np.array(path.read_text().split(), dtype=np.float64)
        found[path.name.removesuffix(".camera")] = numbers[21:24]
    return found


def colmap_centres(images_txt: Path) -> dict[str, NDArray[np.float64]]:
    """Of a model in COLMAP's text format, in its own unit, by the photos' names."""
    images = read_images(images_txt, images_txt.read_bytes())
    return {
        image.name: -image.cam_from_world[:, :3].T @ image.cam_from_world[:, 3] for image in images
    }


def centre_errors(found: Centres, true: Centres) -> NDArray[np.float64]:
    """Distances of the found centres from the true ones after the best similarity, in their unit.

    Umeyama, Least-squares estimation of transformation parameters (PAMI 1991).
    """
    names = sorted(set(found) & set(true))
    ours = np.array([found[name] for name in names])
    theirs = np.array([true[name] for name in names])
    from_, to = ours - ours.mean(axis=0), theirs - theirs.mean(axis=0)
    left, sizes, right = np.linalg.svd(to.T @ from_)
    signs = np.array([1.0, 1.0, np.sign(np.linalg.det(left @ right))])
    rotation = left @ np.diag(signs) @ right
    scale = float((sizes * signs).sum() / (from_**2).sum())
    errors: NDArray[np.float64] = np.linalg.norm(scale * from_ @ rotation.T - to, axis=1)
    return errors


def extent(true: Centres) -> float:
    """The largest distance between two true centres."""
    places = np.array(list(true.values()))
    return float(np.linalg.norm(places[:, None] - places[None], axis=2).max())
