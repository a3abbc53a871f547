"""Fronts of lots where no road says them: an edge before which no other lot stands."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from veduta.grammar.frames import Frame
from veduta.grammar.outline import Outline
from veduta.grammar.rings import RingFault, clean_rings

MOST = 50_000
"""Lots of a file that are looked at; those of a larger one keep their first edges."""
SHARES = np.array([0.25, 0.5, 0.75])
"""Places along an edge from which is looked."""


@dataclass(frozen=True)
class FreeParameters:
    """When another edge than the first is the front.

    blocked_m: with less before it, on average of its places, an edge stands against other lots and
    is no front. reach_m: what is farther is not looked at. off_m: where the look begins, off the
    edge. length_share: of the longest edge; shorter ones are no fronts. length_gain: so much more
    free (m) an edge counts for each metre of its own, up to `length_most_m`. south_gain: so much
    more counts one that looks south: in a row that is free on both sides all have their fronts on
    one. Those about lengths are those of `roads`; the others were tried on a block of Paris by eye.
    """

    blocked_m: float = 4.0
    reach_m: float = 30.0
    off_m: float = 0.02
    length_share: float = 0.3
    length_gain: float = 0.1
    length_most_m: float = 25.0
    south_gain: float = 0.3


class FreeFronts:
    """The outlines of a town, to ask which edge of a lot looks at none of them."""

    def __init__(
        self,
        outlines: Iterable[Sequence[NDArray[np.float64]]],
        parameters: FreeParameters | None = None,
    ) -> None:
        """outlines: rings (n, 2) of all lots in one frame; what is no polygon is left out."""
        self._parameters = parameters or FreeParameters()
        self._polygons = np.array([one for one in map(_polygon, outlines) if one], dtype=object)
        self._tree = shapely.STRtree(self._polygons)
        self.count = 0

    def edge_of(self, ring_m: NDArray[np.float64]) -> int:
        """The front of an outline, (n, 2) counter-clockwise in metres; `count` has the changed.

        It is the first edge, but where that stands against other lots and another one does not.
        """
        parameters = self._parameters
        if self._ahead_m(ring_m, np.array([0]))[0] >= parameters.blocked_m:
            return 0
        ahead_m = self._ahead_m(ring_m, np.arange(len(ring_m)))
        along = np.roll(ring_m, -1, axis=0) - ring_m
        length = np.linalg.norm(along, axis=1)
        is_front = ahead_m >= parameters.blocked_m
        is_front &= length >= parameters.length_share * length.max()
        if not is_front.any():
            return 0
        gain = parameters.length_gain * np.minimum(length, parameters.length_most_m)
        gain += parameters.south_gain * along[:, 0] / np.maximum(length, 1e-9)
        self.count += 1
        return int(np.argmax(np.where(is_front, ahead_m + gain, -np.inf)))

    def notes(self) -> tuple[str, ...]:
        """How many lots begin elsewhere than in their file."""
        if not self.count:
            return ()
        one = self.count == 1
        begin = "1 lot begins" if one else f"{self.count:,} lots begin"
        their = "its" if one else "their"
        told = f"no roads are known: {begin} at another edge than in {their} file, for a neighbour"
        return (f"{told} stands at {their} first",)

    def _ahead_m(
        self, ring_m: NDArray[np.float64], edges: NDArray[np.int64]
    ) -> NDArray[np.float64]:
        """How far it is from edges, straight ahead, to what stands there; at most the reach."""
        start = ring_m[edges]
        along = np.roll(ring_m, -1, axis=0)[edges] - start
        length = np.maximum(np.linalg.norm(along, axis=1), 1e-9)
        outward = np.column_stack([along[:, 1], -along[:, 0]]) / length[:, None]
        places = start[:, None] + SHARES[None, :, None] * along[:, None]
        places = (places + self._parameters.off_m * outward[:, None]).reshape(-1, 2)
        reach_m = self._parameters.reach_m
        ends = places + reach_m * np.repeat(outward, len(SHARES), axis=0)
        looks = np.asarray(shapely.linestrings(np.stack([places, ends], axis=1)))
        rows, others = self._tree.query(looks, predicate="intersects")
        met = shapely.intersection(looks[rows], self._polygons[others])
        ahead_m = np.full(len(looks), reach_m)
        np.minimum.at(ahead_m, rows, shapely.distance(shapely.points(places[rows]), met))
        mean: NDArray[np.float64] = ahead_m.reshape(-1, len(SHARES)).mean(axis=1)
        return mean


def free_fronts(outlines: Iterable[Outline], frame: Frame) -> FreeFronts:
    """Of outlines as their file has them; what cannot be placed is left out."""
    return FreeFronts(_placed(one, frame) for one in outlines)


def _placed(outline: Outline, frame: Frame) -> list[NDArray[np.float64]]:
    try:
        return [frame.local(ring)[:, :2] for ring in outline.rings]
    except RingFault:
        return []


def _polygon(rings: Sequence[NDArray[np.float64]]) -> shapely.Polygon | None:
    if not rings:
        return None
    low = np.floor(rings[0].min(axis=0))
    try:
        shell, *holes = clean_rings([ring - low for ring in rings])
    except RingFault:
        return None
    return shapely.Polygon(shell + low, [hole + low for hole in holes])
