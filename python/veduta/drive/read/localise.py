"""Where the driven path lies in a surface model: Monte-Carlo localisation, then corrections spread.

Section 2 of Frueh et al. 2005 after Frueh and Zakhor 2001: 5,000 particles follow the steps of scan
matching; horizontal scans weigh them by edges of the model. What the particles agree on holds the
path, and the rest of it follows by its steps.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from veduta._core import VehicleParticles
from veduta.drive.read.pose_graph import Fix, Step, spread_corrections
from veduta.drive.read.rivals import Margin, margin_of, sharpness_of
from veduta.drive.read.scan_chain import ScanChain
from veduta.drive.read.scan_match import between
from veduta.drive.read.settle import settled
from veduta.drive.read.surface_model import SurfaceModel
from veduta.run.errors import NotFoundError

Floats = NDArray[np.float64]
_NEXT_SEED = 7919
"""Between the seeds of two tries."""
_WHAT = "the place of the drive in the surface model"
_REMEDY = "Give the model of the place of the drive, and a start nearer to where it began."
_SURE = "Where both are sure: `sure = true`."


@dataclass(frozen=True)
class LocaliseParameters:
    """Thresholds of localisation.

    particles, first_draws: of the filter, and of its start. sigma_m: of points about edges: cells
    of a metre, and eaves that hang over walls. outlier: share of points that belong to no edge:
    trees, cars. outside: what a point off the map counts as, against 1 on an edge: nothing outside
    of it is wrong. blocked: what it counts when a beam goes through what stands there: crowns of
    trees do that, walls do not. free_at: shares of a beam's way where that is looked at; of beams
    longer than free_m. worth: beams that a scan counts as. most_points: of a scan that are used.
    slip, slip_rad: of a step, its share that its length may be off, and radians per metre. sure_m:
    particles that are spread less are agreed. lasting: scans in a row see the same wall, so their
    covariance is taken so many times. map_m, map_rad: least deviation of a place in the model.
    fewest_sure: share of the scans after the first agreement that must be sure; fewest_of_all: of
    all scans. least_share: of their points on edges, on average. most_through: of their beams
    through what stands there. tries: runs with other draws, of which the best is taken: a street
    looks alike along itself, and particles that agree on a wrong place stay there. good: a run
    that fits so well is enough. least_margin: share of the path's fit that no place around has; in
    models of other streets, which are alike, places around fit about as well. least_sharp: of the
    points near edges, the share right on them (a third where they are strewn about): among as many
    other houses points lie near edges, not on them. Both were chosen on seeds 300 to 305 of
    `benchmarks drive/synthetic_path` and on the Delft tile. unique, sharp_alike: where the path
    fits so well nowhere else the place is told by that; where it has less margin, points must lie
    sharper on edges: chosen on seeds 400 to 402 of `benchmarks drive/refused_models`, where other
    streets came to a sharpness of 0.66 and their own to 0.72, and on the Delft tile, whose right
    starts have a margin of 0.33 and more, the mirrored ones one of up to 0.29.
    """

    particles: int = 5000
    first_draws: int = 100_000
    sigma_m: float = 0.5
    widest_sigma_m: float = 2.5
    spread_share: float = 0.25
    outlier: float = 0.08
    outside: float = 0.25
    blocked: float = 0.3
    free_at: tuple[float, ...] = (0.4, 0.75)
    free_m: float = 5.0
    worth: float = 4.0
    draw_below: float = 0.5
    most_points: int = 90
    slip: float = 0.1
    slip_rad: float = 0.008
    sure_m: float = 1.5
    lasting: float = 10.0
    map_m: float = 0.3
    map_rad: float = 0.01
    fewest_sure: float = 0.5
    fewest_of_all: float = 0.25
    least_share: float = 0.45
    most_through: float = 0.12
    tries: int = 4
    good: float = 0.8
    least_margin: float = 0.035
    least_sharp: float = 0.4
    unique: float = 0.3
    sharp_alike: float = 0.68


@dataclass(frozen=True, eq=False)
class Localised:
    """poses: (k, 3) of the key scans in the model's CRS. moved_m: (k, 2) by which each was
    corrected there, after the best rigid place of the whole path. share: (k,) of the points of each
    on edges. through: (k,) of the beams of each through what stands there. sure: (k,) whether the
    particles agreed. spread_m: (k,) theirs. margin: how much better the path fits than around.
    """

    poses: Floats
    moved_m: Floats
    share: Floats
    through: Floats
    sure: NDArray[np.bool_]
    spread_m: Floats
    margin: Margin


def localise(
    chain: ScanChain,
    model: SurfaceModel,
    start: tuple[float, float, float],
    reach: tuple[float, float, float],
    seed: int,
    loops: list[Step] | None = None,
    told: Callable[[float], None] = lambda share: None,
    parameters: LocaliseParameters | None = None,
) -> Localised:
    """start: x, y (m, CRS of the model) and heading (rad) of the first scan; reach: how far off.

    NotFoundError where the particles agree on no place, or scans do not fit where they agree: a
    model of another place is refused, not followed.
    """
    chosen = parameters or LocaliseParameters()
    rows = len(chain.keys)
    best: _Followed | None = None
    for number in range(chosen.tries):
        own = partial(_told_part, told, number, chosen.tries)
        followed = _followed(chain, model, start, reach, seed + _NEXT_SEED * number, own, chosen)
        if best is None or followed.fit() > best.fit():
            best = followed
        if best.fit() > chosen.good:
            break
    if best is None:
        raise NotFoundError("the place of the drive", "no try was asked for", "Ask for one.")
    poses, covariances, share, through = best.poses, best.covariances, best.share, best.through
    spread = np.sqrt(covariances[:, 0, 0] + covariances[:, 1, 1])
    sure = spread < chosen.sure_m
    _must_fit(sure, share, best.known, through, spread, chosen)
    steps = [
        Step(
            row - 1,
            row,
            between(chain.poses[row - 1], chain.poses[row]),
            chain.covariances[row - 1],
        )
        for row in range(1, rows)
    ]
    least = np.diag([chosen.map_m**2, chosen.map_m**2, chosen.map_rad**2])
    fixes = [
        Fix(row, poses[row], chosen.lasting * (covariances[row] + least))
        for row in np.flatnonzero(sure).tolist()
    ]
    placed = _placed(chain.poses, poses, sure)
    found = spread_corrections(placed, [*steps, *(loops or [])], fixes)
    found = settled(found, chain.scans, model)
    margin = margin_of(found, chain.scans, model)
    _must_be_here(margin, sharpness_of(found, chain.scans, model), chosen)
    return Localised(found, found[:, :2] - placed[:, :2], share, through, sure, spread, margin)


@dataclass(frozen=True, eq=False)
class _Followed:
    """One run of the particles: (k, ...) of the key scans, as `VehicleParticles.step` tells
    them.
    """

    poses: Floats
    covariances: Floats
    share: Floats
    known: Floats
    through: Floats

    def fit(self) -> float:
        """Points on edges less beams through what stands there, once the start is over."""
        later = slice(len(self.share) // 3, None)
        return float((self.share[later] * self.known[later] - self.through[later]).mean())


def _told_part(told: Callable[[float], None], number: int, parts: int, share: float) -> None:
    told((number + share) / parts)


def _followed(
    chain: ScanChain,
    model: SurfaceModel,
    start: tuple[float, float, float],
    reach: tuple[float, float, float],
    seed: int,
    told: Callable[[float], None],
    chosen: LocaliseParameters,
) -> _Followed:
    rows = len(chain.keys)
    poses, covariances = np.zeros((rows, 3)), np.zeros((rows, 3, 3))
    share, known, through = np.zeros(rows), np.zeros(rows), np.zeros(rows)
    particles = VehicleParticles(
        model.distance_m, model.low, model.cell_m, start, reach,
        particles=chosen.particles, first_draws=chosen.first_draws, seed=seed,
        sigma_m=chosen.sigma_m, widest_sigma_m=chosen.widest_sigma_m,
        spread_share=chosen.spread_share, outlier=chosen.outlier, outside=chosen.outside,
        blocked=chosen.blocked, worth=chosen.worth, draw_below=chosen.draw_below,
    )  # fmt: skip
    for row in range(rows):
        motion, noise = np.zeros(3), np.zeros(3)
        if row:
            motion = between(chain.poses[row - 1], chain.poses[row])
            noise = _noise(motion, chain.covariances[row - 1], chosen)
        points = _thinned(chain.scans[row], chosen.most_points)
        pose, flat, share[row], known[row], through[row] = particles.step(
            _three(motion), _three(noise), points, _passed(points, chosen)
        )
        poses[row], covariances[row] = pose, np.reshape(flat, (3, 3))
        told((row + 1) / rows)
    return _Followed(poses, covariances, share, known, through)


def _noise(motion: Floats, covariance: Floats, chosen: LocaliseParameters) -> Floats:
    length = float(np.hypot(motion[0], motion[1]))
    slip = np.array([chosen.slip * length, chosen.slip * length, chosen.slip_rad * length])
    return np.asarray(np.sqrt(np.diag(covariance) + slip**2), dtype=np.float64)


def _three(values: Floats) -> tuple[float, float, float]:
    return float(values[0]), float(values[1]), float(values[2])


def _thinned(points: Floats, most: int) -> Floats:
    every = max(int(np.ceil(len(points) / most)), 1)
    return np.ascontiguousarray(points[::every], dtype=np.float64)


def _passed(points: Floats, chosen: LocaliseParameters) -> Floats:
    """(n, 2) where beams went through: the vehicle itself, and places on the way of long ones."""
    long = points[(points**2).sum(axis=1) > chosen.free_m**2]
    return np.concatenate([np.zeros((1, 2)), *(long * share for share in chosen.free_at)])


def _must_fit(
    sure: NDArray[np.bool_],
    share: Floats,
    known: Floats,
    through: Floats,
    spread: Floats,
    chosen: LocaliseParameters,
) -> None:
    remedy = _REMEDY
    what = _WHAT
    if not sure.any():
        evidence = f"the particles stay {spread.min():.1f} m apart at best"
        raise NotFoundError(what, evidence, remedy)
    if sure.mean() < chosen.fewest_of_all:
        evidence = f"they agree in {100 * sure.mean():.0f} % of the scans only"
        raise NotFoundError(what, evidence, remedy)
    after = int(np.argmax(sure))
    seen = sure[after:] & (known[after:] > 0.3)
    if sure[after:].mean() < chosen.fewest_sure or not seen.any():
        evidence = f"they agree in {100 * sure[after:].mean():.0f} % of the scans only"
        raise NotFoundError(what, evidence, remedy)
    fit = float(share[after:][seen].mean())
    if fit < chosen.least_share:
        evidence = (
            f"{100 * fit:.0f} % of the scans' points lie on its edges where they fit best, less"
            f" than {100 * chosen.least_share:.0f} %"
        )
        raise NotFoundError(what, evidence, remedy)
    crossed = float(through[after:][seen].mean())
    if crossed > chosen.most_through:
        evidence = f"{100 * crossed:.0f} % of the beams would go through what stands there"
        raise NotFoundError(what, evidence, remedy)


def _must_be_here(margin: Margin, sharp: float, chosen: LocaliseParameters) -> None:
    """A model of another place has edges, too, and particles settle where these fit best."""
    if sharp < chosen.least_sharp:
        evidence = (
            f"{100 * sharp:.0f} % of the points near its edges lie on them, less than"
            f" {100 * chosen.least_sharp:.0f} % (33 % do by chance)"
        )
        raise NotFoundError(_WHAT, evidence, f"{_REMEDY} {_SURE}")
    if margin.share < chosen.least_margin:
        metres = float(np.hypot(*margin.away))
        evidence = (
            f"the path fits it as well {metres:.0f} m away, or beams go through what stands there"
        )
        raise NotFoundError(_WHAT, evidence, f"{_REMEDY} {_SURE}")
    if margin.share < chosen.unique and sharp < chosen.sharp_alike:
        metres = float(np.hypot(*margin.away))
        evidence = (
            f"the path fits it nearly as well {metres:.0f} m away, and {100 * sharp:.0f} % of the"
            f" points near its edges lie on them, less than {100 * chosen.sharp_alike:.0f} %: it"
            " may be a street that is as wide"
        )
        raise NotFoundError(_WHAT, evidence, f"{_REMEDY} {_SURE}")


def _placed(chain: Floats, poses: Floats, sure: NDArray[np.bool_]) -> Floats:
    """The chain as one rigid line, where the sure poses (k, 3) lie best."""
    rows = np.flatnonzero(sure)
    here, there = chain[rows, :2], poses[rows, :2]
    turn = float(np.angle(np.exp(1j * (poses[rows, 2] - chain[rows, 2])).mean()))
    if len(rows) > 5 and np.ptp(here, axis=0).max() > 5.0:
        one = (here - here.mean(axis=0)) @ np.array([1.0, 1j])
        two = (there - there.mean(axis=0)) @ np.array([1.0, 1j])
        turn = float(np.angle((np.conj(one) * two).sum()))
    cosine, sine = np.cos(turn), np.sin(turn)
    spun = chain[:, :2] @ np.array([[cosine, sine], [-sine, cosine]])
    move = (there - spun[rows]).mean(axis=0)
    return np.column_stack([spun + move, chain[:, 2] + turn])
