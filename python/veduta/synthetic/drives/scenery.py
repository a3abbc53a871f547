"""What a truck drives by, for those who scan it: where rays end, and where the facade is."""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from veduta.synthetic.drives.way import Way

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]


class Scenery(Protocol):
    """A street with all that stands in it. Rays are (n, 3) origins and unit directions."""

    @property
    def length_m(self) -> float:
        """Of the drive along it."""
        ...

    @property
    def way(self) -> Way:
        """Along which the truck goes."""
        ...

    def between(self, low: float, high: float) -> Scenery:
        """What of it stands about from one place along the way to another (m), and perhaps more."""
        ...

    def meet(
        self, origins: Floats, directions: Floats, passes: Bools
    ) -> tuple[Floats, NDArray[np.uint8]]:
        """(n,) how far off what answers is, inf where nothing does, and its `Kind`.

        passes: (n,) whether a ray goes through the glass that it meets; else it is lost there.
        """
        ...

    def facade(self, origins: Floats, directions: Floats) -> tuple[Floats, Bools]:
        """(n,) how far off walls or ground are, glass shut and nothing before them; (n,) whether
        it is a wall.
        """
        ...
