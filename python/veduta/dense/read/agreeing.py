"""The depths on which views agree, each with a confidence."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.dense.document import DepthMap, Views, camera_row
from veduta.dense.read.matching import Planes, depths_of, normals_of
from veduta.dense.read.neighbours import Comparison


@dataclass(frozen=True)
class AgreeParameters:
    """most_px: by which the way to another view's depth and back may miss. most_share: by which the
    depths may differ. most_cost: (1 - NCC, with what neighbours say) of a depth that is kept;
    2.3 is a view that does not see it, and a pixel at the side of a street has one that does.
    most_far: of the farthest depth that is looked at, 1.8 times the farthest point: what has no
    parallax because it moves with the cameras (a car's own mast) ends up beyond it.
    """

    most_px: float = 1.5
    most_share: float = 0.01
    most_cost: float = 1.4
    most_far: float = 0.9


def agreed_depths(
    views: Views,
    comparison: Comparison,
    planes: Mapping[int, Planes],
    least: int,
    parameters: AgreeParameters,
) -> DepthMap:
    """The depth map of a view: NaN where fewer than `least` other views agree."""
    shown = [comparison.view, *(one for one in comparison.neighbours if one in planes)]
    shapes = [(views.cameras[one].height_px, views.cameras[one].width_px) for one in shown]
    depths = [depths_of(planes[one], shape) for one, shape in zip(shown, shapes, strict=True)]
    rows = np.stack([camera_row(views.cameras[one]) for one in shown])
    agree = _core.agreeing_views(
        depths, rows, most_px=parameters.most_px, most_share=parameters.most_share
    ).reshape(shapes[0])
    own = planes[comparison.view]
    cost = own[:, 3].reshape(shapes[0])
    needed = min(least, len(shown) - 1)
    good = (agree >= max(needed, 1)) & (cost < parameters.most_cost)
    good &= depths[0] < parameters.most_far * comparison.far_m
    hidden = views.hidden(comparison.view)
    if hidden is not None:
        good &= ~hidden
    known = np.where(good, depths[0], np.nan).astype(np.float32)
    return DepthMap(
        known,
        normals_of(own, rows[0], shapes[0]),
        _confidence(cost, agree, len(shown) - 1, good),
        agree,
    )


def _confidence(
    cost: NDArray[np.float32], agree: NDArray[np.uint8], others: int, good: NDArray[np.bool_]
) -> NDArray[np.float32]:
    """How alike the windows are, times the share of the views that agree; 0 where unknown."""
    share = agree / max(others, 1)
    sure = np.clip(1.0 - cost, 0.0, 1.0) * share
    return np.where(good, sure, 0.0).astype(np.float32)
