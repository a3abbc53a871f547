"""`veduta dense`: the recipe from calibrated photos to a place."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from pydantic import JsonValue

from veduta.cameras import Camera, CameraSet, cameras_digest, in_metres, read_cameras
from veduta.dense.build.cloud import DenseCloud, fuse_cloud, within_box, without_strays
from veduta.dense.build.colouring import colour_vertices
from veduta.dense.build.composing import compose
from veduta.dense.build.standing import place_from_cameras
from veduta.dense.build.surface import RawSurface, build_surface, cut_surface, natural_voxel_m
from veduta.dense.build.texturing import textured
from veduta.dense.comparing import compare_with_model
from veduta.dense.depths import Matching, all_depth_maps
from veduta.dense.document import CityMesh, DepthMap, Elevation, Views
from veduta.dense.linked_depths import Linking, all_linked_depths
from veduta.dense.maps import Lenses, write_maps_of
from veduta.dense.options import DenseOptions
from veduta.dense.parameters import DenseParameters
from veduta.dense.read.city_model import read_city_mesh
from veduta.dense.read.neighbours import Comparison, choose_neighbours
from veduta.dense.read.pictures import (
    open_views,
    require_sizes,
    usable_cameras,
    working_scale,
)
from veduta.dense.read.sparse import SparsePoints, match_points, require_in_view
from veduta.dense.read.walls import WALLS, read_elevations
from veduta.dense.single import require_view, single_mesh
from veduta.dense.streaming import write_tiles
from veduta.dense.telling import (
    middle_depths_m,
    tell_depths,
    tell_result,
    tell_standing,
)
from veduta.dense.workspace import write_colmap
from veduta.dense.writing import write_cloud, write_depths, write_place
from veduta.place.mesh import Mesh
from veduta.run.card import Engine, choose_engine, say_engine
from veduta.run.digests import file_digest
from veduta.run.errors import NotFoundError
from veduta.run.names import real_path
from veduta.run.progress import Progress
from veduta.run.verb import VerbCall, VerbResult, run_verb
from veduta.run.work import Work
from veduta.surfaces import Simplified, simplify, vertex_normals

VERSION = "8"
SURFACE = "surface"


@dataclass(frozen=True, eq=False)
class _Given:
    """What the work starts from."""

    name: str
    cameras: CameraSet
    usable: list[Camera]
    left: list[str]
    walls: list[Elevation]
    city: CityMesh | None
    digests: JsonValue


def run_dense(
    cameras: Path,
    out: Path,
    options: DenseOptions | None = None,
    progress: Progress | None = None,
    *,
    images: Path | None = None,
    force: bool = False,
) -> VerbResult:
    """Depth maps, a cloud and a mesh of a set of cameras with photos, into OUT.

    images: the folder of the photos, where they do not lie beside the cameras.

    InputError where the cameras or the photos cannot be used together.
    """
    chosen = options or DenseOptions()
    found = in_metres(read_cameras(cameras, images), chosen.scale)
    usable, left = usable_cameras(found)
    require_view(chosen.surface, usable)
    name = real_path(cameras).name
    grown = chosen.scale.metres_per_unit or 1.0
    walls = [one.grown(grown) for one in read_elevations(cameras)] if cameras.is_dir() else []
    digests: JsonValue = [cameras_digest(found, usable)]
    if walls:
        digests = [cameras_digest(found, usable), file_digest(cameras / WALLS)]
    model = chosen.city.model
    city = None if model is None else read_city_mesh(model, found)
    given = _Given(name, found, usable, left, walls, city, digests)
    inputs: JsonValue = digests if model is None else [digests, file_digest(model)]
    call = VerbCall("dense", VERSION, given.name, chosen, inputs)
    return run_verb(
        call,
        out,
        lambda work: _make(work, given, chosen),
        progress or Progress(quiet=True),
        force=force,
    )


def _engine(options: DenseOptions) -> Engine:
    """What computes. PatchMatch on a card agrees with the processor's within a tolerance, not byte
    for byte: it is used where it is asked for.
    """
    device = options.device.device
    if options.depth.method == "patchmatch" and device == "auto":
        return Engine(device, None, "the processor: PatchMatch takes a card with --device gpu only")
    return choose_engine(device)


def _make(work: Work, given: _Given, options: DenseOptions) -> None:
    parameters = DenseParameters()
    for note in given.cameras.notes:
        work.note(note)
    views, scale = _views(work, given, options, parameters)
    comparisons, sparse = _comparisons(work, given, views, options, parameters)
    agree = min(options.depth.agree, 1 if len(comparisons) < 3 else options.depth.agree)
    inputs: JsonValue = [given.digests, scale]
    engine = _engine(options)
    if options.depth.method == "linking":
        linking = Linking(views, comparisons, sparse, inputs, agree, parameters, engine)
        readers = all_linked_depths(work, linking)
    else:
        seed = options.random.seed
        matching = Matching(views, comparisons, inputs, agree, seed, parameters, engine)
        readers = all_depth_maps(work, matching)

    def depth_map(view: int) -> DepthMap:
        return readers[view]()

    tell_depths(work, views, comparisons, depth_map)
    with work.step("depth files"):
        pictures = write_depths(work, views, comparisons, depth_map)
    cloud = _cloud(work, views, comparisons, depth_map, options, parameters)
    if options.formats.colmap:
        write_colmap(work, views, sparse, pictures, depth_map)
    lenses = Lenses(views.cameras, parameters.match.window_px)
    write_maps_of(work, cloud, given.cameras, given.walls, lenses, parameters.elevation)
    tints = None
    if given.city is not None:
        reach, rule = options.city.model_reach_m, parameters.distance
        tints = compare_with_model(work, cloud, given.cameras, given.city, reach, rule)
    mesh = None
    if not options.surface.no_mesh:
        make = _mesh if options.surface.single_view is None else single_mesh
        mesh = make(work, views, comparisons, depth_map, options, parameters)
    with work.step("place"):
        middle = middle_depths_m(comparisons, depth_map)
        place = compose(given.name, given.cameras, cloud, mesh, options.random.seed, tints)
        stand = place_from_cameras(given.cameras, cloud.points_m)
        tell_standing(work, stand)
        write_place(work, place, views, pictures, middle, stand)
    if options.surface.tiles and mesh is not None:
        write_tiles(work, next(iter(place.parts.values())))
    tell_result(work, place, cloud, mesh)
    say_engine(work, engine)


def _views(
    work: Work, given: _Given, options: DenseOptions, parameters: DenseParameters
) -> tuple[Views, float]:
    with work.step("photos") as step:
        step.rejected.extend(given.left)
        require_sizes(given.usable)
        chosen = options.views
        scale = working_scale(given.usable, chosen.max_side_px, chosen.max_memory)
        kept = parameters.memory.picture_bytes(chosen.max_memory)
        views = open_views(given.usable, scale, given.cameras.masks, kept)
        first = views.cameras[0]
        step.counts.update(photos=len(views), scale=round(scale, 4))
        work.measure("photos", len(views))
        work.measure("working_size_px", [first.width_px, first.height_px])
        if scale < 1.0:
            work.note(
                f"Depths are looked for at {scale:.2f} of the photos' size "
                f"({first.width_px} x {first.height_px}): see --max-side-px and --max-memory."
            )
        if given.left:
            work.doubt(f"{len(given.left)} cameras have no photo and are left out")
    return views, scale


def _comparisons(
    work: Work, given: _Given, views: Views, options: DenseOptions, parameters: DenseParameters
) -> tuple[list[Comparison], SparsePoints]:
    with work.step("neighbours") as step:
        sparse = _sparse(given, views, parameters)
        found, left = choose_neighbours(
            views, sparse, options.views.neighbours, parameters.neighbours
        )
        step.rejected.extend(left)
        step.counts.update(points=len(sparse.points_m), compared=len(found))
        if sparse.confirmed is not None:
            work.measure("matches_confirmed", round(sparse.confirmed, 3))
    if len(found) < 2:
        evidence = f"no two of the {len(views)} photos show the same spots"
        raise NotFoundError("depths", evidence, "Give photos that overlap by half or more.")
    if left:
        work.doubt(f"{len(left)} photos overlap with no other and have no depth map")
    if len(found) == 2:
        work.doubt("only two photos: no third one confirms a depth")
    return found, sparse


def _sparse(given: _Given, views: Views, parameters: DenseParameters) -> SparsePoints:
    cameras = given.cameras
    if cameras.points is None or cameras.visible is None or not len(cameras.points):
        return match_points(views, cameras.source, parameters.sparse)
    of_name = {one.name: index for one, index in zip(cameras.cameras, cameras.visible, strict=True)}
    visible = tuple(np.asarray(of_name[one.name], dtype=np.intp) for one in given.usable)
    own = SparsePoints(np.asarray(cameras.points, dtype=np.float64), visible)
    require_in_view(views, own, cameras.source, parameters.sparse)
    return own


def _cloud(
    work: Work,
    views: Views,
    comparisons: list[Comparison],
    depth_map: Callable[[int], DepthMap],
    options: DenseOptions,
    parameters: DenseParameters,
) -> DenseCloud:
    with work.step("cloud") as step:
        links = {one.view: one.neighbours for one in comparisons}
        least, rule = options.depth.agree + 1, parameters.cloud
        most = parameters.memory.most_points(options.views.max_memory)
        cloud, every = fuse_cloud(views, links, depth_map, least, rule, most)
        if every > 1:
            work.note(
                f"All points would take too much memory: one of {every} is left (see --max-memory)."
            )
        fused = len(cloud.points_m)
        cloud = without_strays(cloud, parameters.cloud)
        step.counts["strays"] = fused - len(cloud.points_m)
        if options.views.box is not None:
            cloud = within_box(cloud, options.views.box)
        if not len(cloud.points_m):
            raise NotFoundError(
                "points", "no depth is shown by enough photos", "Give more photos, or --agree 1."
            )
        step.counts["points"] = len(cloud.points_m)
        write_cloud(work, cloud)
    return cloud


def _mesh(
    work: Work,
    views: Views,
    comparisons: list[Comparison],
    depth_map: Callable[[int], DepthMap],
    options: DenseOptions,
    parameters: DenseParameters,
) -> tuple[Mesh, NDArray[np.float64]]:
    order = [one.view for one in comparisons]
    wanted = options.surface
    most = parameters.memory.most_blocks(options.views.max_memory)
    with work.step("surface") as step:
        natural = natural_voxel_m(views, depth_map, order, parameters.surface.voxel_px)
        voxel = wanted.voxel_m or natural
        raw = build_surface(views, depth_map, order, voxel, most, parameters.surface)
        if options.views.box is not None:
            raw = cut_surface(raw, options.views.box)
        step.counts.update(triangles=len(raw.triangles), dropped=raw.dropped)
        work.measure("voxel_m", round(raw.voxel_m, 6))
        if raw.voxel_m > voxel:
            work.note(f"Voxels of {voxel:.4g} m would take too much memory: {raw.voxel_m:.4g} m.")
    with work.step("simplification") as step:
        simple = simplify(raw.points_m, raw.triangles, most=wanted.max_triangles)
        step.counts["triangles"] = len(simple.triangles)
        work.measure("simplified_within_m", round(simple.error_m, 6))
    with work.step("colours"):
        mesh, middle = _coloured(views, depth_map, order, raw, simple)
    if wanted.no_texture:
        return mesh, middle
    with work.step("texture") as step:
        found = textured(mesh, middle, views, order, wanted.max_atlas_px, work.progress)
        step.counts.update(charts=found.charts)
        work.measure("seen_share", round(found.seen_share, 4))
        work.measure("texel_m", round(found.texel_m, 6))
        work.measure("seam_before_after", [round(found.seam_before, 2), round(found.seam_after, 2)])
        return found.mesh, middle


def _coloured(
    views: Views,
    depth_map: Callable[[int], DepthMap],
    order: list[int],
    raw: RawSurface,
    simple: Simplified,
) -> tuple[Mesh, NDArray[np.float64]]:
    points, faces = simple.positions, simple.triangles
    middle = np.round(points.mean(axis=0), 3)
    normals = vertex_normals(points - middle, faces).astype(np.float32)
    found = colour_vertices(points, normals, views, depth_map, order, 3.0 * raw.voxel_m)
    mesh = Mesh.simple(SURFACE, points - middle, faces, colours=found.colours, normals=normals)
    return mesh, middle
