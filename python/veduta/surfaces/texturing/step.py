"""The step: a mesh and photos in, the mesh with a texture out."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.place.material import Material, Texture
from veduta.place.mesh import Mesh
from veduta.run.progress import StepProgress, no_progress
from veduta.surfaces.adjacency import neighbours
from veduta.surfaces.texturing.atlas import compose, lay_swatches, level
from veduta.surfaces.texturing.charts import Charts, chart
from veduta.surfaces.texturing.choice import choose
from veduta.surfaces.texturing.levels import Nodes, corrections, nodes_of
from veduta.surfaces.texturing.options import SurfaceView, TextureOptions
from veduta.surfaces.texturing.sight import NO_VIEW, colours_at, see
from veduta.surfaces.texturing.unseen import spread_colours, swatch_places, swatches

Floats = NDArray[np.float64]
STEP = "texture"
_SOFT_PX = 1.5


@dataclass(frozen=True, eq=False)
class TexturedMesh:
    """mesh: with one material, whose texture marks what no photo shows.

    view_of: (m,) the view of each triangle, -1 for none. seen_share: of the surface's area.
    texel_m: the mean side of a texel on what is seen. charts: their number. seam_before,
    seam_after: median difference of colour across seams (of 255), unlevelled and levelled.
    """

    mesh: Mesh
    view_of: NDArray[np.int32]
    seen_share: float
    texel_m: float
    charts: int
    seam_before: float
    seam_after: float


@dataclass(frozen=True, eq=False)
class _Work:
    """What the parts of the step share. places: (m, 3, 2) px of corners in the atlas."""

    triangles: NDArray[np.int64]
    labels: NDArray[np.int32]
    charts: Charts
    nodes: Nodes
    places: Floats


def texture_mesh(
    mesh: Mesh,
    views: Sequence[SurfaceView],
    options: TextureOptions | None = None,
    progress: StepProgress = no_progress,
) -> TexturedMesh:
    """The mesh with a texture from photos; its vertices are doubled where charts meet.

    Colours of vertices and materials go; features stay. What no photo shows has the colours of what
    lies around it, and is marked in `Texture.invented`. ValueError where the mesh has no triangle.
    """
    chosen = options or TextureOptions()
    if not len(mesh.triangles):
        raise ValueError(f"mesh {mesh.id!r} has no triangle")
    positions = mesh.positions_m.astype(np.float64)
    triangles = mesh.triangles.astype(np.int64)
    beside = neighbours(triangles)
    parameters = chosen.parameters
    sights = see(positions, triangles, views, parameters, _part(progress, 0.0, 0.5))
    labels = choose(sights, beside, parameters)
    photo_places = _photo_places(positions, triangles, labels, views)
    charts = chart(
        labels,
        beside,
        photo_places,
        detail=chosen.detail,
        largest_px=chosen.largest_px,
        padding_px=parameters.padding_px,
    )
    nodes = nodes_of(triangles, charts.chart_of)
    work = _Work(triangles, labels, charts, nodes, _atlas_places(photo_places, charts))
    pixels, seen = compose(charts, views, _part(progress, 0.5, 0.8))
    before = _node_colours(pixels, work)
    added = corrections(nodes, before, parameters)
    shown = charts.chart_of >= 0
    if len(nodes.vertex):
        level(pixels, work.places[shown], added[nodes.triangles])
    _fill_unseen(pixels, work, before + added, len(positions))
    progress(STEP, 1.0)
    texture = Texture(pixels, ~seen)
    textured = _mesh(mesh, work, texture, chosen.name)
    area = textured.triangle_area_m2
    texels = _areas_px(work.places[shown]).sum()
    return TexturedMesh(
        mesh=textured,
        view_of=labels,
        seen_share=float(area[shown].sum() / max(area.sum(), 1e-300)),
        texel_m=float(np.sqrt(area[shown].sum() / texels)) if texels > 0.0 else float("nan"),
        charts=len(charts.views),
        seam_before=_seam(nodes, before),
        seam_after=_seam(nodes, before + added),
    )


def _part(progress: StepProgress, start: float, end: float) -> Callable[[float], None]:
    return lambda fraction: progress(STEP, start + (end - start) * fraction)


def _photo_places(
    positions: Floats,
    triangles: NDArray[np.int64],
    labels: NDArray[np.int32],
    views: Sequence[SurfaceView],
) -> Floats:
    """(m, 3, 2) px of the corners in each triangle's own photo; 0 without one."""
    places = np.zeros((len(triangles), 3, 2))
    for number in np.unique(labels[labels != NO_VIEW]):
        rows = np.flatnonzero(labels == number)
        px, _ = views[number].camera.project(positions[triangles[rows]].reshape(-1, 3))
        places[rows] = px.reshape(-1, 3, 2)
    return places


def _atlas_places(photo_places: Floats, charts: Charts) -> Floats:
    """(m, 3, 2) px of the corners in the atlas."""
    places = np.zeros_like(photo_places)
    shown = charts.chart_of >= 0
    own = charts.chart_of[shown]
    moved = (charts.corners - charts.lows)[own]
    places[shown] = photo_places[shown] * charts.scale + moved[:, None]
    places[~shown] = swatch_places(charts.swatches)
    return places


def _node_colours(pixels: NDArray[np.uint8], work: _Work) -> Floats:
    """(n, 3) the colour of each node in its own chart."""
    places = np.zeros((len(work.nodes.vertex), 2))
    places[work.nodes.triangles.ravel()] = work.places[work.charts.chart_of >= 0].reshape(-1, 2)
    soft = np.asarray(cv2.GaussianBlur(pixels, (0, 0), _SOFT_PX), dtype=np.uint8)
    return colours_at(soft, places).astype(np.float64)


def _fill_unseen(pixels: NDArray[np.uint8], work: _Work, colours: Floats, count: int) -> None:
    """Lay squares of colour for the triangles that no photo shows."""
    hidden = work.charts.chart_of < 0
    if not hidden.any():
        return
    vertex = work.nodes.vertex
    counts = np.bincount(vertex, minlength=count)
    sums = [np.bincount(vertex, colours[:, axis], minlength=count) for axis in range(3)]
    mean = np.stack(sums, axis=1) / np.maximum(counts, 1)[:, None]
    spread = spread_colours(work.triangles, counts > 0, mean, count)
    lay_swatches(pixels, work.charts.swatches, swatches(spread[work.triangles[hidden]]))


def _mesh(mesh: Mesh, work: _Work, texture: Texture, name: str) -> Mesh:
    """The mesh with a vertex for each node, and three for each triangle that no photo shows."""
    shown = work.charts.chart_of >= 0
    hidden = np.flatnonzero(~shown)
    vertex = np.concatenate([work.nodes.vertex, work.triangles[hidden].ravel()])
    triangles = np.empty((len(work.triangles), 3), dtype=np.uint32)
    triangles[shown] = work.nodes.triangles
    own = len(work.nodes.vertex) + np.arange(3 * len(hidden))
    triangles[hidden] = own.reshape(-1, 3)
    size = np.array([work.charts.width_px, work.charts.height_px])
    uv = np.zeros((len(vertex), 2), dtype=np.float32)
    uv[triangles.ravel()] = (work.places / size).reshape(-1, 2)
    skin = mesh.skin
    if skin is not None:
        skin = replace(skin, joints=skin.joints[vertex], weights=skin.weights[vertex])
    roughness = mesh.materials[0].roughness if mesh.materials else 0.9
    return replace(
        mesh,
        positions_m=mesh.positions_m[vertex],
        triangles=triangles,
        materials=(Material(name, roughness=roughness, texture=texture),),
        triangle_material=np.zeros(len(triangles), dtype=np.int32),
        normals=mesh.vertex_normals[vertex],
        uv=uv,
        uv_second=None,
        colours=None,
        morphs=tuple(replace(one, positions_m=one.positions_m[vertex]) for one in mesh.morphs),
        skin=skin,
    )


def _areas_px(places: Floats) -> Floats:
    first, second = places[:, 1] - places[:, 0], places[:, 2] - places[:, 0]
    return np.asarray(0.5 * np.abs(first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]))


def _seam(nodes: Nodes, colours: Floats) -> float:
    """Median difference of colour between nodes of one vertex."""
    order = np.argsort(nodes.vertex, kind="stable")
    met = nodes.vertex[order][1:] == nodes.vertex[order][:-1]
    if not met.any():
        return 0.0
    apart = np.abs(colours[order[1:][met]] - colours[order[:-1][met]]).max(axis=1)
    return float(np.median(apart))


__all__ = ["TexturedMesh", "texture_mesh"]
