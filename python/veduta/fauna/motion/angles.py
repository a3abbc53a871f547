"""The angles A(s) of an animal's axis, and the axis again from them (paper 4.2.1, figure 11).

An angle is that of the axis against x, counter-clockwise, taken from the tail towards the head:
where the animal looks. The paper leaves two things open, which are solved so. The angle is known
but for whole turns: along the axis it is unwrapped point by point (an axis that is sampled closely
turns by less than half a turn from point to point), and the frames are brought together by whole
turns of their mean. The signal must not jump where it repeats: samples are appended along the cubic
that leaves the last angle with its slope and arrives at the first with its slope.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

COEFFICIENTS = 7
"""Fourier coefficients 1 to 7 are the state of an axis; the one at 0 is how it is turned."""
APPENDED = 0.5
"""Samples that are appended, as a share of those that the axis has."""
Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]


def equal_steps(points: Floats, count: int) -> Floats:
    """`count` points at equal steps of arc length. points: (..., n, 2), any number of axes."""
    flat = points.reshape(-1, *points.shape[-2:])
    steps = np.linalg.norm(np.diff(flat, axis=1), axis=2)
    along = np.concatenate([np.zeros((len(flat), 1)), np.cumsum(steps, axis=1)], axis=1)
    share = np.linspace(0.0, 1.0, count)
    found = np.empty((len(flat), count, points.shape[-1]))
    for row, (line, arc) in enumerate(zip(flat, along, strict=True)):
        for axis in range(line.shape[1]):
            found[row, :, axis] = np.interp(share * arc[-1], arc, line[:, axis])
    return found.reshape(*points.shape[:-2], count, points.shape[-1])


def axis_angles(points: Floats) -> Floats:
    """(t, n - 1) the angles of axes (t, n, 2), head first, no jump along them or in time."""
    towards_head = points[:, :-1] - points[:, 1:]
    angles = np.unwrap(np.arctan2(towards_head[..., 1], towards_head[..., 0]), axis=1)
    mean = angles.mean(axis=1)
    return np.asarray(angles + (np.unwrap(mean) - mean)[:, None], dtype=np.float64)


def extended(angles: Floats) -> Floats:
    """The signal with the appended samples, after which it begins anew without a jump."""
    count = angles.shape[-1]
    appended = round(APPENDED * count)
    share = np.arange(1, appended + 1) / (appended + 1)
    span = float(appended + 1)
    first, last = angles[..., :1], angles[..., -1:]
    slope_in, slope_out = angles[..., 1:2] - first, last - angles[..., -2:-1]
    joined = (
        (2 * share**3 - 3 * share**2 + 1) * last
        + (share**3 - 2 * share**2 + share) * span * slope_out
        + (-2 * share**3 + 3 * share**2) * first
        + (share**3 - share**2) * span * slope_in
    )
    return np.concatenate([angles, joined], axis=-1)


def coefficients(angles: Floats) -> Complexes:
    """(t, 8) Fourier coefficients 0 to 7 of the angles (t, n), by the length of the signal."""
    signal = extended(angles)
    found = np.fft.rfft(signal, axis=-1)[..., : COEFFICIENTS + 1] / signal.shape[-1]
    return np.asarray(found, dtype=np.complex128)


def angles_of(states: Complexes, count: int) -> Floats:
    """(t, count) the angles along the axis from coefficients (t, 8), the inverse of the above."""
    length = count + round(APPENDED * count)
    spectrum = np.zeros((*states.shape[:-1], length // 2 + 1), dtype=np.complex128)
    spectrum[..., : states.shape[-1]] = states * length
    return np.asarray(np.fft.irfft(spectrum, length, axis=-1)[..., :count], dtype=np.float64)


def axis_of(angles: Floats, length: float = 1.0) -> Floats:
    """(t, n + 1, 2) the axis, head first, its middle of mass at the origin. angles: (t, n)."""
    step = length / angles.shape[-1]
    back = -step * np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    start = np.zeros((*angles.shape[:-1], 1, 2))
    points = np.concatenate([start, np.cumsum(back, axis=-2)], axis=-2)
    middle = 0.5 * (points[..., :-1, :] + points[..., 1:, :]).mean(axis=-2, keepdims=True)
    return np.asarray(points - middle, dtype=np.float64)
