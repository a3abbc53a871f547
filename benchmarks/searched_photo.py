"""The photo on which the depth search of `veduta dense` is timed, with what it is compared with."""

from __future__ import annotations

from pathlib import Path

from veduta.cameras import read_cameras
from veduta.dense.document.views import Views
from veduta.dense.read.matching import MatchParameters, Planes, match_coarse
from veduta.dense.read.neighbours import Comparison, NeighbourParameters, choose_neighbours
from veduta.dense.read.pictures import open_views, usable_cameras
from veduta.dense.read.sparse import SparsePoints
from veduta.run.card import Engine

NEIGHBOURS, SEED = 4, 7


def middle_photo(found: Path, size_px: int) -> tuple[Views, Comparison, dict[int, Comparison]]:
    """Views of this width of a result of `veduta photos`, the middle one, and all by their view."""
    given = read_cameras(found)
    usable, _ = usable_cameras(given)
    if given.points is None or given.visible is None:
        raise SystemExit(f"{found} has no points: `veduta photos` writes it with them")
    views = open_views(usable, size_px / max(one.width_px for one in usable), {})
    sparse = SparsePoints(given.points, given.visible)
    comparisons, _ = choose_neighbours(views, sparse, NEIGHBOURS, NeighbourParameters())
    return views, comparisons[len(comparisons) // 2], {one.view: one for one in comparisons}


def coarse_planes(
    views: Views,
    middle: Comparison,
    by_view: dict[int, Comparison],
    engine: Engine,
    rule: MatchParameters,
) -> dict[int, Planes]:
    """Of the neighbours, and of the middle photo last."""
    return {
        view: match_coarse(views, by_view[view], SEED, rule, engine)
        for view in (*middle.neighbours, middle.view)
    }
