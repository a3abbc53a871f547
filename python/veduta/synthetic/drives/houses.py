"""Houses for a street of a drive: by the facade generator, or by whoever gives a maker of them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from veduta.place.part import Part
from veduta.synthetic.build import build
from veduta.synthetic.layout import STYLES
from veduta.synthetic.part import mirrors, to_part
from veduta.synthetic.seeds import stream
from veduta.synthetic.styles import design


@dataclass(frozen=True, eq=False)
class MadeHouse:
    """part: x along its front from the left, y into the house, z up (m), width_m wide.

    depth_m: from its front to its back. mirrors: by material, how much of each texel is glass.
    """

    part: Part
    width_m: float
    depth_m: float
    mirrors: Mapping[str, NDArray[np.uint8]] = field(default_factory=dict)


HouseMaker = Callable[[int], MadeHouse]
"""From a seed. The grammar lies above this package, so that its user brings the maker of it."""


def generated_house(seed: int) -> MadeHouse:
    """A house of the facade generator, of any of its styles."""
    random = stream(seed, "house of a drive")
    style = STYLES[int(random.integers(len(STYLES)))]
    layout = design(style, seed, int(random.integers(2, 6)), int(random.integers(3, 6)))
    built = build(layout, seed, street=False)
    name = f"house-{seed}"
    return MadeHouse(to_part(built, name), layout.width_m, layout.depth_m, mirrors(built, name))
