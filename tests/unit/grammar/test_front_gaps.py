"""From the pavement nobody sees through a front: no gap beside a shop leads into the house."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from test_styles import LOTS, derive

from veduta.grammar.rules import style_names
from veduta.place.flatten import flattened
from veduta.place.part import Part

Points = NDArray[np.float64]

WIDTH_M = 14.0
"""Of the front, along x at y = 0; the street is to the south of it."""
EYES_M = (0.5, 3.0, 5.5, 8.5, 11.0, 13.5)
"""Along the front, on the pavement."""
AWAY_M = 3.0
ACROSS_M = 0.02
"""Between two rays where they meet the front: gaps that one sees are wider."""
HEIGHTS_M = (0.3, 0.9, 1.65, 2.1, 2.7)
"""A gap beside a front is upright, so level rays find it."""
EPSILON = 1e-9
Cut = tuple[Points, Points, Points]


def triangles_of(part: Part) -> Points:
    """(n, 3, 3) corners of all that is seen, what is repeated too; from outside leftwards."""
    whole = flattened(part)
    return whole.positions_m[whole.triangles.indices].astype(np.float64)


def cut_at(triangles: Points, z: float) -> Cut:
    """Where a level plane cuts the triangles: (n, 2) starts and ends, and (n, 2) their normals."""
    above = triangles[:, :, 2] > z
    crossed = triangles[above.any(axis=1) & ~above.all(axis=1)]
    ends = []
    for corner, other in ((0, 1), (1, 2), (2, 0)):
        first, last = crossed[:, corner], crossed[:, other]
        cuts = (first[:, 2] > z) != (last[:, 2] > z)
        rise = np.where(cuts, last[:, 2] - first[:, 2], 1.0)
        share = ((z - first[:, 2]) / rise)[:, None]
        point = first[:, :2] + share * (last - first)[:, :2]
        ends.append(np.where(cuts[:, None], point, np.nan))
    sides = np.stack(ends, axis=1)
    order = np.argsort(np.isnan(sides[:, :, 0]), axis=1, kind="stable")
    sides = np.take_along_axis(sides, order[:, :, None], axis=1)
    normals = np.cross(crossed[:, 1] - crossed[:, 0], crossed[:, 2] - crossed[:, 0])[:, :2]
    return sides[:, 0], sides[:, 1], normals


def looked_through(triangles: Points, z: float) -> Points:
    """(k,) where along the front a level ray goes to the sky, or to a face from within (m)."""
    starts, ends, normals = cut_at(triangles, z)
    front = np.arange(0.15, WIDTH_M - 0.15, ACROSS_M)
    found = []
    for eye_m in EYES_M:
        eye = np.array([eye_m, -AWAY_M])
        ways = np.stack([front - eye_m, np.full(len(front), AWAY_M)], axis=1)
        side = ends - starts
        det = ways[:, None, 0] * side[None, :, 1] - ways[:, None, 1] * side[None, :, 0]
        safe = np.where(np.abs(det) > EPSILON, det, np.inf)
        to = starts - eye
        t = (to[None, :, 0] * side[None, :, 1] - to[None, :, 1] * side[None, :, 0]) / safe
        u = (to[None, :, 0] * ways[:, None, 1] - to[None, :, 1] * ways[:, None, 0]) / safe
        t = np.where(
            (t > EPSILON) & (u >= -EPSILON) & (u <= 1 + EPSILON) & np.isfinite(safe), t, np.inf
        )
        nearest = t.argmin(axis=1)
        away = t[np.arange(len(front)), nearest]
        within = (
            np.isfinite(away) & (away > 1.0) & ((normals[nearest] * ways).sum(axis=1) > EPSILON)
        )
        found.append(front[~np.isfinite(away) | within])
    return np.unique(np.concatenate(found).round(2))


@pytest.mark.parametrize("style", style_names())
@pytest.mark.parametrize("level", [2, 3])
def test_no_gap_leads_into_the_house(style: str, level: int) -> None:
    (part,) = derive(style, [LOTS["rectangle"]], LOD=level)
    triangles = triangles_of(part)
    through = {z: looked_through(triangles, z).tolist() for z in HEIGHTS_M}
    assert not any(through.values()), {z: places[:6] for z, places in through.items() if places}


def test_a_slit_is_found() -> None:
    def wall(start: float, end: float) -> Points:
        corners = np.array([[start, 0, 0], [end, 0, 0], [end, 0, 9], [start, 0, 9]], dtype=float)
        return corners[np.array([[0, 1, 2], [0, 2, 3]])]

    back = wall(-9.0, 23.0)[:, ::-1] + np.array([0.0, 12.0, 0.0])
    slit = np.concatenate([wall(-9.0, 6.0), wall(6.1, 23.0), back])
    for house in (slit, slit[:-2]):
        seen = looked_through(house, 1.65)
        assert len(seen) >= 4
        assert seen.min() > 5.99
        assert seen.max() < 6.11
    assert (
        len(
            looked_through(np.concatenate([slit, wall(5.0, 7.0) + np.array([0.0, 0.3, 0.0])]), 1.65)
        )
        == 0
    )
