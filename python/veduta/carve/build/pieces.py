"""Loose crumbs of a hull: pieces that no silhouette asks for are left out."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.carve.views import View, camera_rows
from veduta.surfaces import compact, vertex_pieces

Floats = NDArray[np.float64]
Triangles = NDArray[np.uint32]


@dataclass(frozen=True)
class PiecesRule:
    """small: of the largest piece's volume, under which a piece is a crumb; larger ones always stay.
    alone_px: pixels of a silhouette that a crumb alone must fill to belong to the object, in
    least_views views.
    """

    small: float = 0.01
    alone_px: int = 12
    least_views: int = 2


@dataclass(frozen=True, eq=False)
class Pieces:
    """positions (v, 3), triangles (m, 3): of what stays. pieces: that stay. dropped: crumbs that are
    left out. dropped_share: their volume, of that which stays.
    """

    positions: Floats
    triangles: Triangles
    pieces: int
    dropped: int
    dropped_share: float


def without_crumbs(
    positions: Floats, triangles: Triangles, views: Sequence[View], rule: PiecesRule | None = None
) -> Pieces:
    """The closed mesh without pieces that are small and fill no silhouette that the others leave open.

    A closed hollow in the object, which no photo can show, is such a piece, too.
    """
    rule = rule or PiecesRule()
    label = vertex_pieces(triangles, len(positions))[triangles[:, 0]]
    corners = positions[triangles] - positions.mean(axis=0)
    cross = np.cross(corners[:, 1], corners[:, 2])
    volume = np.bincount(label, (corners[:, 0] * cross).sum(axis=1) / 6.0)
    small = volume < rule.small * volume.max()
    if not small.any():
        return Pieces(positions, triangles, len(volume), 0, 0.0)
    kept = ~small
    kept[_asked_for(positions, triangles, label, small, views, rule)] = True
    share = float(np.abs(volume[~kept]).sum() / volume[kept].sum())
    left = compact(positions, triangles[kept[label]])
    return Pieces(*left, int(kept.sum()), int((~kept).sum()), share)


def _asked_for(
    positions: Floats,
    triangles: Triangles,
    label: NDArray[np.int32],
    small: NDArray[np.bool_],
    views: Sequence[View],
    rule: PiecesRule,
) -> NDArray[np.bool_]:
    """(pieces,) the small ones that fill pixels of silhouettes which no large piece fills."""
    sizes = [(view.camera.width_px, view.camera.height_px) for view in views]
    rows = camera_rows([view.camera for view in views])
    whole = _core.seen_triangles(rows, sizes, positions, triangles)
    large = _core.seen_triangles(rows, sizes, positions, triangles[~small[label]])
    count = np.zeros(len(small), dtype=np.int64)
    for view, every, main in zip(views, whole, large, strict=True):
        alone = (every >= 0) & (main < 0) & view.mask
        pixels = np.bincount(label[every[alone]], minlength=len(small))
        count += pixels >= rule.alone_px
    return np.asarray(small & (count >= rule.least_views))
