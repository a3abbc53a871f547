"""The styles: from a seed to a layout. One file per style; sizes are those of real streets."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from veduta.synthetic.layout import Layout, Style
from veduta.synthetic.seeds import stream
from veduta.synthetic.styles.haussmann import haussmann
from veduta.synthetic.styles.modern import modern
from veduta.synthetic.styles.stucco import stucco
from veduta.synthetic.styles.terrace import terrace

Designer = Callable[[np.random.Generator, int | None, int | None], Layout]

DESIGNERS: dict[Style, Designer] = {
    "haussmann": haussmann,
    "terrace": terrace,
    "modern": modern,
    "stucco": stucco,
}


def design(
    style: Style, seed: int, floors: int | None = None, columns: int | None = None
) -> Layout:
    """The layout of one facade; `floors` (with the ground floor) and `columns` may be fixed."""
    return DESIGNERS[style](stream(seed, f"layout {style}"), floors, columns)
