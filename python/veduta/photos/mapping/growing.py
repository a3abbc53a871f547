"""Growing one component photo by photo, with what is grown so far kept on the disk.

The engine registers the photos (incremental structure from motion, Schoenberger and Frahm, CVPR
2016); this file has its snapshots. After each photo the model is written whole beside the earlier
one, which then goes: a run that is killed begins again from the last photo but one.
"""

from __future__ import annotations

import shutil
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pycolmap

from veduta.run.atomic import atomic_folder
from veduta.run.pool import available_cores

RELAXED = ((100, 16.0), (50, 16.0), (50, 8.0), (25, 8.0), (25, 4.0))
"""What is asked of a first pair in turn: agreeing features, and degrees between its rays."""
WRITING_SHARE = 0.2
"""Share of the time that snapshots may take: where a large model takes long to write, they are
rarer than one a photo."""
SHORT_S = 0.25
"""Writing that takes no longer is done after each photo."""


@dataclass(frozen=True)
class Growth:
    """What `grow` needs. smallest: photos that a component must have.

    snapshots: a folder of its own, which may hold what an earlier run left.
    """

    cache: pycolmap.DatabaseCache
    snapshots: Path
    smallest: int
    seed: int


def grow(growth: Growth, registered: Callable[[int], None]) -> pycolmap.Reconstruction | None:
    """The component that the best first pair begins, or the one that was begun and not ended.

    None where no pair begins one. registered: is told how many photos it has, after each.
    """
    manager = pycolmap.ReconstructionManager()
    for inliers, degrees in RELAXED:
        pipeline = pycolmap.IncrementalPipeline(_options(growth), growth.cache, manager)
        asked = pipeline.options.get_mapper()
        asked.init_min_num_inliers, asked.init_min_tri_angle = inliers, degrees
        mapper = pycolmap.IncrementalMapper(growth.cache)
        for _ in range(pipeline.options.init_num_trials):
            model = read_snapshot(growth.snapshots) or pycolmap.Reconstruction()
            _watch(pipeline, model, growth.snapshots, registered)
            status = pipeline.reconstruct_sub_model(mapper, asked, model)
            kept = model.num_reg_images() >= growth.smallest
            mapper.end_reconstruction(not kept)
            if status == pycolmap.IncrementalPipelineStatus.SUCCESS and kept:
                return model
            shutil.rmtree(growth.snapshots, ignore_errors=True)
            if status == pycolmap.IncrementalPipelineStatus.NO_INITIAL_PAIR:
                break
    return None


def _options(growth: Growth) -> pycolmap.IncrementalPipelineOptions:
    options = pycolmap.IncrementalPipelineOptions()
    options.random_seed = growth.seed
    options.num_threads = available_cores()
    options.min_model_size = growth.smallest
    options.extract_colors = False
    # The engine warns of a trivial rig in each photo otherwise.
    options.ba_refine_sensor_from_rig = False
    return options


def _watch(
    pipeline: pycolmap.IncrementalPipeline,
    model: pycolmap.Reconstruction,
    snapshots: Path,
    registered: Callable[[int], None],
) -> None:
    """Have the model written as it grows."""
    ended, took = [time.perf_counter()], [0.0]

    def after_photo() -> None:
        count = model.num_reg_images()
        registered(count)
        begun = time.perf_counter()
        if took[0] > SHORT_S and begun - ended[0] < took[0] / WRITING_SHARE:
            return
        write_snapshot(model, snapshots)
        ended[0] = time.perf_counter()
        took[0] = ended[0] - begun

    callbacks = pycolmap.IncrementalPipelineCallback
    for moment in (callbacks.INITIAL_IMAGE_PAIR_REG_CALLBACK, callbacks.NEXT_IMAGE_REG_CALLBACK):
        pipeline.add_callback(moment, after_photo)


def write_snapshot(model: pycolmap.Reconstruction, snapshots: Path) -> None:
    """Keep the model as it is now, and no earlier one; it appears whole."""
    snapshots.mkdir(parents=True, exist_ok=True)
    earlier = list(snapshots.iterdir())
    number = 1 + max(_numbered(snapshots), default=0)
    with atomic_folder(snapshots / f"{number}") as temporary:
        model.write_binary(temporary)
    for folder in earlier:
        shutil.rmtree(folder)


def read_snapshot(snapshots: Path) -> pycolmap.Reconstruction | None:
    """The latest model that was kept; None where there is none."""
    found = _numbered(snapshots)
    return pycolmap.Reconstruction(found[max(found)]) if found else None


def _numbered(snapshots: Path) -> dict[int, Path]:
    """What appeared whole: other folders are what a killed run was writing."""
    if not snapshots.is_dir():
        return {}
    return {int(path.name): path for path in snapshots.iterdir() if path.name.isdigit()}
