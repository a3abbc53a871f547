"""How much better a path fits where it was found than anywhere around: its margin.

A model of another place has edges, too, and particles settle where they fit best. There, other
places nearby fit about as well; where the drive was, none does.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from veduta.drive.read.surface_model import SurfaceModel

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class RivalParameters:
    """sigma_m: of points about edges, the stiffness of the path included. own_m: places nearer are
    the same one. rival_m: places from there to `farthest_m` are rivals. step_m: between places that
    are looked at; so many as `refined` of the best are looked at again by `fine_m`, with points
    about edges by `sharp_m`: streets are alike but for decimetres by which their fronts step.
    turns_rad: headings that are tried. scans, points: so many are laid onto the model. passed_at:
    part of a beam's way at which nothing may stand. near, wide: deviations, in cells of the model's
    edges, by which the sharpness of a path is told; cells finer than `finest_m` count as that
    large, as no path is known better.
    """

    sigma_m: float = 0.6
    own_m: float = 1.5
    rival_m: float = 4.0
    farthest_m: float = 24.0
    step_m: float = 1.0
    fine_m: float = 0.125
    turns_rad: tuple[float, ...] = (-0.04, -0.02, 0.0, 0.02, 0.04)
    scans: int = 80
    points: int = 40
    refined: int = 16
    sharp_m: float = 0.3
    near: float = 0.8
    wide: float = 2.4
    passed_at: float = 0.75
    finest_m: float = 0.25


@dataclass(frozen=True)
class Margin:
    """own, rival: how well the path fits where it is, and at the best other place: 1 at best.

    away: (2,) m to that place.
    """

    own: float
    rival: float
    away: tuple[float, float]

    @property
    def share(self) -> float:
        """What of the path's fit no rival has: near 0, another place does as well; 0, too, where
        the path does not fit at all, or nothing is known.
        """
        if not self.own > 0.0 or not np.isfinite(self.rival):
            return 0.0
        return 1.0 - self.rival / self.own


def margin_of(
    poses: Floats,
    scans: Sequence[Floats],
    model: SurfaceModel,
    parameters: RivalParameters | None = None,
) -> Margin:
    """The path as a stiff line, moved and turned over the model. poses: (k, 3) in its CRS (m, rad).

    scans: (n, 2) points of each in the vehicle's frame (m).
    """
    chosen = parameters or RivalParameters()
    points, passed = (laid_scans(poses, scans, part, chosen) for part in (1.0, chosen.passed_at))
    middle = points.mean(axis=0)
    around = np.stack([points, passed]) - middle
    reach = np.arange(-chosen.farthest_m, chosen.farthest_m + 1e-9, chosen.step_m)
    places = np.stack(np.meshgrid(reach, reach, indexing="ij"), axis=2).reshape(-1, 2)
    length = np.linalg.norm(places, axis=1)
    own = _refined(places[length <= chosen.own_m], around, middle, model, chosen)
    ring = (length >= chosen.rival_m) & (length <= chosen.farthest_m)
    rival = _refined(places[ring], around, middle, model, chosen)
    x, y = rival[1].tolist()
    return Margin(own[0], rival[0], (x, y))


def _refined(
    places: Floats, around: Floats, middle: Floats, model: SurfaceModel, chosen: RivalParameters
) -> tuple[float, Floats]:
    """The best fit among places (p, 2) and finer ones about the best of them."""
    laid, rough = [], []
    for turn in chosen.turns_rad:
        cosine, sine = np.cos(turn), np.sin(turn)
        laid.append(middle + around @ np.array([[cosine, sine], [-sine, cosine]]))  # (2, n, 2)
        rough.append(fits_of(places, laid[-1], model, chosen))
    order = np.argsort(-np.concatenate(rough), kind="stable")[: chosen.refined]
    fine = np.arange(-chosen.step_m / 2, chosen.step_m / 2 + 1e-9, chosen.fine_m)
    finer = np.stack(np.meshgrid(fine, fine, indexing="ij"), axis=2).reshape(-1, 2)
    sharp = replace(chosen, sigma_m=chosen.sharp_m)
    best, where = -1.0, places[0]
    for turn, row in zip(*np.divmod(order, len(places)), strict=True):
        fits = fits_of(places[row] + finer, laid[turn], model, sharp)
        if fits.max() > best:
            best, where = float(fits.max()), places[row] + finer[int(fits.argmax())]
    return best, where


def sharpness_of(
    poses: Floats,
    scans: Sequence[Floats],
    model: SurfaceModel,
    parameters: RivalParameters | None = None,
) -> float:
    """How many of the points near edges lie right on them: a third where they are strewn about, as
    in a model of another place; 1 where all do. 0 where none is near one.
    """
    chosen = parameters or RivalParameters()
    cell_m = max(model.cell_m, chosen.finest_m)
    off = _distances(laid_scans(poses, scans, 1.0, chosen), model) / cell_m
    near, wide = (
        float(np.exp(-0.5 * (off / width) ** 2).sum()) for width in (chosen.near, chosen.wide)
    )
    return near / wide if wide > 0.0 else 0.0


def fits_of(places: Floats, points: Floats, model: SurfaceModel, chosen: RivalParameters) -> Floats:
    """(p,) how near to edges the points lie on average where they are moved by (p, 2), less the
    share of beams through what stands there. points: (2, n, 2) ends of beams, and places on their
    way; what is off the map counts as on no edge and as free.
    """
    found = np.zeros(len(places))
    for row, place in enumerate(places):
        ends, passed = (_distances(one + place, model) for one in points)
        near = np.exp(-0.5 * (ends / chosen.sigma_m) ** 2)
        found[row] = near.mean() - (passed < -chosen.sigma_m).mean()
    return found


def _distances(points: Floats, model: SurfaceModel) -> Floats:
    """(n,) of points (n, 2) to the nearest edge (m), negative inside of what stands; inf where
    nothing is known.
    """
    height, width = model.distance_m.shape
    at = np.floor((points - np.array(model.low)) / model.cell_m).astype(np.int64)
    inside = (at >= 0).all(axis=1) & (at[:, 0] < width) & (at[:, 1] < height)
    at = np.where(inside[:, None], at, 0)
    off = np.where(inside, model.distance_m[at[:, 1], at[:, 0]], np.nan).astype(np.float64)
    return np.where(np.isfinite(off), off, np.inf)


def laid_scans(
    poses: Floats, scans: Sequence[Floats], part: float, chosen: RivalParameters
) -> Floats:
    """(n, 2) points of some scans in the model's CRS (m), or places at a part of the way there."""
    every = max(len(poses) // chosen.scans, 1)
    found = []
    for row in range(0, len(poses), every):
        points = scans[row][:: max(len(scans[row]) // chosen.points, 1)]
        cosine, sine = np.cos(poses[row, 2]), np.sin(poses[row, 2])
        turned = part * points @ np.array([[cosine, sine], [-sine, cosine]])
        found.append(turned + poses[row, :2])
    return np.concatenate(found)
