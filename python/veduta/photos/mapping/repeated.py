"""What of a pair of photos matches is there once, and what is there more than once.

What matches between photos of different places is there at least twice, and so is what matches
that. (No further: over many links false matches join everything.) A pair that has little else may
show any of these places; one that has much else shows one place. (Wilson and Snavely, Network
principles for SfM: disambiguating repeated structures with local context, ICCV 2013, drop the
tracks that join different places.)
"""

from __future__ import annotations

from collections.abc import Mapping, Set
from dataclasses import dataclass

import numpy as np

from veduta.photos.mapping.votes import Matched, Pair

FEWEST = 50
"""Features there once in which a pair must agree to show one place,"""
MOSTLY = 0.4
"""and their share of all in which it agrees. Rendered towers with four equal sides: true pairs 0.33
and, but for one, 0.44 and more of 32 to 170; false ones at most 0.27 of at most 49."""
LITTLE = 0.3
"""Share below which a pair may show any of several places."""


@dataclass(frozen=True)
class Once:
    """In how many features a pair agrees that are there once, and their share of all."""

    count: int
    share: float

    @property
    def shows_one_place(self) -> bool:
        """Whether it needs nothing that repeats."""
        return self.count >= FEWEST and self.share >= MOSTLY

    @property
    def is_ambiguous(self) -> bool:
        """Whether it shows hardly anything that does not repeat."""
        return self.share < LITTLE


def there_once(matched: Matched, apart: Set[Pair]) -> Mapping[Pair, Once]:
    """Of each pair. apart: pairs that match, but show different places."""
    repeats = {image: np.zeros(len(px), dtype=bool) for image, px in matched.keypoints_px.items()}
    for pair in apart & matched.matches.keys():
        for side, image in enumerate(pair):
            repeats[image][matched.matches[pair][:, side]] = True
    reached = {image: own.copy() for image, own in repeats.items()}
    for (first, second), matches in matched.matches.items():
        here, there = matches.T
        reached[first][here[repeats[second][there]]] = True
        reached[second][there[repeats[first][here]]] = True
    found = {}
    for (first, second), matches in matched.matches.items():
        here, there = matches.T
        once = int((~reached[first][here] & ~reached[second][there]).sum())
        found[first, second] = Once(once, once / max(1, len(matches)))
    return found
