"""The segments as a place: a mesh each, the scan points with their classes, the images, a tour."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from veduta.drive.build.fill import Source
from veduta.drive.build.layers import PointClass
from veduta.drive.build.pictures_of import Seen
from veduta.drive.build.segment import Geometry, Textured
from veduta.drive.record import DriveRecord
from veduta.place.features import FeatureRow, feature_table
from veduta.place.manifest import PlaceCamera, Start, Tour
from veduta.place.material import Material, Texture
from veduta.place.mesh import Mesh
from veduta.place.place import Cloud, Place, Standing
from veduta.place.semantics import Provenance, SemanticClass

PICTURES = "pictures"
_PLAIN, _PLAIN_GROUND = (0.62, 0.6, 0.57), (0.36, 0.36, 0.37)
_ROWS: tuple[tuple[bool, Source, FeatureRow], ...] = (
    (True, Source.MEASURED, (SemanticClass.WALL, Provenance.MEASURED, "wall")),
    (True, Source.FILLED, (SemanticClass.WALL, Provenance.INVENTED, "wall filled")),
    (True, Source.INFERRED, (SemanticClass.WALL, Provenance.INFERRED, "wall above the scan")),
    (False, Source.MEASURED, (SemanticClass.GROUND, Provenance.MEASURED, "ground")),
    (False, Source.FILLED, (SemanticClass.GROUND, Provenance.INVENTED, "ground filled")),
)
_CLASS_COLOURS: dict[int, tuple[int, int, int]] = {
    PointClass.UNCLASSIFIED: (120, 120, 130),
    PointClass.GROUND: (150, 125, 100),
    PointClass.BUILDING: (225, 190, 110),
    PointClass.FOREGROUND: (60, 150, 80),
    PointClass.GLASS: (90, 180, 230),
}
_HIDDEN_M = 1.0
"""A point so far behind what hides it is not seen."""
_EYE_EVERY_M, _SPEED_M_S = 2.0, 3.0


def segment_mesh(textured: Textured, middle: NDArray[np.float64], *, wall: bool) -> Mesh | None:
    """The walls or the ground of a segment about an origin `middle` (3,); None where none is."""
    surface, geometry = textured.surface, textured.geometry
    chosen = np.flatnonzero(surface.wall == wall)
    if not len(chosen):
        return None
    rows = [row for row in _ROWS if row[0] == wall]
    feature = np.zeros(len(chosen), dtype=np.int32)
    for number, (_, source, _) in enumerate(rows):
        feature[surface.source[chosen] == source] = number
    used, triangles = np.unique(surface.triangles[chosen], return_inverse=True)
    uv, texture = _cropped(textured, textured.atlas.uv(surface.pixel[used]))
    identity = geometry.segment.id if wall else f"{geometry.segment.id}-ground"
    return Mesh(
        id=identity,
        positions_m=(surface.vertices[used] - middle).astype(np.float32),
        triangles=triangles.reshape(-1, 3).astype(np.uint32),
        features=feature_table(identity, [row for _, _, row in rows]),
        materials=(
            Material("images", texture=texture, unlit=True),
            Material("not seen in any image", _PLAIN if wall else _PLAIN_GROUND),
        ),
        triangle_feature=feature,
        triangle_material=_of_triangles(textured, textured.plain)[chosen].astype(np.int32),
        uv=uv,
    )


def _cropped(
    textured: Textured, uv: NDArray[np.float32]
) -> tuple[NDArray[np.float32], Texture]:
    """The rows of the atlas that a part of the surface needs, and its coordinates there."""
    height = len(textured.pixels)
    low = max(int(np.floor(uv[:, 1].min() * height)) - 1, 0)
    high = min(int(np.ceil(uv[:, 1].max() * height)) + 1, height)
    moved = uv.copy()
    moved[:, 1] = (uv[:, 1] * height - low) / (high - low)
    invented = (textured.invented | textured.plain)[low:high]
    return moved, Texture(np.ascontiguousarray(textured.pixels[low:high]), invented)


def _of_triangles(textured: Textured, mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """(m,) what a mask of the atlas says at the middle of each triangle."""
    height, width = mask.shape
    uv = textured.atlas.uv(textured.surface.pixel)[textured.surface.triangles].mean(axis=1)
    at = np.clip((uv * [width, height]).astype(np.int64), 0, [width - 1, height - 1])
    return np.asarray(mask[at[:, 1], at[:, 0]])


def drive_place(
    record: DriveRecord,
    textured: Sequence[Textured],
    seen: Sequence[Seen],
    line: NDArray[np.float64],
    road_m: float,
) -> Place:
    """line: (c, 3) the path of the scanner, along which the tour goes."""
    place = Place(title=record.name, crs=record.crs, origin_m=record.origin_m)
    for one in textured:
        if not len(one.surface.triangles):
            continue
        middle = one.surface.vertices.mean(axis=0)
        transform = np.eye(4)
        transform[:3, 3] = middle
        name = f"{one.geometry.segment.side} side, {one.geometry.segment.id}"
        for wall in (True, False):
            mesh = segment_mesh(one, middle, wall=wall)
            told = name if wall else f"{name}, ground"
            if mesh is not None:
                place.add(mesh, Standing(told, transform, ground=not wall, document="drive.json"))
    taken_out = np.concatenate([one.geometry.foreground() for one in textured])
    # Otherwise what was taken out would stand in the street again, as points and in the photos.
    place.hidden = ("points", "cameras", "photos")
    place.clouds.append(Cloud("taken-out", taken_out, coloured(taken_out, seen)))
    place.cameras = [
        PlaceCamera(
            id=shot.name, name=shot.name, picture=f"{PICTURES}/{shot.name}.jpg",
            width_px=shot.width_px, height_px=shot.height_px, focal_px=shot.focal_px,
            centre_px=shot.centre_px, transform=tuple(shot.world_from_cam.T.ravel().tolist()),
        )
        for shot in record.shots
    ]  # fmt: skip
    if len(line) > 1:
        place.tours.append(_tour(line, road_m))
        ahead = line[min(len(line) - 1, 100)]
        eye, target = line[0], np.array([ahead[0], ahead[1], line[0][2]])
        place.start = Start(eye=tuple(eye.tolist()), target=tuple(target.tolist()))
    return _above_zero(place)


def _above_zero(place: Place) -> Place:
    """The same place with its lowest ground at z = 0: what is shown below that is hidden there.

    The origin moves the other way, so that all coordinates in the world stay.
    """
    grounds = [one for one in place.parts.values() if one.standing.ground]
    lowest = min((float(one.triangles()[0][:, 2].min()) for one in grounds), default=0.0)
    if lowest >= 0.0 or place.start is None:
        return place
    x, y, z = place.origin_m
    start = place.start
    raised = Place(place.title, crs=place.crs, origin_m=(x, y, z + lowest))
    raised.start = Start(eye=_up(start.eye, -lowest), target=_up(start.target, -lowest))
    return raised.merge(place)


def _up(place: tuple[float, float, float], by_m: float) -> tuple[float, float, float]:
    return place[0], place[1], place[2] + by_m


def coloured(points: NDArray[np.float64], seen: Sequence[Seen]) -> NDArray[np.uint8]:
    """(n, 3) the colours of foreground points in the image that shows each from nearest."""
    colours = np.tile(np.array(_CLASS_COLOURS[PointClass.FOREGROUND], dtype=np.uint8), (len(points), 1))
    nearest = np.full(len(points), np.inf)
    for one in seen:
        pixels, depth = one.shot.project(points)
        height, width = one.hidden_m.shape
        at = np.floor(np.clip(pixels, -1, 1e6)).astype(np.int64)
        inside = (depth > 1.0) & (at >= 0).all(axis=1) & (at[:, 0] < width) & (at[:, 1] < height)
        at = np.where(inside[:, None], at, 0)
        inside &= (depth < one.hidden_m[at[:, 1], at[:, 0]] + _HIDDEN_M) & (depth < nearest)
        colours[inside] = one.pixels[at[inside, 1], at[inside, 0]]
        nearest[inside] = depth[inside]
    return colours


def classified(geometries: Sequence[Geometry]) -> Cloud:
    """The scan points of all segments, coloured by their classes."""
    points = [one.layers.points.points for one in geometries] or [np.zeros((0, 3))]
    kinds = [one.layers.kind for one in geometries] or [np.zeros(0, np.uint8)]
    kind = np.concatenate(kinds)
    table = np.zeros((256, 3), dtype=np.uint8)
    for value, colour in _CLASS_COLOURS.items():
        table[value] = colour
    return Cloud("points", np.concatenate(points), table[kind], kind)


def _tour(line: NDArray[np.float64], road_m: float) -> Tour:
    """Along the path as it was driven, looking ahead."""
    spacing = float(np.linalg.norm(np.diff(line[:2, :2], axis=0)))
    every = max(int(round(_EYE_EVERY_M / max(spacing, 1e-3))), 1)
    eyes = line[::every]
    if len(eyes) < 2:
        eyes = line[[0, -1]]
    heading = np.gradient(eyes[:, :2], axis=0)
    heading /= np.linalg.norm(heading, axis=1, keepdims=True)
    directions = np.concatenate([heading, np.zeros((len(eyes), 1))], axis=1)
    step = np.linalg.norm(np.diff(eyes, axis=0), axis=1) / _SPEED_M_S
    times = np.concatenate([[0.0], np.cumsum(np.maximum(step, 0.05))])
    lowered = eyes - [0.0, 0.0, max(road_m - 1.7, 0.0)]
    return Tour(
        id="drive", name="Along the drive", times_s=times.tolist(),
        eyes=[tuple(row) for row in lowered.tolist()],
        directions=[tuple(row) for row in directions.tolist()],
    )  # fmt: skip
