"""The visual hull: signed evidence by the distances to the silhouettes' outlines."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.carve.build.bounds import Bounds
from veduta.carve.views import Mask, View, camera_rows
from veduta.run.card import Engine

Floats = NDArray[np.float64]
HULL = "hull"


@dataclass(frozen=True)
class HullRule:
    """margin: of the volume's side, that is left around the bounds. band: of the silhouette's larger
    side, how far around its box distances are kept. beyond: of the photo's larger side, how far a
    silhouette that leaves the photo is thought to go on. trial_levels: so much coarser is the hull by
    which `--device auto` tries whether the card is faster.
    """

    margin: float = 0.02
    band: float = 0.1
    beyond: float = 0.5
    trial_levels: int = 1


@dataclass(frozen=True, eq=False)
class Root:
    """The cube that is carved: its lower corner and its side (m), and 2^levels voxels along it."""

    low_m: Floats
    side_m: float
    levels: int

    @property
    def voxel_m(self) -> float:
        """The side of a voxel."""
        return self.side_m / float(2**self.levels)


@dataclass(frozen=True, eq=False)
class Hull:
    """The carved volume, and the cube that it fills."""

    root: Root
    volume: _core.CarvedVolume

    def surface(self) -> tuple[Floats, NDArray[np.uint32]]:
        """Vertices (v, 3) in metres and triangles (m, 3): closed, 2-manifold, facing outwards."""
        positions, triangles = self.volume.surface()
        first = self.root.low_m + 0.5 * self.root.voxel_m
        return positions * self.root.voxel_m + first, triangles


def root_of(bounds: Bounds, levels: int, rule: HullRule | None = None) -> Root:
    """The cube about a box."""
    rule = rule or HullRule()
    side = float(bounds.size_m.max()) * (1.0 + 2.0 * rule.margin)
    return Root((bounds.low_m + bounds.high_m - side) / 2.0, side, levels)


def carve_hull(
    views: Sequence[View], root: Root, rule: HullRule | None = None, engine: Engine | None = None
) -> Hull:
    """What all silhouettes together leave of the cube (4.3.2). engine: the processor if not given."""
    rule = rule or HullRule()
    fields = [outline_distances(view.mask, rule) for view in views]
    given = (
        camera_rows([view.camera for view in views]),
        [distances for distances, _ in fields],
        np.array([corner for _, corner in fields], dtype=np.float64),
        root.low_m.tolist(),
        root.side_m,
    )
    if engine is None:
        return Hull(root, _core.carve_hull(*given, root.levels))
    if engine.device == "auto" and engine.card is not None:
        coarse = max(root.levels - rule.trial_levels, 5)
        engine.trial(
            HULL,
            lambda card: card.carve_hull(*given, coarse),
            lambda: _core.carve_hull(*given, coarse),
        )
    volume = engine.run(
        lambda card: card.carve_hull(*given, root.levels),
        lambda: _core.carve_hull(*given, root.levels),
        HULL,
    )
    return Hull(root, volume)


def outline_distances(
    mask: Mask, rule: HullRule | None = None
) -> tuple[NDArray[np.float32], tuple[float, float]]:
    """Distances to the outline (px, less than zero inside) about a silhouette, and where they begin.

    A silhouette that the photo's border cuts goes on beyond it: what is not seen is not carved.
    """
    rule = rule or HullRule()
    height, width = mask.shape
    pad = 0
    if mask[0].any() or mask[-1].any() or mask[:, 0].any() or mask[:, -1].any():
        pad = round(rule.beyond * max(height, width))
    one = np.asarray(mask, dtype=np.uint8)
    whole = cv2.copyMakeBorder(one, pad, pad, pad, pad, cv2.BORDER_REPLICATE)
    rows, columns = np.flatnonzero(whole.any(axis=1)), np.flatnonzero(whole.any(axis=0))
    if not len(rows):
        return np.full((1, 1), np.float32(max(height, width))), (0.0, 0.0)
    band = 4 + round(rule.band * max(len(rows), len(columns)))
    top, left = max(int(rows[0]) - band, 0), max(int(columns[0]) - band, 0)
    part = whole[top : int(rows[-1]) + band + 1, left : int(columns[-1]) + band + 1]
    inner = cv2.distanceTransform(part, cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
    outer = cv2.distanceTransform(1 - part, cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
    most = float(sum(part.shape))  # where there is no outline, the distance to it has no meaning
    signed = np.where(part > 0, 0.5 - inner, outer - 0.5).clip(-most, most).astype(np.float32)
    return np.ascontiguousarray(signed), (float(left - pad), float(top - pad))
