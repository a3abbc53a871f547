"""Photos as pinhole views, and which of them sees a plane without a building in between.

What stands before a face is found per photo: the nearest surface of the model along rays through
a grid of its pixels (embree). A reciprocal depth is linear over the image of a plane, so a place
of a plane is hidden where the grid's reciprocal depth is larger than the plane's own by more than
what the neighbourhood of the place and `NEARER_M` explain.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import cv2
import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from numpy.typing import NDArray

from veduta.photos.city.model import CityModel
from veduta.photos.straight import Pinhole
from veduta.photos.texture.faces import Face

STEP_PX = 2
"""A ray for each square of so many pixels; more in photos longer than `RAYS` squares."""
RAYS = 1000
REACH_STEPS = 1
"""What hides a place hides so many steps around it, too: a registration is off by pixels."""
NEARER_M = 0.3
"""What stands less than this before a face belongs to it, or to a corner of it."""


@dataclass(frozen=True)
class View:
    """A photo without distortion and where it was taken, in the frame of the city model.

    cam_from_world: (3, 4), metres. pixels: reads (h, w, 3) uint8 sRGB.
    valid: reads (h, w) bool, False where the picture shows nothing; None where it shows all over.
    """

    name: str
    camera: Pinhole
    cam_from_world: NDArray[np.float64]
    pixels: Callable[[], NDArray[np.uint8]]
    valid: Callable[[], NDArray[np.bool_]] | None = field(default=None)

    @property
    def eye(self) -> NDArray[np.float64]:
        """(3,) where it was taken."""
        found: NDArray[np.float64] = -self.cam_from_world[:, :3].T @ self.cam_from_world[:, 3]
        return found

    @property
    def step_px(self) -> int:
        """The side of the squares of pixels that have a ray each."""
        return max(STEP_PX, round(max(self.camera.width_px, self.camera.height_px) / RAYS))

    @property
    def intrinsics(self) -> NDArray[np.float64]:
        """K (3, 3)."""
        (focal_x, focal_y), (x, y) = self.camera.focal_px, self.camera.centre_px
        return np.array([[focal_x, 0.0, x], [0.0, focal_y, y], [0.0, 0.0, 1.0]])


@dataclass(frozen=True)
class PlaneView:
    """A face in a view: pixel times depth = matrix @ (metres right, metres down, 1).

    inverse: (3,) reciprocal depth at a pixel = inverse @ (x, y, 1).
    """

    matrix: NDArray[np.float64]
    inverse: NDArray[np.float64]


def plane_view(view: View, face: Face) -> PlaneView | None:
    """None where the camera is behind the face, or sees nothing of it."""
    local_normal = view.cam_from_world[:, :3] @ face.normal
    corner = view.cam_from_world[:, :3] @ face.corner + view.cam_from_world[:, 3]
    distance = -float(local_normal @ corner)
    if distance < 1e-2:
        return None
    columns = view.cam_from_world[:, :3] @ np.stack([face.right, face.down], axis=1)
    matrix = view.intrinsics @ np.column_stack([columns, corner])
    inverse: NDArray[np.float64] = np.linalg.inv(view.intrinsics).T @ (-local_normal / distance)
    width, height = face.size_m
    rectangle = np.array([[0, 0, 1], [width, 0, 1], [width, height, 1], [0, height, 1.0]])
    x, y, depth = matrix @ rectangle.T
    outside = [
        depth < 1e-3,
        x < 0,
        y < 0,
        x > view.camera.width_px * depth,
        y > view.camera.height_px * depth,
    ]
    if any(side.all() for side in outside):
        return None
    return PlaneView(matrix, inverse)


@dataclass(frozen=True)
class Nearness:
    """The model in a view: reciprocal depths, 0 in the open, a row and column per `step_px`.

    least, most: (h, w) around each step. sky: (h, w) rays that go up and meet nothing.
    triangles: those of the model that rays meet first.
    """

    least: NDArray[np.float32]
    most: NDArray[np.float32]
    sky: NDArray[np.bool_]
    triangles: NDArray[np.int64]

    @property
    def nbytes(self) -> int:
        """Of all."""
        return sum(one.nbytes for one in (self.least, self.most, self.sky, self.triangles))


class Blockers:
    """All faces of the model under one ray tracer; triangles count on from building to building.

    first: (buildings + 1,) the first triangle of each.
    """

    def __init__(self, city: CityModel) -> None:
        corners = [
            (building.part.positions_m.astype(np.float64) + building.offset_m)[
                building.part.triangles.indices
            ]
            for building in city.buildings
        ]
        self.first = np.cumsum([0, *map(len, corners)])
        self._tracer = EmbreeScene()
        self._mesh = TriangleMesh(self._tracer, np.concatenate(corners).astype(np.float32))

    def nearness(self, view: View) -> Nearness:
        """What stands in the way of a view."""
        step = view.step_px
        rows = -(-view.camera.height_px // step)
        columns = -(-view.camera.width_px // step)
        x, y = np.meshgrid(np.arange(columns) + 0.5, np.arange(rows) + 0.5)
        pixels = np.stack([x.ravel() * step, y.ravel() * step, np.ones(x.size)])
        rays = (np.linalg.solve(view.intrinsics, pixels).T @ view.cam_from_world[:, :3]).astype(
            np.float32
        )
        origins = np.broadcast_to(view.eye.astype(np.float32), rays.shape)
        found = self._tracer.run(np.ascontiguousarray(origins), rays, output=1)
        met = found["primID"] >= 0
        near = np.zeros(len(rays), dtype=np.float32)
        near[met] = 1.0 / np.maximum(found["tfar"][met], 1e-3)
        reach = np.ones((2 * REACH_STEPS + 1, 2 * REACH_STEPS + 1), dtype=np.uint8)
        squares = near.reshape(rows, columns)
        return Nearness(
            np.asarray(cv2.erode(squares, reach), dtype=np.float32),
            np.asarray(cv2.dilate(squares, reach), dtype=np.float32),
            np.asarray(~met & (rays[:, 2] > 0)).reshape(rows, columns),
            np.unique(found["primID"][met]).astype(np.int64),
        )


def seen_at(
    view: View,
    plane: PlaneView,
    nearness: Nearness,
    valid: NDArray[np.bool_] | None,
    sky: NDArray[np.bool_] | None,
    shape: tuple[int, int],
    pitch_m: float,
) -> NDArray[np.bool_]:
    """(rows, columns) which middles of squares of this pitch the view sees on the plane.

    Not along the outlines of what it sees. sky: by steps, where the view shows sky instead.
    """
    rows, columns = shape
    x = (np.arange(columns) + 0.5) * pitch_m
    y = ((np.arange(rows) + 0.5) * pitch_m)[:, None]
    along, down, depth = (row[0] * x + row[1] * y + row[2] for row in plane.matrix)
    ahead = depth > 1e-2
    safe = np.where(ahead, depth, 1.0)
    along, down = along / safe, down / safe
    width, height = view.camera.width_px, view.camera.height_px
    seen = ahead & (along >= 1) & (down >= 1) & (along < width - 1) & (down < height - 1)
    column = np.where(seen, along, 0).astype(np.int64)
    row = np.where(seen, down, 0).astype(np.int64)
    if valid is not None:
        seen &= valid[row, column]
    square = (row // view.step_px, column // view.step_px)
    if sky is not None:
        seen &= ~sky[square]
    # The grid's squares are read whole: the plane's own nearness varies over what they cover.
    reach = view.step_px * (REACH_STEPS + 0.5)
    own = 1.0 / safe
    slack = reach * (abs(plane.inverse[0]) + abs(plane.inverse[1])) + NEARER_M * own * own
    # Beside an outline of the model a pixel may show what lies behind: the sky, another house.
    return np.asarray(
        seen & (nearness.most[square] <= own + slack) & (nearness.least[square] >= own - slack)
    )


def warped(
    pixels: NDArray[np.uint8],
    plane: PlaneView,
    level: int,
    shape: tuple[int, int],
    pitch_m: float,
) -> NDArray[np.uint8]:
    """(rows, columns, 3) the view's colours at the middles of squares of this pitch.

    pixels: the view's picture, halved `level` times.
    """
    squares = np.array([[pitch_m, 0, pitch_m / 2], [0, pitch_m, pitch_m / 2], [0, 0, 1.0]])
    # OpenCV counts from the middle of the first pixel, and so do the halves of a picture.
    index = np.array([[1.0, 0, -0.5], [0, 1.0, -0.5], [0, 0, 1.0]])
    halved = np.diag([0.5**level, 0.5**level, 1.0])
    matrix = halved @ index @ plane.matrix @ squares
    flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
    size = (shape[1], shape[0])
    picture = cv2.warpPerspective(
        pixels, matrix, size, flags=flags, borderMode=cv2.BORDER_REPLICATE
    )
    return np.asarray(picture, dtype=np.uint8)


def density(
    plane: PlaneView, view: View, shape: tuple[int, int], pitch_m: float
) -> NDArray[np.float32]:
    """(rows, columns) pixels of the view per square metre of the plane, at squares' middles.

    The determinant of the derivative of the homography: det(matrix) / depth cubed.
    """
    rows, columns = shape
    x = (np.arange(columns) + 0.5) * pitch_m
    y = ((np.arange(rows) + 0.5) * pitch_m)[:, None]
    row = plane.matrix[2]
    depth = np.maximum(row[0] * x + row[1] * y + row[2], 1e-2)
    found: NDArray[np.float32] = (abs(np.linalg.det(plane.matrix)) / depth**3).astype(np.float32)
    return found
