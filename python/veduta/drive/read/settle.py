"""The last decimetres: pieces of the path slid to where their scans fit the model best.

Particles weigh scans by edges as blurred as their own doubt is, one scan after the other. Once the
place is known, all scans of a piece tell together, by sharper edges: along a street only the few
that run across it say where one is.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.drive.read.rivals import RivalParameters, fits_of, laid_scans
from veduta.drive.read.surface_model import SurfaceModel

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class SettleParameters:
    """piece_m: of the path that is slid as one. sigma_m: of points about edges. reach_m: how far a
    piece is slid at most. step_m, fine_m: between places that are looked at, and about the best of
    them. least: by so much the fit must get better (1 at best). alike: fits that differ by less are
    the same. scans, points: of a piece, laid onto the model. Chosen on seeds 300, 302 and 303 of
    `benchmarks drive/synthetic_path`.
    """

    piece_m: float = 150.0
    sigma_m: float = 0.3
    reach_m: float = 1.5
    step_m: float = 0.25
    fine_m: float = 0.125
    least: float = 0.001
    alike: float = 1e-6
    scans: int = 300
    points: int = 60


def settled(
    poses: Floats,
    scans: Sequence[Floats],
    model: SurfaceModel,
    parameters: SettleParameters | None = None,
) -> Floats:
    """(k, 3) the poses (m, rad) moved, piece by piece; between their middles the shift changes
    evenly. scans: (n, 2) points of each in the vehicle's frame (m).
    """
    chosen = parameters or SettleParameters()
    step = np.linalg.norm(np.diff(poses[:, :2], axis=0), axis=1)
    along = np.concatenate([[0.0], np.cumsum(step)])
    count = max(round(float(along[-1]) / chosen.piece_m), 1)
    ends = np.linspace(0.0, along[-1], count + 1)
    middles, shifts = [], []
    for low, high in zip(ends[:-1], ends[1:], strict=True):
        rows = np.flatnonzero((along >= low) & (along <= high))
        if len(rows):
            middles.append((low + high) / 2.0)
            shifts.append(_shift(poses[rows], [scans[row] for row in rows.tolist()], model, chosen))
    moved = np.array(shifts).reshape(-1, 2)
    result = poses.copy()
    for axis in range(2):
        result[:, axis] += np.interp(along, middles, moved[:, axis])
    return result


def _shift(
    poses: Floats, scans: Sequence[Floats], model: SurfaceModel, chosen: SettleParameters
) -> Floats:
    """(2,) by which a piece fits best (m); none where that is hardly better."""
    rule = RivalParameters(sigma_m=chosen.sigma_m, scans=chosen.scans, points=chosen.points)
    laid = np.stack([laid_scans(poses, scans, part, rule) for part in (1.0, rule.passed_at)])
    reach = np.arange(-chosen.reach_m, chosen.reach_m + 1e-9, chosen.step_m)
    best = np.zeros(2)
    own = float(fits_of(best[None], laid, model, rule)[0])
    fit = own
    fine = np.arange(-chosen.step_m, chosen.step_m + 1e-9, chosen.fine_m)
    for offsets in (reach, fine):
        across, up = np.meshgrid(offsets, offsets, indexing="ij")
        places = best + np.column_stack([across.ravel(), up.ravel()])
        found = fits_of(places, laid, model, rule)
        # Bare walls fit alike all along: of places that fit as well the nearest is taken.
        alike = np.flatnonzero(found >= found.max() - chosen.alike)
        row = int(alike[np.linalg.norm(places[alike], axis=1).argmin()])
        if found[row] > fit:
            fit, best = float(found[row]), places[row]
    return best if fit > own + chosen.least else np.zeros(2)
