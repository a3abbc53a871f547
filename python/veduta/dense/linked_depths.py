"""The depth maps of a run by linking; each pair and each map is on disk as soon as it is made."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from pydantic import JsonValue

from veduta.dense.document import DepthMap, Views
from veduta.dense.parameters import DenseParameters
from veduta.dense.read.linking import (
    MOST_DISPARITIES,
    MatchedPair,
    chains_of,
    linked_depths,
    match_views,
    pair_range,
)
from veduta.dense.read.neighbours import Comparison
from veduta.dense.read.rectifying import RectifiedPair, rectify_pair
from veduta.dense.read.sparse import SparsePoints
from veduta.dense.stages import (
    Arrays,
    OnDisk,
    depth_arrays,
    depth_map_of,
    kept_reader,
    told,
)
from veduta.run.card import Engine, tell_engine
from veduta.run.errors import NotFoundError
from veduta.run.work import Work


@dataclass(frozen=True, eq=False)
class Linking:
    """What the depth maps of a run are made from.

    inputs: digests of all that they depend on besides the parameters. agree: other photos that must
    show a depth, too.
    """

    views: Views
    comparisons: list[Comparison]
    sparse: SparsePoints
    inputs: JsonValue
    agree: int
    parameters: DenseParameters
    engine: Engine


def all_linked_depths(work: Work, linking: Linking) -> dict[int, Callable[[], DepthMap]]:
    """For each compared view, what reads its depth map from disk.

    NotFoundError where no two photos in a row can be matched.
    """
    order = [one.view for one in linking.comparisons]
    pairs = _pairs(work, linking, order)
    if not pairs:
        raise NotFoundError(
            "depths",
            f"no two of the {len(order)} photos in a row can be rectified",
            "Name the photos in the order of the walk, or use --method patchmatch.",
        )
    found: dict[int, Callable[[], DepthMap]] = {}
    with work.step("links") as step:
        for done, comparison in enumerate(linking.comparisons):
            work.progress("links", done / len(linking.comparisons))
            found[comparison.view] = _linked(work, linking, comparison, pairs, order)
            known = found[comparison.view]().known
            name = linking.views.cameras[comparison.view].name
            step.counts[f"known_{name}"] = round(float(known.mean()), 4)
    tell_engine(work, linking.engine)
    return found


def _pairs(work: Work, linking: Linking, order: list[int]) -> Mapping[tuple[int, int], MatchedPair]:
    found: dict[tuple[int, int], Callable[[], MatchedPair]] = {}
    views, rule = linking.views, linking.parameters.link
    with work.step("pairs") as step:
        tried: list[JsonValue] = []
        for done, two in enumerate(zip(order[:-1], order[1:], strict=True)):
            work.progress("pairs", done / max(1, len(order) - 1))
            names = " and ".join(views.cameras[one].name for one in two)
            pair = rectify_pair(views.cameras[two[0]], views.cameras[two[1]], rule.rectify)
            if isinstance(pair, str):
                step.rejected.append(f"{names}: {pair}")
                continue
            span = pair_range(linking.sparse, views, two, pair, rule)
            if isinstance(span, str):
                step.rejected.append(f"{names}: {span}")
                continue
            low, count = span
            if count > MOST_DISPARITIES:
                step.rejected.append(f"{names}: {count} disparities are too many to try")
                continue
            tried.append([low, low + count - 1])
            found[two] = _matched(work, linking, two, pair, (low, count))
        step.counts["pairs"] = len(found)
    work.measure("disparities_px", tried)
    if len(found) < len(order) - 1 and found:
        missing = len(order) - 1 - len(found)
        work.doubt(f"{missing} pairs in a row are not matched: chains end there")
    return OnDisk(found)


def _matched(
    work: Work,
    linking: Linking,
    two: tuple[int, int],
    pair: RectifiedPair,
    tried: tuple[int, int],
) -> Callable[[], MatchedPair]:
    rule = linking.parameters.link

    def make() -> Arrays:
        there, back = match_views(linking.views, two, pair, tried, rule, linking.engine)
        return {"there": there, "back": back}

    key: JsonValue = [linking.inputs, list(two), list(tried), told(rule)]
    read = kept_reader(work, f"pair-{two[0]:04d}", key, make)

    def matched() -> MatchedPair:
        arrays = read()
        return MatchedPair(two, pair, np.asarray(arrays["there"]), np.asarray(arrays["back"]))

    return matched


def _linked(
    work: Work,
    linking: Linking,
    comparison: Comparison,
    pairs: Mapping[tuple[int, int], MatchedPair],
    order: list[int],
) -> Callable[[], DepthMap]:
    rule = linking.parameters.link
    chains = chains_of(comparison.view, pairs, order, rule.most_links)

    def make() -> Arrays:
        return depth_arrays(
            linked_depths(linking.views, comparison, chains, linking.agree, rule, linking.engine)
        )

    ends: list[JsonValue] = [[*one.views] for chain in chains for one in chain]
    ranges: list[JsonValue] = [comparison.near_m, comparison.far_m]
    key: JsonValue = [linking.inputs, comparison.view, ends, ranges, linking.agree, told(rule)]
    read = kept_reader(work, f"linked-{comparison.view:04d}", key, make)
    return lambda: depth_map_of(read())
