"""The record of a second view: silhouettes as pictures of two values, or footage."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

from veduta.fauna.read.footage import VIDEOS, read_footage
from veduta.fauna.read.limbless import silhouettes_in
from veduta.fauna.read.second_view import Mask, SecondView
from veduta.imaging.read import SUFFIXES, read_image
from veduta.run.errors import InputError


@dataclass(frozen=True)
class SilhouettePictures:
    """What a picture of a silhouette is."""

    flat: int = 8
    """Grey levels from black or white within which a pixel of a silhouette lies."""
    two_valued: float = 0.98
    """And so many of its pixels do."""
    smallest: float = 5e-4
    """An animal covers this share of a picture at least."""


def read_second_view(path: Path, looks: SilhouettePictures) -> SecondView:
    """A silhouette, a folder of some, or footage.

    InputError names what cannot be used; NotFoundError: no animal is in the footage.
    """
    pictures = _pictures(path)
    found = [mask for one in pictures if (mask := _silhouette(one, looks)) is not None]
    if found and len(found) == len(pictures):
        return SecondView(tuple(found), path.name)
    if found:
        fault = f"has {len(found)} silhouettes among {len(pictures)} pictures"
        raise InputError(path, fault, "Give silhouettes alone (white where the animal is).")
    if path.is_file() and path.suffix.lower() not in VIDEOS:
        fault = "is no silhouette: one photo does not tell the animal from what is behind it"
        raise InputError(path, fault, "Give a picture that is white where it is, or footage.")
    silhouettes, _ = silhouettes_in(read_footage(path, None), None, None, path.name)
    return SecondView(tuple(silhouettes.masks), path.name)


def _pictures(path: Path) -> list[Path]:
    """The pictures of a folder, or the one that the path is; none of a film."""
    if path.is_dir():
        found = sorted(one for one in path.iterdir() if one.suffix.lower() in SUFFIXES)
        if not found:
            raise InputError(path, "has no pictures", "Give silhouettes, or frames of footage.")
        return found
    return [] if path.suffix.lower() in VIDEOS else [path]


def _silhouette(path: Path, looks: SilhouettePictures) -> Mask | None:
    """The largest white thing of a picture of two values; None where it is a photo."""
    pixels = read_image(path).pixels
    light = pixels.min(axis=2) > 255 - looks.flat
    dark = pixels.max(axis=2) < looks.flat
    if float((light | dark).mean()) < looks.two_valued:
        return None
    white = (pixels.max(axis=2) > 127).astype(np.uint8)
    _, labels, stats, _ = cv2.connectedComponentsWithStats(white, connectivity=8)
    areas = stats[1:, cv2.CC_STAT_AREA]
    if not len(areas) or areas.max() < looks.smallest * white.size:
        fault = "shows no animal: nothing in it is white"
        raise InputError(path, fault, "Give a picture that is white where the animal is.")
    if areas.max() > 0.98 * white.size:
        fault = "is white all over"
        raise InputError(path, fault, "Give a picture that is black where the animal is not.")
    return np.asarray(labels == int(areas.argmax()) + 1)
