"""The mesh of one photo in place of that of all: the option, its step, what the report says."""

from __future__ import annotations

from collections.abc import Callable
from difflib import get_close_matches
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.cameras import Camera
from veduta.dense.build.single_view import SingleView, single_view
from veduta.dense.document import DepthMap, Views
from veduta.dense.options import DenseOptions, SurfaceOptions
from veduta.dense.parameters import DenseParameters
from veduta.dense.read.neighbours import Comparison
from veduta.place.material import Material, Texture
from veduta.place.mesh import Mesh
from veduta.run.errors import InputError, NotFoundError
from veduta.run.work import Work
from veduta.surfaces import vertex_normals

SURFACE = "surface"


def require_view(options: SurfaceOptions, cameras: list[Camera]) -> None:
    """InputError where no camera has the wanted name, or an option has no effect beside it."""
    wanted = options.single_view
    if wanted is None:
        return
    for name, given in (("--no-mesh", options.no_mesh), ("--voxel-m", options.voxel_m)):
        if given:
            raise InputError(name, "has no effect beside --single-view", "Leave one of them out.")
    if not any(_is_named(one, wanted) for one in cameras):
        known = [one.name for one in cameras]
        near = get_close_matches(wanted, known, n=1, cutoff=0.0)
        fault = f"is none of the {len(known)} photos that have a camera"
        raise InputError(f"--single-view {wanted}", fault, f"Give one of them, such as {near[0]}.")


def _is_named(camera: Camera, wanted: str) -> bool:
    return wanted in (camera.name, Path(camera.name).name, Path(camera.name).stem)


def single_mesh(
    work: Work,
    views: Views,
    comparisons: list[Comparison],
    depth_map: Callable[[int], DepthMap],
    options: DenseOptions,
    parameters: DenseParameters,
) -> tuple[Mesh, NDArray[np.float64]]:
    """The mesh of the wanted photo about its middle, and that middle.

    NotFoundError where the photo has no depth map, or no surface.
    """
    chosen = options.surface
    wanted = str(chosen.single_view)
    view = next((o.view for o in comparisons if _is_named(views.cameras[o.view], wanted)), None)
    if view is None:
        reason = f"{wanted} overlaps with no other photo and has no depth map"
        raise NotFoundError("a surface", reason, "Choose another --single-view.")
    with work.step("single view") as step:
        camera, rule = views.cameras[view], parameters.single
        found = single_view(depth_map(view).depths_m, camera, chosen.max_triangles, rule)
        if options.views.box is not None:
            found = found.within_box(options.views.box)
        step.counts.update(triangles=len(found.triangles), cut=found.cut, dropped=found.dropped)
        work.measure("single_view", camera.name)
        work.measure("single_view_covered_share", round(found.covered, 4))
        work.measure("single_view_within_share", round(found.within, 5))
        work.measure("single_view_filled_share", round(found.filled, 4))
        work.note(
            f"The mesh is that of {camera.name} alone. It shows {100 * found.covered:.1f} % of its "
            f"depths, 95 of 100 of them to {100 * found.within:.2g} %; {found.cut} triangles that "
            f"bridged a step or a hole are left out, and {found.dropped} of loose parts. Gaps of a "
            f"few pixels, {100 * found.filled:.1f} % of the photo, are closed from around them."
        )
        return _dressed(found, views.pixels(view), textured=not chosen.no_texture)


def _dressed(
    found: SingleView, pixels: NDArray[np.uint8], *, textured: bool
) -> tuple[Mesh, NDArray[np.float64]]:
    """With the photo as its texture, or with its colours."""
    middle = np.round(found.points_m.mean(axis=0), 3)
    points = found.points_m - middle
    normals = vertex_normals(points, found.triangles)
    size = np.array([pixels.shape[1], pixels.shape[0]])
    if textured:
        photo = Texture(pixels, np.zeros(pixels.shape[:2], dtype=bool))
        uv, material = found.pixels / size, Material(SURFACE, texture=photo)
        return Mesh.simple(
            SURFACE, points, found.triangles, normals=normals, uv=uv, material=material
        ), middle
    column, row = np.minimum(found.pixels.astype(np.intp), size - 1).T
    colours = pixels[row, column]
    return Mesh.simple(SURFACE, points, found.triangles, normals=normals, colours=colours), middle
