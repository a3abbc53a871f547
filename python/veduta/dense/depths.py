"""The depth maps of a run, step by step; each is on disk as soon as it is made."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from pydantic import JsonValue

from veduta.dense.document import DepthMap, Views
from veduta.dense.parameters import DenseParameters
from veduta.dense.read.agreeing import agreed_depths
from veduta.dense.read.matching import Planes, match_coarse, match_fine
from veduta.dense.read.neighbours import Comparison
from veduta.dense.stages import (
    Arrays,
    OnDisk,
    depth_arrays,
    depth_map_of,
    kept_reader,
    told,
)
from veduta.run.card import Engine, tell_engine
from veduta.run.report import StepRecord
from veduta.run.work import Work

PLANES = "planes"


@dataclass(frozen=True, eq=False)
class Matching:
    """What the depth maps of a run are made from.

    inputs: digests of all that they depend on besides the parameters. agree: other photos that must
    show a depth, too.
    """

    views: Views
    comparisons: list[Comparison]
    inputs: JsonValue
    agree: int
    seed: int
    parameters: DenseParameters
    engine: Engine


def all_depth_maps(work: Work, matching: Matching) -> dict[int, Callable[[], DepthMap]]:
    """For each compared view, what reads its depth map from disk."""
    with work.step("coarse depths") as step:
        coarse = _planes(work, matching, step, "coarse", None)
    with work.step("fine depths") as step:
        fine = _planes(work, matching, step, "fine", coarse)
    tell_engine(work, matching.engine)
    found: dict[int, Callable[[], DepthMap]] = {}
    with work.step("agreement") as step:
        for done, comparison in enumerate(matching.comparisons):
            work.progress("agreement", done / len(matching.comparisons))
            found[comparison.view] = _agreed(work, matching, comparison, fine)
            known = found[comparison.view]().known
            name = matching.views.cameras[comparison.view].name
            step.counts[f"known_{name}"] = round(float(known.mean()), 4)
    return found


def _key(matching: Matching, comparison: Comparison, *parameters: object) -> JsonValue:
    row: list[JsonValue] = [*comparison.neighbours]
    ranges: list[JsonValue] = [comparison.near_m, comparison.far_m, matching.engine.told]
    steps: list[JsonValue] = [told(one) for one in parameters]
    return [matching.inputs, comparison.view, row, ranges, matching.seed, steps]


def _planes(
    work: Work,
    matching: Matching,
    step: StepRecord,
    name: str,
    coarse: Mapping[int, Planes] | None,
) -> Mapping[int, Planes]:
    """The planes of every view; with the coarse ones given, the fine ones."""
    found: dict[int, Callable[[], Planes]] = {}
    match, views = matching.parameters.match, matching.views

    def make(comparison: Comparison) -> Callable[[], Arrays]:
        seed, engine = matching.seed, matching.engine
        if coarse is None:
            return lambda: {PLANES: match_coarse(views, comparison, seed, match, engine)}
        return lambda: {PLANES: match_fine(views, comparison, coarse, seed, match, engine)}

    for done, comparison in enumerate(matching.comparisons):
        work.progress(f"{name} depths", done / len(matching.comparisons))
        stage = f"{name}-{comparison.view:04d}"
        read = kept_reader(work, stage, _key(matching, comparison, match), make(comparison))
        found[comparison.view] = _planes_of(read)
    step.counts["views"] = len(found)
    return OnDisk(found)


def _planes_of(read: Callable[[], Arrays]) -> Callable[[], Planes]:
    return lambda: read()[PLANES]


def _agreed(
    work: Work, matching: Matching, comparison: Comparison, fine: Mapping[int, Planes]
) -> Callable[[], DepthMap]:
    parameters = matching.parameters

    def make() -> Arrays:
        return depth_arrays(
            agreed_depths(matching.views, comparison, fine, matching.agree, parameters.agree)
        )

    key: JsonValue = [
        _key(matching, comparison, parameters.match, parameters.agree),
        matching.agree,
    ]
    read = kept_reader(work, f"agreed-{comparison.view:04d}", key, make)
    return lambda: depth_map_of(read())
