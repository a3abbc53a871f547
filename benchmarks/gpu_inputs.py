"""What `gpu.py` takes to the machine with the card: arrays alone."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray
from searched_photo import SEED, coarse_planes, middle_photo

from veduta import _core
from veduta.cameras import read_cameras
from veduta.carve.build.bounds import find_bounds
from veduta.carve.build.consistency import sweep_inputs
from veduta.carve.build.hull import carve_hull, outline_distances, root_of
from veduta.carve.options import SilhouetteOptions
from veduta.carve.read.views import read_views
from veduta.carve.views import camera_rows
from veduta.dense.document import camera_row
from veduta.dense.read.linking import (
    LinkParameters,
    MatchedPair,
    chain_steps,
    chains_of,
    match_views,
    pair_range,
)
from veduta.dense.read.matching import MatchParameters, match_fine
from veduta.dense.read.neighbours import NeighbourParameters, choose_neighbours
from veduta.dense.read.pictures import open_views, usable_cameras
from veduta.dense.read.rectifying import rectified_side, rectify_pair
from veduta.dense.read.sparse import SparsePoints
from veduta.photos.options import PhotosOptions
from veduta.photos.pipeline import run_photos
from veduta.run.card import Engine, choose_engine
from veduta.run.progress import Progress

Arrays = dict[str, NDArray[Any]]

SEARCHED_PX = 1155  # a megapixel, where photos are 3:2


def carve_inputs(data: Path) -> Arrays:
    """The Oxford dinosaur: cameras, and distances to the outlines."""
    folder = data / "silhouettes" / "vgg-dino"
    views = read_views(folder, read_cameras(folder), SilhouetteOptions()).views
    root = root_of(find_bounds(views), 8)
    fields = [outline_distances(view.mask) for view in views]
    found: Arrays = {f"d{number}": field for number, (field, _) in enumerate(fields)}
    return found | {
        "cams": camera_rows([view.camera for view in views]),
        "corners": np.array([corner for _, corner in fields], dtype=np.float64),
        "low": root.low_m,
        "side": np.array(root.side_m),
    }


def sweep_arrays(data: Path) -> Arrays:
    """Middlebury's dino, on which the colours carve: 16 photos, the hull at 128 voxels a side."""
    folder = data / "silhouettes" / "dinoSparseRing"
    views = read_views(folder, read_cameras(folder), SilhouetteOptions()).views
    hull = carve_hull(views, root_of(find_bounds(views), 7))
    cameras, photos, distances, corners, solid, low, side = sweep_inputs(views, hull)
    found: Arrays = {f"sp{number}": photo for number, photo in enumerate(photos)}
    found |= {f"sd{number}": field for number, field in enumerate(distances)}
    return found | {
        "scams": cameras,
        "scorners": corners,
        "ssolid": solid,
        "slow": np.array(low),
        "sside": np.array(side),
    }


class Kept:
    """Takes the place of the engine: computes on the processor, and keeps what it was given."""

    def __init__(self) -> None:
        self.calls: list[tuple[Any, ...]] = []

    def match_planes(self, *given: Any) -> Any:
        """As the card's."""
        self.calls.append(given)
        return _core.match_planes(*given)

    def run(self, on_card: Callable[[Any], Any], on_cores: Callable[[], Any]) -> Any:
        """As the engine's."""
        return on_card(self)


def search_inputs(photos_out: Path) -> Arrays:
    """The depth search of one photo with four neighbours: the three levels of its own.

    photos_out: a result of `veduta photos`.
    """
    views, middle, by_view = middle_photo(photos_out, SEARCHED_PX)
    kept, rule = Kept(), MatchParameters()
    engine = cast(Engine, kept)
    planes = coarse_planes(views, middle, by_view, engine, rule)
    match_fine(views, middle, planes, SEED, rule, engine)
    found: Arrays = {}
    levels = (*rule.coarse, rule.fine)
    for number, (level, call) in enumerate(zip(levels, kept.calls[-len(levels) :], strict=True)):
        _, sweeps, vary_depth, vary_normal = level
        found |= _level(f"f{number}", call)
        found[f"f{number}rule"] = np.array(
            [middle.near_m, middle.far_m, sweeps, max(1, (len(middle.neighbours) + 1) // 2),
             rule.step_px, rule.gamma_grey, rule.gamma_px, rule.noise_grey, rule.consistency,
             rule.most_px, vary_depth, vary_normal, SEED]
        )  # fmt: skip
    return found


def _level(name: str, call: tuple[Any, ...]) -> Arrays:
    image, camera, near, cameras, depths, start, shape, _ = call
    found: Arrays = {f"{name}image": image, f"{name}camera": camera, f"{name}cameras": cameras}
    found |= {f"{name}n{number}": grey for number, grey in enumerate(near)}
    found |= {f"{name}d{number}": one for number, one in enumerate(depths) if one is not None}
    if start is not None:
        found[f"{name}start"] = start
    return found | {f"{name}shape": np.array(shape)}


def link_inputs(data: Path) -> Arrays:
    """Merton College I at 640 x 480: rectified pairs, and the chains of its views."""
    with tempfile.TemporaryDirectory() as scratch:
        out = Path(scratch) / "cameras"
        run_photos(data / "photos" / "merton" / "I", out, PhotosOptions(), Progress(quiet=True))
        given = read_cameras(out)
        usable, _ = usable_cameras(given)
        views = open_views(usable, 640 / max(one.width_px for one in usable), {})
        if given.points is None or given.visible is None:
            raise SystemExit("`veduta photos` found no points")
        sparse = SparsePoints(given.points, given.visible)
        comparisons, _ = choose_neighbours(views, sparse, 4, NeighbourParameters())
        rule, engine = LinkParameters(), choose_engine("cpu")
        order = [one.view for one in comparisons]
        found: Arrays = {}
        pairs = {}
        for number, two in enumerate(zip(order[:-1], order[1:], strict=True)):
            pair = rectify_pair(views.cameras[two[0]], views.cameras[two[1]], rule.rectify)
            if isinstance(pair, str):
                raise SystemExit(pair)
            tried = pair_range(sparse, views, two, pair, rule)
            if isinstance(tried, str):
                raise SystemExit(tried)
            pairs[two] = MatchedPair(two, pair, *match_views(views, two, pair, tried, rule, engine))
            found[f"p{number}t"] = np.array(tried)
            for place, name in enumerate("ab"):
                side = rectified_side(
                    views, two[place], pair.rectified[place], pair.widths[place], pair.height
                )
                found[f"p{number}{name}"], found[f"p{number}{name}s"] = side
        for one in comparisons:
            camera, name = views.cameras[one.view], f"v{one.view}"
            found[name] = camera_row(camera)
            size = [one.near_m, one.far_m, camera.width_px, camera.height_px]
            found[f"{name}r"] = np.array(size)
            for way, chain in enumerate(chains_of(one.view, pairs, order, rule.most_links)):
                found[f"{name}c{way}"] = np.array(len(chain))
                for step, parts in enumerate(chain_steps(views, chain)):
                    for number, part in enumerate(parts):
                        found[f"{name}c{way}s{step}q{number}"] = np.asarray(part)
    return found
