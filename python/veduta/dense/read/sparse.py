"""A few sure points: those of the camera set, else SIFT matches that the cameras confirm."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.dense.document.views import Views, camera_row, scaled_row
from veduta.run.errors import InputError

Pair = tuple[int, int]
_CONVENTION = (
    "Cameras look along +z, with x to the right and y down, and turn points of the world into their"
    " frame (not the other way); give them in that convention, and for photos of this size."
)


@dataclass(frozen=True)
class SparseParameters:
    """scale_side_px: longest side at which features are looked for. features: per photo. ratio:
    Lowe's (2004). most_px: distance from the epipolar line of a match that the cameras confirm, at
    1000 px. partners: photos that each is matched with. least_share: of the matches, below which
    the cameras are taken to be wrong (right cameras of a fountain confirmed 0.92 and
    0.94). least_matches: on which that is decided. least_in_view: share of a set's own points
    that must lie in front of the cameras that are said to show them, and in their photos or beside
    them by not more than beside (of the photo).
    """

    scale_side_px: int = 1000
    features: int = 3000
    ratio: float = 0.8
    most_px: float = 2.0
    partners: int = 6
    least_share: float = 0.3
    least_matches: int = 60
    least_in_view: float = 0.7
    beside: float = 0.05


@dataclass(frozen=True, eq=False)
class SparsePoints:
    """points_m: (n, 3) world. visible: for each view the indices of the points that it shows.
    confirmed: share of the matches that the cameras confirm (None where none were made).
    """

    points_m: NDArray[np.float64]
    visible: tuple[NDArray[np.intp], ...]
    confirmed: float | None = None


def match_points(views: Views, source: str, parameters: SparseParameters) -> SparsePoints:
    """Points from SIFT matches between near views.

    InputError where the cameras confirm too few: another convention, or other photos.
    """
    features = [_features(views, view, parameters) for view in range(len(views))]
    points: list[NDArray[np.float64]] = []
    seen: list[list[NDArray[np.intp]]] = [[] for _ in range(len(views))]
    count = made = true = 0
    for first, second in near_pairs(views, parameters.partners):
        a, b = _matches(features[first], features[second], parameters.ratio)
        rows = camera_row(views.cameras[first]), camera_row(views.cameras[second])
        found = _confirmed(a, b, rows, parameters.most_px * _px_scale(views, first))
        made, true = made + len(a), true + len(found)
        if len(found) >= 8:
            points.append(found)
            index = np.arange(count, count + len(found))
            seen[first].append(index)
            seen[second].append(index)
            count += len(found)
    _require_confirmed(source, made, true, parameters)
    none = np.zeros(0, dtype=np.intp)
    return SparsePoints(
        np.concatenate(points) if points else np.zeros((0, 3)),
        tuple(np.concatenate(one) if one else none for one in seen),
        true / made if made else None,
    )


def _require_confirmed(source: str, made: int, true: int, parameters: SparseParameters) -> None:
    if made >= parameters.least_matches and true < parameters.least_share * made:
        fault = (
            f"has cameras that do not fit their photos: of {made} matches between photos they "
            f"confirm {true}"
        )
        raise InputError(source, fault, _CONVENTION)


def require_in_view(
    views: Views, sparse: SparsePoints, source: str, parameters: SparseParameters
) -> None:
    """Refuse cameras that do not have the points of their own set before them, in their photos."""
    made = right = 0
    for camera, index in zip(views.cameras, sparse.visible, strict=True):
        pixels, depth = camera.project(sparse.points_m[index])
        size = np.array([camera.width_px, camera.height_px])
        margin = parameters.beside * size
        inside = ((pixels >= -margin) & (pixels <= size + margin)).all(axis=1)
        made, right = made + len(index), right + int((inside & (depth > 0.0)).sum())
    if made >= parameters.least_matches and right < parameters.least_in_view * made:
        fault = (
            f"has cameras that do not fit their points: of {made} places where photos are said to "
            f"show a point, {right} lie before the camera and in its photo"
        )
        raise InputError(source, fault, _CONVENTION)


def near_pairs(views: Views, partners: int) -> list[Pair]:
    """For each view those nearest to it, among those that look within 75 degrees of its way."""
    poses = np.stack([one.cam_from_world for one in views.cameras])
    eyes = np.stack([one.centre() for one in views.cameras])
    ahead = poses[:, 2, :3]
    away = np.linalg.norm(eyes[:, None] - eyes[None], axis=2)
    away[(ahead @ ahead.T < np.cos(np.radians(75.0))) | np.eye(len(views), dtype=bool)] = np.inf
    found: set[Pair] = set()
    for view, row in enumerate(away):
        for other in np.argsort(row, kind="stable")[:partners]:
            if np.isfinite(row[other]) and row[other] > 0.0:
                found.add((min(view, int(other)), max(view, int(other))))
    return sorted(found)


def _px_scale(views: Views, view: int) -> float:
    camera = views.cameras[view]
    return max(camera.width_px, camera.height_px) / 1000.0


def _features(
    views: Views, view: int, parameters: SparseParameters
) -> tuple[NDArray[np.float64], NDArray[np.float32]]:
    """Places (n, 2) in pixels of the working size, and descriptors (n, 128)."""
    camera = views.cameras[view]
    scale = min(1.0, parameters.scale_side_px / max(camera.width_px, camera.height_px))
    grey = views.grey(view, scale)
    detector = cv2.SIFT.create(nfeatures=parameters.features)
    mask = views.hidden(view)
    shown = None
    if mask is not None:
        size = (grey.shape[1], grey.shape[0])
        shown = cv2.resize((~mask).astype(np.uint8), size, interpolation=cv2.INTER_NEAREST)
    keypoints, descriptors = detector.detectAndCompute(grey, shown)
    if not keypoints:
        return np.zeros((0, 2)), np.zeros((0, 128), dtype=np.float32)
    places = np.array([one.pt for one in keypoints], dtype=np.float64) + 0.5
    row, full = scaled_row(camera, scale), camera_row(camera)
    places *= full[:2] / row[:2]
    # RootSIFT (Arandjelovic and Zisserman 2012)
    rooted = np.sqrt(descriptors / np.maximum(descriptors.sum(axis=1, keepdims=True), 1e-6))
    return places, rooted.astype(np.float32)


def _matches(
    first: tuple[NDArray[np.float64], NDArray[np.float32]],
    second: tuple[NDArray[np.float64], NDArray[np.float32]],
    ratio: float,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    if min(len(first[0]), len(second[0])) < 8:
        return np.zeros((0, 2)), np.zeros((0, 2))
    alike = first[1] @ second[1].T
    best = alike.argmax(axis=1)
    top = np.partition(alike, -2, axis=1)[:, -2:]
    away = np.sqrt(np.maximum(2.0 - 2.0 * top, 0.0))
    both = alike.argmax(axis=0)[best] == np.arange(len(best))
    good = both & (away[:, 1] < ratio * away[:, 0])
    return first[0][good], second[0][best[good]]


def _confirmed(
    a: NDArray[np.float64],
    b: NDArray[np.float64],
    rows: tuple[NDArray[np.float64], NDArray[np.float64]],
    most_px: float,
) -> NDArray[np.float64]:
    """The points of the matches that lie in front of both cameras and lead back to their pixels."""
    if len(a) == 0:
        return np.zeros((0, 3))
    projections = [_projection(row) for row in rows]
    raw = cv2.triangulatePoints(projections[0], projections[1], a.T.copy(), b.T.copy())
    points = np.asarray((raw[:3] / np.where(raw[3] == 0.0, 1e-12, raw[3])).T, dtype=np.float64)
    good = np.isfinite(points).all(axis=1)
    for projection, places in zip(projections, (a, b), strict=True):
        seen = points @ projection[:, :3].T + projection[:, 3]
        with np.errstate(divide="ignore", invalid="ignore"):
            away = np.linalg.norm(seen[:, :2] / seen[:, 2:] - places, axis=1)
        good &= (seen[:, 2] > 0.0) & (away < most_px)
    return points[good]


def _projection(row: NDArray[np.float64]) -> NDArray[np.float64]:
    lens = np.array([[row[0], 0.0, row[2]], [0.0, row[1], row[3]], [0.0, 0.0, 1.0]])
    return np.asarray(lens @ np.column_stack([row[4:13].reshape(3, 3), row[13:]]))
