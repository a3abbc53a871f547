"""Drawing a colour from a range of paints."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from veduta.synthetic.textures import Colour


def pick(rng: np.random.Generator, colours: Sequence[Colour], amount: float = 0.03) -> Colour:
    """One of the colours, its lightness and hue varied by about `amount`."""
    colour = np.asarray(colours[int(rng.integers(len(colours)))])
    value = np.clip(colour * (1.0 + amount * rng.standard_normal()), 0.0, 1.0)
    value = np.clip(value + 0.4 * amount * rng.standard_normal(3), 0.02, 0.98)
    return float(value[0]), float(value[1]), float(value[2])
