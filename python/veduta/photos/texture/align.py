"""Views that are off by centimetres laid onto each other, face by face.

A photo whose place is a little wrong shows a face moved. Each view is moved by an affine map of
the face's plane until it agrees with the median of all (Lucas and Kanade 1981, robustly), the
median is made anew, and so on. What all views share is taken out: the face stays where it is in
the mean. The map is held near none by what is known of poses: maps that little speaks for stay
small, and one that grows beyond `MOST_M` is dropped.
"""

from __future__ import annotations

from dataclasses import replace

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.photos.choosing import median_of
from veduta.photos.texture.cells import Sights
from veduta.photos.texture.choice import signal
from veduta.photos.texture.views import PlaneView

ROUNDS = 4
STEPS = 3
"""Of each view in a round."""
MOST_M = 0.25
FEWEST = 3
"""Views; of two that disagree none is known to be right."""
_HUBER = 0.04
_NOISE = 0.04
"""Of sRGB (0..1): what views of a face differ by besides."""
_SHIFT_M, _STRETCH_M = 0.05, 0.01
"""What poses are taken to be off by: the shift in the middle of what a view sees of the face, and
how much more it is at the ends of that."""
_FINE, _BROAD = 1.0, 5.0
"""Deviations (samples) between which things are compared: courses of bricks are finer than the
samples, and light that falls off over a wall is no edge of it."""
_INDEPENDENT = 0.1
"""Of the samples: those beside each other show the same edges."""
_LEAST_SAMPLES = 60


def aligned(sights: Sights, gains: NDArray[np.float64]) -> Sights:
    """The same views moved onto each other; seen stays as it was."""
    if len(sights.views) < FEWEST:
        return sights
    levelled = signal(sights, gains)
    images = np.stack([_smooth(one) for one in levelled.mean(axis=-1)])
    seen = np.stack([_within(mask) for mask in sights.seen])
    rows, columns = images.shape[1:]
    places = _places(rows, columns)
    moves = np.zeros((len(images), 6))
    priors = [_prior(mask, places, sights.grid.pitch_m) for mask in seen]
    for _ in range(ROUNDS):
        moved = np.stack([_moved(images[k], moves[k], places) for k in range(len(images))])
        moved[~seen] = np.nan
        middle = median_of(moved)
        for k in range(len(images)):
            moves[k] = _step(images[k], seen[k], middle, moves[k], places, priors[k])
        moves -= _mean(moves, seen)
    reach = np.abs(moves[:, :2]) + np.abs(moves[:, 2:4]) + np.abs(moves[:, 4:])
    moves[(reach > MOST_M / sights.grid.pitch_m).any(axis=1)] = 0.0
    return _applied(sights, moves, places)


def _smooth(levelled: NDArray[np.float32]) -> NDArray[np.float32]:
    """What is between fine and broad, by what is seen alone."""
    seen = (~np.isnan(levelled)).astype(np.float32)
    filled = np.nan_to_num(levelled)

    def blurred(deviation: float) -> NDArray[np.float32]:
        sum_ = cv2.GaussianBlur(filled, (0, 0), deviation)
        return np.asarray(sum_ / np.maximum(cv2.GaussianBlur(seen, (0, 0), deviation), 1e-3))

    return blurred(_FINE) - blurred(_BROAD)


def _within(mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
    return cv2.erode(mask.astype(np.uint8), np.ones((3, 3), np.uint8), borderValue=0) > 0


def _places(rows: int, columns: int) -> NDArray[np.float32]:
    """(rows, columns, 2) from -1 to 1 over the longer side, about the middle."""
    x, y = np.meshgrid(np.arange(columns), np.arange(rows))
    half = max(rows, columns) / 2
    return np.stack([(x - (columns - 1) / 2) / half, (y - (rows - 1) / 2) / half], axis=-1).astype(
        np.float32
    )


def _shift(move: NDArray[np.float64], places: NDArray[np.float32]) -> NDArray[np.float32]:
    """(rows, columns, 2) samples right and down to where each place is read."""
    found: NDArray[np.float32] = (
        move[:2] + places[..., :1] * move[2:4] + places[..., 1:] * move[4:]
    ).astype(np.float32)
    return found


def _moved(
    image: NDArray[np.float32], move: NDArray[np.float64], places: NDArray[np.float32]
) -> NDArray[np.float32]:
    rows, columns = image.shape[:2]
    x, y = np.meshgrid(np.arange(columns, dtype=np.float32), np.arange(rows, dtype=np.float32))
    shift = _shift(move, places)
    found = cv2.remap(
        image, x + shift[..., 0], y + shift[..., 1], cv2.INTER_LINEAR, borderMode=cv2.BORDER_REFLECT
    )
    return np.asarray(found, dtype=np.float32)


def _step(
    image: NDArray[np.float32],
    seen: NDArray[np.bool_],
    middle: NDArray[np.float32],
    move: NDArray[np.float64],
    places: NDArray[np.float32],
    prior: NDArray[np.float64],
) -> NDArray[np.float64]:
    """The move of one view towards the median: Gauss-Newton with Huber weights and a prior."""
    for _ in range(STEPS):
        now = _moved(image, move, places)
        usable = seen & ~np.isnan(middle)
        if usable.sum() < _LEAST_SAMPLES:
            return move
        slope_x = cv2.Sobel(now, cv2.CV_32F, 1, 0, ksize=3, scale=0.125)[usable]
        slope_y = cv2.Sobel(now, cv2.CV_32F, 0, 1, ksize=3, scale=0.125)[usable]
        x, y = places[usable].T
        off = (middle - now)[usable]
        off = off - np.median(off)
        columns = (slope_x, slope_y, slope_x * x, slope_y * x, slope_x * y, slope_y * y)
        slopes = np.stack(columns, axis=1).astype(np.float64)
        weight = np.minimum(1.0, _HUBER / np.maximum(np.abs(off), 1e-9)) / _NOISE**2
        weighted = _INDEPENDENT * (slopes * weight[:, None]).T
        move = move + np.linalg.solve(weighted @ slopes + prior, weighted @ off - prior @ move)
    return move


def _prior(
    seen: NDArray[np.bool_], places: NDArray[np.float32], pitch_m: float
) -> NDArray[np.float64]:
    """(6, 6) what speaks for no move: in the middle and at the ends of what the view sees."""
    own = places[seen]
    if not len(own):
        return np.eye(6)
    x, y = own.mean(axis=0).tolist()
    half = 2.0 * float(own.std(axis=0).max()) + 1e-3
    two = np.eye(2)
    from_move = np.block([[two, x * two, y * two], [np.zeros((4, 2)), half * np.eye(4)]])
    stiff = np.diag((pitch_m / np.array([_SHIFT_M] * 2 + [_STRETCH_M] * 4)) ** 2)
    found: NDArray[np.float64] = from_move.T @ stiff @ from_move
    return found


def _mean(moves: NDArray[np.float64], seen: NDArray[np.bool_]) -> NDArray[np.float64]:
    """The mean move, views that see more of the face counting more."""
    weight = seen.mean(axis=(1, 2)) ** 2 + 1e-9
    found: NDArray[np.float64] = (moves * weight[:, None]).sum(axis=0) / weight.sum()
    return found


def _applied(sights: Sights, moves: NDArray[np.float64], places: NDArray[np.float32]) -> Sights:
    """Colours and planes moved."""
    rows, columns = places.shape[:2]
    half, pitch = max(rows, columns) / 2, sights.grid.pitch_m
    planes = []
    colour = sights.colour.copy()
    for k, move in enumerate(moves):
        colour[k] = np.round(_moved(sights.colour[k].astype(np.float32), move, places))
        # The same map in metres from the corner: place + pitch * (shift + slopes @ normalised).
        slopes = np.stack([move[2:4], move[4:]], axis=1) / half
        middle = np.array([columns / 2, rows / 2]) * pitch
        map_ = np.eye(3)
        map_[:2, :2] += slopes
        map_[:2, 2] = pitch * move[:2] - slopes @ middle
        planes.append(PlaneView(sights.planes[k].matrix @ map_, sights.planes[k].inverse))
    return replace(sights, planes=tuple(planes), colour=colour)
