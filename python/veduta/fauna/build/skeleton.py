"""The skeleton of an animal without limbs: a root on the ground, and a spine behind it.

Part frame: the animal at rest lies along x, its head at +x, the middle of its body over the origin,
the ground at z = 0. Each joint of the spine stands at the front end of its segment, its x axis
towards the head.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.fauna.build.going import ROOT
from veduta.fauna.document.schema import Animal
from veduta.fauna.motion.angles import Floats
from veduta.place.skin import Skin

SEGMENTS = 24


@dataclass(frozen=True, eq=False)
class Spine:
    """places: (j,) along the body, 0..1, of the joints. rest_m: (j, 3) where they stand at rest."""

    places: Floats
    rest_m: Floats

    @property
    def segment_m(self) -> float:
        """Length of a segment along the axis."""
        return float(self.rest_m[0, 0] - self.rest_m[1, 0])


def axis_height_m(animal: Animal, at: Floats) -> Floats:
    """How high the axis lies over the ground: a fish's is straight, others lie on their belly."""
    length = animal.length.metres
    places = np.array([piece.at for piece in animal.body.slices])
    heights = np.array([piece.half_height for piece in animal.body.slices])
    if animal.kind == "fish":
        return np.full(len(at), float(heights.max()) * length)
    return np.asarray(np.interp(at, places, heights) * length, dtype=np.float64)


def spine_of(animal: Animal) -> Spine:
    """The joints of the spine at rest."""
    length = animal.length.metres
    places = np.arange(SEGMENTS) / SEGMENTS
    along = (0.5 - places) * length
    heights = axis_height_m(animal, places)
    return Spine(places, np.stack([along, np.zeros(SEGMENTS), heights], axis=1))


def skin_of(spine: Spine, at: Floats) -> Skin:
    """The skin of vertices at places (v,) along the body: each follows the two segments around it.

    In the middle of a segment a vertex follows it alone, at a joint half of either.
    """
    count = len(spine.places)
    rest = np.tile(np.eye(4), (count + 1, 1, 1))
    rest[1:, :3, 3] = spine.rest_m
    where = np.clip(at * count - 0.5, 0.0, count - 1.0)
    before = np.minimum(where.astype(np.int64), count - 2)
    share = where - before
    joints = np.zeros((len(at), 4), dtype=np.uint16)
    joints[:, 0], joints[:, 1] = before + 1, before + 2
    weights = np.zeros((len(at), 4), dtype=np.float32)
    weights[:, 0], weights[:, 1] = 1.0 - share, share
    names = (ROOT, *(f"spine_{number:02d}" for number in range(count)))
    parent: NDArray[np.int32] = np.arange(-1, count, dtype=np.int32)
    return Skin(names, parent, rest, joints, weights)


def spine_angles(angles: Floats) -> Floats:
    """(t, j) the angle of each segment from angles (t, n) along the axis."""
    count = angles.shape[1]
    middles = (np.arange(SEGMENTS) + 0.5) / SEGMENTS
    samples = (np.arange(count) + 0.5) / count
    place = np.clip(np.searchsorted(samples, middles) - 1, 0, count - 2)
    share = (middles - samples[place]) / (samples[place + 1] - samples[place])
    return np.asarray(angles[:, place] * (1.0 - share) + angles[:, place + 1] * share)
