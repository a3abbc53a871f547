"""One segment from its scan points to a textured mesh: the recipe, step after step."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from veduta.drive.build.atlas import Atlas, build_atlas
from veduta.drive.build.consistency import Consistency, check_filled
from veduta.drive.build.fill import Background, fill_background, raise_walls
from veduta.drive.build.frame import ColumnFrame, column_frame, sort_into_columns
from veduta.drive.build.layers import Layers, PointClass, split_layers
from veduta.drive.build.lighter import lighten
from veduta.drive.build.objects import find_objects
from veduta.drive.build.other_points import NONE, Others, compared, sort_in
from veduta.drive.build.pictures_of import Seen
from veduta.drive.build.roof_line import find_roof_line
from veduta.drive.build.surface import Surface, build_surface
from veduta.drive.build.texture_fill import fill_texture
from veduta.drive.build.trees import TreeParameters, as_scanned, direction_changes
from veduta.drive.document.model import DriveSegment
from veduta.drive.options import DriveOptions

_BEFORE_ATLAS, _BEFORE_FILL = 0.1, 0.4
"""How much of the time of texturing has gone by then."""


@dataclass(frozen=True)
class PlanesParameters:
    """nearest_m: nearer to the path is the road under the vehicle. lowest_deg, highest_deg: beams
    of the virtual scanner, over level: almost below it, where the grounds of both sides meet.
    """

    nearest_m: float = 1.0
    lowest_deg: float = -89.8
    highest_deg: float = 72.0


@dataclass(frozen=True)
class CrownParameters:
    """tall_m: cars and hedges are lower; trunks and poles are not. wide_m, high_m: a crown is so
    much wider than its trunk, and goes on so much above it. points: that stand for crowns.
    """

    tall_m: float = 1.9
    wide_m: float = 0.6
    high_m: float = 3.0
    points: int = 40_000


@dataclass(frozen=True, eq=False)
class Geometry:
    """A segment without its foreground. objects: (r, c) number of the object before each beam.

    others: what points of other sensors filled. seconds: what it took.
    """

    segment: DriveSegment
    frame: ColumnFrame
    layers: Layers
    objects: NDArray[np.int32]
    object_count: int
    background: Background
    others: Others = NONE
    seconds: float = 0.0

    def foreground(self) -> NDArray[np.float64]:
        """(n, 3) the points that were taken out (m)."""
        taken = self.layers.kind == PointClass.FOREGROUND
        return np.asarray(self.layers.points.points[taken], dtype=np.float64)

    def crowns(
        self, seed: int, parameters: CrownParameters | None = None
    ) -> NDArray[np.float64]:
        """(n, 3) where crowns of trees may be, above what the scanner saw (m).

        What is higher than cars goes on upwards, wider than below: more is hidden rather than less
        (section 7.1).
        """
        chosen = parameters or CrownParameters()
        high = self.layers.above > chosen.tall_m
        trunk = self.layers.points.points[(self.layers.kind == PointClass.FOREGROUND) & high]
        if not len(trunk):
            return np.zeros((0, 3))
        random = np.random.default_rng(seed)
        stem = trunk[random.integers(0, len(trunk), chosen.points)]
        angle, radius = random.uniform(0, 2 * np.pi, len(stem)), random.uniform(0, 1, len(stem))
        reach = chosen.wide_m * np.sqrt(radius)
        lift = random.uniform(0.0, chosen.high_m, len(stem))
        reach *= np.minimum(lift, 1.0)
        spread = np.stack([reach * np.cos(angle), reach * np.sin(angle), lift], axis=1)
        return np.asarray(stem + spread, dtype=np.float64)

    def measured_walls(self) -> int:
        """How many columns have a facade."""
        return int(np.isfinite(self.layers.depths.main).sum())


@dataclass(frozen=True, eq=False)
class Textured:
    """A segment's mesh with its texture. invented, plain: (h, w) bool texels (see `fill_texture`).

    unseen_share: of the triangles that no image shows, before any were joined: fine_triangles.
    error_m: by which joining them moved the surface. consistency: whether images agree where walls
    were filled. atlas_s, fill_s, join_s: what the atlas, its holes and joining triangles took.
    """

    geometry: Geometry
    background: Background
    surface: Surface
    atlas: Atlas
    pixels: NDArray[np.uint8]
    invented: NDArray[np.bool_]
    plain: NDArray[np.bool_]
    roof_seen: NDArray[np.bool_]
    unseen_share: float
    fine_triangles: int
    error_m: float
    consistency: Consistency
    atlas_s: float
    fill_s: float
    join_s: float


def frame_of(
    segment: DriveSegment,
    options: DriveOptions,
    road_m: float,
    parameters: PlanesParameters | None = None,
) -> ColumnFrame:
    """The scanning planes of a segment. road_m: height of the scanner over the road."""
    chosen = parameters or PlanesParameters()
    line = np.array(segment.line)
    step = options.columns.row_step_deg
    angles = np.deg2rad(np.arange(chosen.lowest_deg, chosen.highest_deg, step))
    return column_frame(line, segment.side, angles, line[:, 2] - road_m)


def reconstruct(
    segment: DriveSegment,
    frame: ColumnFrame,
    points: NDArray[np.float64],
    options: DriveOptions,
    others: NDArray[np.float64] | None = None,
    parameters: PlanesParameters | None = None,
) -> Geometry:
    """Sections 5 and 6. points: (n, 3) of all sweeps that saw the segment (m, world).

    others: (k, 3) of other sensors; they fill holes of walls before these are interpolated.
    """
    begin = time.perf_counter()
    farthest = options.columns.farthest_m
    nearest = (parameters or PlanesParameters()).nearest_m
    sorted_points = sort_into_columns(points, frame, nearest, farthest)
    layers = split_layers(sorted_points, frame, farthest)
    if segment.fate == "as-is":
        return _left_alone(segment, frame, layers)
    share = direction_changes(layers.first, frame)
    if share > TreeParameters().most:
        why = f"{segment.reason}; mostly trees ({100 * share:.0f} % direction changes): left as is"
        left = segment.model_copy(update={"fate": "as-is", "reason": why})
        return _left_alone(left, frame, layers)
    objects, count = find_objects(layers.foreground)
    background, told = _filled(layers, objects, frame, farthest, others)
    seconds = time.perf_counter() - begin
    return Geometry(segment, frame, layers, objects, count, background, told, seconds)


def _filled(
    layers: Layers,
    objects: NDArray[np.int32],
    frame: ColumnFrame,
    farthest_m: float,
    others: NDArray[np.float64] | None,
) -> tuple[Background, Others]:
    """With the points of other sensors, and what difference they make."""
    alone = fill_background(layers, objects, frame)
    if others is None or not len(others):
        return alone, NONE
    more, hole = sort_in(layers, others, frame, farthest_m)
    own = fill_background(more, objects, frame)
    return own, compared(hole, own, alone)


def _left_alone(segment: DriveSegment, frame: ColumnFrame, layers: Layers) -> Geometry:
    """Meshed as scanned: nothing of it is foreground."""
    kind = layers.kind.copy()
    kind[kind == PointClass.FOREGROUND] = PointClass.UNCLASSIFIED
    background = as_scanned(layers, layers.depths.main)
    none = np.zeros(frame.shape, dtype=np.int32)
    return Geometry(segment, frame, replace(layers, kind=kind), none, 0, background)


def texture(
    geometry: Geometry,
    seen: Sequence[Seen],
    options: DriveOptions,
    told: Callable[[float], None] = lambda share: None,
) -> Textured:
    """Section 7, and the walls up to the roof line. told: hears how far it is, 0 to 1."""
    begin = time.perf_counter()
    frame, background = geometry.frame, geometry.background
    tops, known = find_roof_line(background, frame, seen, options.texture.wall_top_m)
    raised = raise_walls(background, frame, tops)
    fine = build_surface(raised.depth, raised.source, raised.wall, frame)
    told(_BEFORE_ATLAS)
    atlas = build_atlas(raised.depth, frame, seen, options.texture.texel_m)
    told(_BEFORE_FILL)
    made = time.perf_counter()
    if options.texture.fill:
        pixels, invented, plain = fill_texture(
            atlas, options.texture.texel_m,
            lambda share: told(_BEFORE_FILL + (1.0 - _BEFORE_FILL) * share),
            ground=atlas.spread(~raised.wall),
        )  # fmt: skip
    else:
        pixels, plain = atlas.pixels, atlas.surface & ~atlas.seen
        invented = np.zeros_like(plain)
    filled = time.perf_counter()
    unseen = _unseen_share(fine, atlas)
    surface, error_m = lighten(fine, options.mesh.error_m)
    joined = time.perf_counter()
    return Textured(
        geometry, raised, surface, atlas, pixels, invented, plain, known, unseen,
        len(fine.triangles), error_m, check_filled(background, frame, seen),
        made - begin, filled - made, joined - filled,
    )  # fmt: skip


def _unseen_share(surface: Surface, atlas: Atlas) -> float:
    """Share of the triangles whose middle no image shows (the paper: 1.7 %)."""
    if not len(surface.triangles):
        return 0.0
    height, width = atlas.seen.shape
    middle = atlas.uv(surface.pixel)[surface.triangles].mean(axis=1)
    at = np.clip((middle * [width, height]).astype(np.int64), 0, [width - 1, height - 1])
    return float(1.0 - atlas.seen[at[:, 1], at[:, 0]].mean())

