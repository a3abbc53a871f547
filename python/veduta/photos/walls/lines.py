"""Lines in the view from above that many points lie on: RANSAC with local draws, and fits.

A hypothesis is drawn from two points of one neighbourhood, so that a small wall in a large scene
has as good a chance as a long one, and counts the points within its reach.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from veduta.photos.walls.plan_view import TOLERANCE, TURNED, PlanView

DRAWS = 1000
PARTNERS = 100
"""Nearest points (that face somewhere) among which the second of a draw is looked for."""
COUNTED = 6000
"""Points that hypotheses are scored on; of more, as many are drawn."""
_CHUNK = 200
FIT_ROUNDS = 4
_TUKEY = 4.685
"""Of Tukey's weights: 95 % efficiency where errors are normal."""


@dataclass(frozen=True)
class Line:
    """normal . p = offset, the normal unit and towards the photos. seed: (2,) a point on it."""

    normal: NDArray[np.float64]
    offset: float
    seed: NDArray[np.float64]

    @property
    def along(self) -> NDArray[np.float64]:
        """(2,) unit, to the right of one who looks at it from outside."""
        x, y = self.normal
        return np.array([-y, x])


def best_line(view: PlanView, rng: np.random.Generator) -> Line | None:
    """The line with most support near the points that it was drawn from; None without a draw."""
    facing = np.flatnonzero(view.facing.any(axis=1))
    if len(facing) < 3:
        return None
    firsts, normals, offsets = _draw(view, facing, rng)
    if not len(firsts):
        return None
    counted = facing
    if len(counted) > COUNTED:
        counted = np.sort(rng.choice(facing, COUNTED, replace=False))
    scores = np.concatenate(
        [
            _scores(view.only(counted), view.xy[firsts[at]], normals[at], offsets[at])
            for at in np.split(np.arange(len(firsts)), range(_CHUNK, len(firsts), _CHUNK))
        ]
    )
    best = int(scores.argmax())
    return Line(normals[best], float(offsets[best]), view.xy[firsts[best]])


def _draw(
    view: PlanView, facing: NDArray[np.int64], rng: np.random.Generator
) -> tuple[NDArray[np.int64], NDArray[np.float64], NDArray[np.float64]]:
    """First point, normal and offset of lines through pairs whose neighbourhoods agree."""
    count = min(PARTNERS + 1, len(facing))
    firsts = rng.choice(len(facing), DRAWS)
    tree = cKDTree(view.xy[facing])
    near = np.asarray(tree.query(view.xy[facing[firsts]], k=count)[1])
    seconds = near[np.arange(DRAWS), rng.integers(1, count, DRAWS)]
    one, two = facing[firsts], facing[seconds]
    way = view.xy[two] - view.xy[one]
    length = np.linalg.norm(way, axis=1)
    far = length > 2.0 * view.roughness
    one, two, way = one[far], two[far], way[far] / length[far, None]
    normals = np.column_stack([way[:, 1], -way[:, 0]])
    back = np.einsum("hi,hi->h", normals, view.facing[one]) < 0.0
    normals = np.where(back[:, None], -normals, normals)
    alike = (np.einsum("hi,hi->h", normals, view.facing[one]) >= TURNED) & (
        np.einsum("hi,hi->h", normals, view.facing[two]) >= TURNED
    )
    one, two, normals = one[alike], two[alike], normals[alike]
    offsets = np.einsum("hi,hi->h", normals, 0.5 * (view.xy[one] + view.xy[two]))
    return one, normals, offsets


def _scores(
    view: PlanView,
    seeds: NDArray[np.float64],
    normals: NDArray[np.float64],
    offsets: NDArray[np.float64],
) -> NDArray[np.float64]:
    """(h,) summed 1 - (distance / tolerance)^2 of the points on each line, within its reach."""
    # Single precision, about the middle of the points: scores only choose among lines.
    middle = view.xy.mean(axis=0)
    places = (view.xy - middle).T.astype(np.float32)
    across = normals.astype(np.float32)
    off = across @ places - (offsets - normals @ middle).astype(np.float32)[:, None]
    x, y = across.T
    terms = view.covariance[:, [0, 0, 1], [0, 1, 1]].T.astype(np.float32)
    tolerance = np.column_stack([x * x, 2.0 * x * y, y * y]) @ terms
    tolerance = TOLERANCE**2 * (tolerance + np.float32(view.roughness**2))
    worth = np.maximum(0.0, 1.0 - off * off / tolerance)
    sides = np.column_stack([-y, x])
    shifts = np.einsum("hi,hi->h", sides, (seeds - middle).astype(np.float32))
    aligned = across @ view.facing.T.astype(np.float32) >= TURNED
    aligned &= np.abs(sides @ places - shifts[:, None]) <= view.reach
    found: NDArray[np.float64] = np.einsum("hn,hn->h", worth, aligned, dtype=np.float64)
    return found


def fitted(view: PlanView, line: Line) -> Line:
    """Orthogonal least squares through all points of the view, with weights that forgive strays."""
    for _ in range(FIT_ROUNDS):
        sigma = view.sigma(line.normal)
        off = (view.xy @ line.normal - line.offset) / sigma
        scale = max(1.0, 1.4826 * float(np.median(np.abs(off))))
        tail = np.clip(1.0 - (off / (_TUKEY * scale)) ** 2, 0.0, None)
        weight = tail**2 / sigma**2
        total = float(weight.sum())
        if total <= 0.0:
            return line
        middle = weight @ view.xy / total
        around = view.xy - middle
        normal = np.linalg.eigh((around * weight[:, None]).T @ around)[1][:, 0]
        if float(normal @ line.normal) < 0.0:
            normal = -normal
        line = Line(normal, float(normal @ middle), middle)
    return line
