"""Depths by links along a sequence of photos: chapter 3 of Moslah's thesis."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.dense.document import DepthMap, Views, camera_row
from veduta.dense.read.neighbours import Comparison
from veduta.dense.read.rectifying import RectifiedPair, RectifyParameters, rectified_side
from veduta.dense.read.sparse import SparsePoints
from veduta.run.card import Engine

Disparities = NDArray[np.float32]
ChainStep = tuple[
    NDArray[np.float64], NDArray[np.float64], NDArray[np.float64], NDArray[np.float32]
]
"""The next view's camera, the two homographies of `veduta_stereo::link` (Rust), disparities."""
MOST_DISPARITIES = 1024
"""That `veduta_stereo::pair` (Rust) takes."""


@dataclass(frozen=True)
class LinkParameters:
    """Of `veduta_stereo::pair` and `link` (Rust).

    rows, gamma_colour, gamma_px: of a column that is gathered, and (3.2)'s constants (of 255; px).
    most_difference: colours that differ more count as this. path_step, path_jump: cost (of
    255 x 256) of a change of disparity along a row by one, and by more. confirmed_px: by which the
    way to the other picture and back may miss. near, far: the depths looked at, times the nearest
    and farthest sparse point. deviation_px: of one link. most_deviations: an estimate that is
    farther off is an outlier. most_across_px: distance of a spot from the pixel's epipolar line.
    most_links: up the sequence, and as many down. sure_share: deviation of the depth at which there
    is no confidence. The costs were chosen on the second pair of Merton College I.
    """

    rectify: RectifyParameters = field(default_factory=RectifyParameters)
    rows: int = 25
    gamma_colour: float = 40.0
    gamma_px: float = 15.0
    most_difference: int = 40
    path_step: int = 600
    path_jump: int = 12_000
    confirmed_px: float = 1.5
    near: float = 0.85
    far: float = 1.2
    deviation_px: float = 0.6
    most_deviations: float = 3.0
    most_across_px: float = 1.5
    most_links: int = 6
    sure_share: float = 0.05


@dataclass(frozen=True, eq=False)
class MatchedPair:
    """Two views in a row with the disparities of both, NaN where they do not confirm each other."""

    views: tuple[int, int]
    pair: RectifiedPair
    there: Disparities
    back: Disparities


def pair_range(
    sparse: SparsePoints,
    views: Views,
    two: tuple[int, int],
    pair: RectifiedPair,
    rule: LinkParameters,
) -> tuple[int, int] | str:
    """The least disparity of what both views may show (px), and how many there are; or why not."""
    index = np.union1d(sparse.visible[two[0]], sparse.visible[two[1]])
    ahead = (sparse.points_m[index] - views.cameras[two[0]].centre()) @ pair.turn[2]
    ahead = ahead[ahead > 0.0]
    if not len(ahead):
        return "no point that they show lies before them"
    near, far = np.quantile(ahead, [0.005, 0.995])
    return pair.disparities(float(near) * rule.near, float(far) * rule.far)


def match_views(
    views: Views,
    two: tuple[int, int],
    pair: RectifiedPair,
    tried: tuple[int, int],
    rule: LinkParameters,
    engine: Engine,
) -> tuple[Disparities, Disparities]:
    """Disparities of a pair, there and back, by dynamic programming; confirmed by each other.

    tried: the least disparity, and how many.
    """
    sides = [
        rectified_side(views, view, matrix, width, pair.height)
        for view, matrix, width in zip(two, pair.rectified, pair.widths, strict=True)
    ]
    low, count = tried
    there = disparities_of(sides[0], sides[1], (low, count), rule, engine)
    back = disparities_of(sides[1], sides[0], (1 - low - count, count), rule, engine)
    most = rule.confirmed_px
    return _core.confirm_pair(there, back, most), _core.confirm_pair(back, there, most)


def disparities_of(
    here: tuple[NDArray[np.uint8], NDArray[np.bool_]],
    there: tuple[NDArray[np.uint8], NDArray[np.bool_]],
    tried: tuple[int, int],
    rule: LinkParameters,
    engine: Engine,
    *,
    path: bool = True,
) -> Disparities:
    """(h, w) x there less x here (px), NaN where unknown. path: by dynamic programming along each
    row; else each pixel takes the disparity of least cost.
    """
    told = _core.PairRule(
        low=tried[0],
        count=tried[1],
        rows=rule.rows,
        gamma_colour=rule.gamma_colour,
        gamma_px=rule.gamma_px,
        most=rule.most_difference,
        path=(rule.path_step, rule.path_jump) if path else None,
    )
    given = (here[0], there[0], here[1], there[1])
    return engine.run(
        lambda card: card.match_pair(*given, told),
        lambda: _core.match_pair(*given, told),
        "pairs",
    )


def chains_of(
    view: int, pairs: Mapping[tuple[int, int], MatchedPair], order: list[int], most: int
) -> list[list[MatchedPair]]:
    """The pairs up the sequence from a view and down, each turned so that it leads away."""
    place = order.index(view)
    up: list[MatchedPair] = []
    for at in range(place, min(place + most, len(order) - 1)):
        found = pairs.get((order[at], order[at + 1]))
        if found is None:
            break
        up.append(found)
    down: list[MatchedPair] = []
    for at in range(place, max(place - most, 0), -1):
        found = pairs.get((order[at - 1], order[at]))
        if found is None:
            break
        swapped = (found.views[1], found.views[0])
        down.append(MatchedPair(swapped, found.pair.swapped(), found.back, found.there))
    return [up, down]


def linked_depths(
    views: Views,
    comparison: Comparison,
    chains: list[list[MatchedPair]],
    least: int,
    rule: LinkParameters,
    engine: Engine,
) -> DepthMap:
    """The depth map of a view (3.3, 3.4): NaN where fewer than `least` views agree in a chain."""
    camera = views.cameras[comparison.view]
    shape = (camera.height_px, camera.width_px)
    given = (
        camera_row(camera),
        camera.width_px,
        camera.height_px,
        [chain_steps(views, chain) for chain in chains],
    )
    told = _core.LinkRule(
        deviation_px=rule.deviation_px,
        most_deviations=rule.most_deviations,
        most_across_px=rule.most_across_px,
        near=comparison.near_m,
        far=comparison.far_m,
    )
    depths, deviations, estimates = engine.run(
        lambda card: card.link_views(*given, told),
        lambda: _core.link_views(*given, told),
        "links",
    )
    reachable = sum(len(chain) for chain in chains)
    good = estimates >= max(1, min(least, reachable))
    hidden = views.hidden(comparison.view)
    if hidden is not None:
        good &= ~hidden.ravel()
    known = np.where(good, depths, np.nan).astype(np.float32).reshape(shape)
    share = np.where(good, deviations * np.nan_to_num(depths) / rule.sure_share, 1.0)
    sure = np.clip(1.0 - share, 0.0, 1.0).astype(np.float32).reshape(shape)
    return DepthMap(
        known, normals_from(known, views, comparison.view), sure, estimates.reshape(shape)
    )


def chain_steps(views: Views, chain: list[MatchedPair]) -> list[ChainStep]:
    """What `link_views` takes of a chain."""
    return [_step(views, one) for one in chain]


def _step(views: Views, one: MatchedPair) -> ChainStep:
    there, back = one.pair.rectified[0], np.linalg.inv(one.pair.rectified[1])
    row = camera_row(views.cameras[one.views[1]])
    return row, there / np.linalg.norm(there[2]), back / np.linalg.norm(back[2]), one.there


def normals_from(depths: NDArray[np.float32], views: Views, view: int) -> NDArray[np.float32]:
    """(pixels, 3) unit normals in the camera's frame, from the depths beside each pixel; towards
    the camera where there are none.
    """
    height, width = depths.shape
    camera = views.cameras[view]
    x, y = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
    rays = np.stack(
        [
            (x - camera.centre_px[0]) / camera.focal_px[0],
            (y - camera.centre_px[1]) / camera.focal_px[1],
            np.ones((height, width)),
        ],
        axis=-1,
    )
    points = rays * depths[:, :, None]
    down, right = np.gradient(points, axis=(0, 1))
    normals = np.cross(down, right)
    length = np.linalg.norm(normals, axis=-1, keepdims=True)
    with np.errstate(invalid="ignore", divide="ignore"):
        normals = normals / length
    away = np.sum(normals * rays, axis=-1, keepdims=True) > 0.0
    normals = np.where(away, -normals, normals)
    facing = -rays / np.linalg.norm(rays, axis=-1, keepdims=True)
    found = np.where(np.isfinite(normals).all(axis=-1, keepdims=True), normals, facing)
    return np.ascontiguousarray(found.reshape(-1, 3), dtype=np.float32)
