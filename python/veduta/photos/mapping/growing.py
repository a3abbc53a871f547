"""Growing one component photo by photo, with what is grown so far kept on the disk.

The engine registers the photos (incremental structure from motion, Schoenberger and Frahm, CVPR
2016); this file has its first pair, and its snapshots. After each photo the model is written whole
beside the earlier one, which then goes: a run that is killed begins again from the last photo but
one.
"""

from __future__ import annotations

import shutil
import time
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import combinations
from pathlib import Path
from typing import Literal

import numpy as np
import pycolmap

from veduta.photos.mapping.grown import Grown, read_grown, write_grown
from veduta.photos.mapping.initial_pair import (
    FEWEST,
    LEAST_ANGLE_AHEAD_DEG,
    LEAST_ANGLE_DEG,
    Start,
    WeighedPair,
    weighed_pair,
    weighed_pairs,
)
from veduta.photos.matching.match import KNOWN_MODEL
from veduta.run.threads import available_cores

MOST_TRIED = 8
"""Pairs that meet the conditions from which growing is tried, before the engine chooses."""
MOST_AHEAD = 6
"""Pairs of a camera that moved ahead from which growing is tried, until one places all."""
MANY = 100
"""Matches off a plane that make a small angle sure: pairs ahead with fewer come last."""
RELAXED = ((100, 16.0), (50, 16.0), (50, 8.0), (25, 8.0), (25, 4.0))
"""What the engine asks of a first pair that it chooses, in turn: agreeing features, and degrees
between its rays."""
PLACING = 0.004
"""How far off what a photo is placed by may lie, as a share of the photos' longer side. The
engine's 12 px let a photo of 1000 px that shows nothing of the model but a distant wall come to lie
turned about it, and all that follows with it."""
PLACING_PX = (4.0, 12.0)
"""But no less and no more."""
WRITING_SHARE = 0.2
"""Share of the time that snapshots may take: where a large model takes long to write, they are
rarer than one a photo."""
SHORT_S = 0.25
"""Writing that takes no longer is done after each photo."""

RigKind = Literal["none", "adjusted", "held"]


@dataclass(frozen=True)
class Growth:
    """What `grow` needs. smallest: photos that a component must have.

    image_ids: the photos that wait for one, which are those of the cache. snapshots: a folder of
    its own, which may hold what an earlier run left. rig: whether the database has one, and whether
    how its cameras are fixed is adjusted with the rest. focal_held: whether focal lengths stay.
    """

    database: Path
    image_ids: tuple[int, ...]
    cache: pycolmap.DatabaseCache
    snapshots: Path
    smallest: int
    seed: int
    rig: RigKind = "none"
    focal_held: bool = False


@dataclass
class _Tried:
    """First pairs so far: how many did not meet the conditions, and gave nothing to grow from."""

    passed_over: int = 0
    refused: int = 0


def grow(growth: Growth, registered: Callable[[int], None]) -> Grown | None:
    """The component that the best first pair begins, or the one that was begun and not ended.

    Pairs that meet the conditions of the thesis are tried first, in their order; then those that
    the engine chooses; then those of a camera that moved ahead. None where no pair begins one.
    registered: is told how many photos it has, after each.
    """
    begun = read_snapshot(growth.snapshots)
    if begun is not None and not _is_ahead(begun):
        trial = _Trial(growth, registered, RELAXED[0])
        if (grown := trial.run(begun)) is not None:
            return grown
    tried = _Tried()
    weighed = list(weighed_pairs(growth.database, growth.image_ids, growth.seed))
    for pair in _meeting_conditions(weighed, tried):
        start = Start(pair, "conditions", tried.passed_over, tried.refused)
        # The engine takes single points by the same angle: half of the median keeps most of them.
        bounds = (FEWEST, LEAST_ANGLE_DEG / 2)
        trial = _Trial(growth, registered, bounds, partial(_told, start), pair)
        if (grown := trial.run()) is not None:
            return grown
        tried.refused += 1
        if tried.refused == MOST_TRIED:
            break
    grown = _grown_from_engines_choice(growth, registered, tried)
    return grown if grown is not None else _grown_ahead(growth, registered, weighed, tried)


def _placed(grown: Grown) -> int:
    return int(grown.model.num_reg_images())


def _is_ahead(begun: Grown) -> bool:
    """Whether it is one of several trials, of which the best is taken: they are made again."""
    return begun.start is not None and begun.start.chosen_by == "ahead"


def _told(start: Start, pair: tuple[int, int]) -> Start:
    """What is known of the pair already."""
    return start


def _meeting_conditions(weighed: Sequence[WeighedPair], tried: _Tried) -> Iterator[WeighedPair]:
    for pair in weighed:
        if pair.fault is None:
            yield pair
        else:
            tried.passed_over += 1


def _grown_from_engines_choice(
    growth: Growth, registered: Callable[[int], None], tried: _Tried
) -> Grown | None:
    """From a pair that the engine chooses, with ever less asked of it."""

    def start_of(pair: tuple[int, int]) -> Start:
        weighed = weighed_pair(growth.database, pair, growth.seed)
        return Start(weighed, "engine", tried.passed_over, tried.refused)

    for bounds in RELAXED:
        trial = _Trial(growth, registered, bounds, start_of)
        for _ in range(trial.pipeline.options.init_num_trials):
            if (grown := trial.run()) is not None:
                return grown
            if trial.is_exhausted:
                break
    return None


def _grown_ahead(
    growth: Growth,
    registered: Callable[[int], None],
    weighed: Sequence[WeighedPair],
    tried: _Tried,
) -> Grown | None:
    """From photos that a camera took as it moved ahead, those first that are furthest apart.

    The engine begins with none: where one looks the way one goes it takes a pose for uncertain.
    Small angles are what such a path has; points near its sides, over several photos, have more. A
    focal length that is not known may lead a trial astray, so the one that places most is taken.
    """
    best: Grown | None = None
    ahead = [pair for pair in weighed if pair.begins_ahead]
    ahead.sort(key=lambda one: (not one.known, one.telling < MANY, -(one.angle_deg or 0.0)))
    for pair in ahead[:MOST_AHEAD]:
        start = Start(pair, "ahead", tried.passed_over, tried.refused)
        bounds = (FEWEST, LEAST_ANGLE_AHEAD_DEG)
        trial = _Trial(growth, registered, bounds, partial(_told, start), pair, ahead=True)
        grown = trial.run()
        if grown is not None and (best is None or _placed(grown) > _placed(best)):
            best = grown
        if best is not None and _placed(best) == len(growth.image_ids):
            break
        tried.refused += 1
    return best


class _Trial:
    """The engine with what is asked of a first pair, and the model that it grows, which is kept.

    bounds: as in `RELAXED`. start_of: what is to be told of the pair that a model begins with; None
    where it is only gone on with. pair: the one to begin with; the engine chooses where it is None,
    and remembers which it has tried. ahead: whether the way may lead where the camera looks.
    """

    def __init__(
        self,
        growth: Growth,
        registered: Callable[[int], None],
        bounds: tuple[int, float],
        start_of: Callable[[tuple[int, int]], Start] | None = None,
        pair: WeighedPair | None = None,
        *,
        ahead: bool = False,
    ) -> None:
        self.growth, self.registered, self.start_of = growth, registered, start_of
        options = _options(growth)
        if pair is not None:
            options.init_image_id1, options.init_image_id2 = pair.first, pair.second
        manager = pycolmap.ReconstructionManager()
        self.pipeline = pycolmap.IncrementalPipeline(options, growth.cache, manager)
        self.asked = self.pipeline.options.get_mapper()
        self.asked.init_min_num_inliers, self.asked.init_min_tri_angle = bounds
        if ahead:
            self.asked.init_max_forward_motion = 1.0
        self.mapper = pycolmap.IncrementalMapper(growth.cache)
        self.is_exhausted = False
        self.grown = Grown(pycolmap.Reconstruction(), None)
        self.ended, self.took = time.perf_counter(), 0.0
        callbacks = pycolmap.IncrementalPipelineCallback
        self.pipeline.add_callback(callbacks.INITIAL_IMAGE_PAIR_REG_CALLBACK, self._after_pair)
        self.pipeline.add_callback(callbacks.NEXT_IMAGE_REG_CALLBACK, self._after_photo)

    def run(self, begun: Grown | None = None) -> Grown | None:
        """Grow one model, or go on with one; None where it comes to nothing."""
        self.grown = begun or Grown(pycolmap.Reconstruction(), None)
        model = self.grown.model
        status = self.pipeline.reconstruct_sub_model(self.mapper, self.asked, model)
        kept = model.num_reg_images() >= self.growth.smallest
        self.mapper.end_reconstruction(not kept)
        if status == pycolmap.IncrementalPipelineStatus.SUCCESS and kept:
            return self.grown
        self.is_exhausted = status == pycolmap.IncrementalPipelineStatus.NO_INITIAL_PAIR
        shutil.rmtree(self.growth.snapshots, ignore_errors=True)
        return None

    def _after_pair(self) -> None:
        """The engine calls it for a model that it goes on with, too."""
        if self.start_of is not None:
            first, second = self._begun_with()
            self.grown = Grown(self.grown.model, self.start_of((first, second)))
        self._after_photo()

    def _begun_with(self) -> tuple[int, int]:
        """The pair; of a rig, whose frames are placed whole, the two photos that share most."""
        first, *others = sorted(self.grown.model.reg_image_ids())
        if len(others) == 1:
            return first, others[0]
        shared: Counter[tuple[int, int]] = Counter()
        for point in self.grown.model.points3D.values():
            images = sorted({element.image_id for element in point.track.elements})
            shared.update(combinations(images, 2))
        frame_of = {image: self.grown.model.images[image].frame_id for image in (first, *others)}
        between = [pair for pair in shared if frame_of[pair[0]] != frame_of[pair[1]]]
        return max(between, key=lambda pair: (shared[pair], pair), default=(first, others[0]))

    def _after_photo(self) -> None:
        self.registered(self.grown.model.num_reg_images())
        begun = time.perf_counter()
        if self.took > SHORT_S and begun - self.ended < self.took / WRITING_SHARE:
            return
        write_snapshot(self.grown, self.growth.snapshots)
        self.ended = time.perf_counter()
        self.took = self.ended - begun


def _options(growth: Growth) -> pycolmap.IncrementalPipelineOptions:
    options = pycolmap.IncrementalPipelineOptions()
    options.random_seed = growth.seed
    options.num_threads = available_cores()
    options.min_model_size = growth.smallest
    options.extract_colors = False
    with pycolmap.Database.open(growth.database) as opened:
        cameras = opened.read_all_cameras()
    sides = [max(camera.width, camera.height) for camera in cameras]
    options.constant_cameras = {one.camera_id for one in cameras if one.model.name == KNOWN_MODEL}
    options.mapper.abs_pose_max_error = float(np.clip(PLACING * np.median(sides), *PLACING_PX))
    options.ba_refine_focal_length = not growth.focal_held
    # The engine warns of a trivial rig in each photo otherwise.
    options.ba_refine_sensor_from_rig = growth.rig == "adjusted"
    return options


def write_snapshot(grown: Grown, snapshots: Path) -> None:
    """Keep the model as it is now, and no earlier one; it appears whole."""
    snapshots.mkdir(parents=True, exist_ok=True)
    earlier = list(snapshots.iterdir())
    number = 1 + max(_numbered(snapshots), default=0)
    write_grown(grown, snapshots / f"{number}")
    for folder in earlier:
        shutil.rmtree(folder)


def read_snapshot(snapshots: Path) -> Grown | None:
    """The latest model that was kept; None where there is none."""
    found = _numbered(snapshots)
    return read_grown(found[max(found)]) if found else None


def _numbered(snapshots: Path) -> dict[int, Path]:
    """What appeared whole: other folders are what a killed run was writing."""
    if not snapshots.is_dir():
        return {}
    return {int(path.name): path for path in snapshots.iterdir() if path.name.isdigit()}
