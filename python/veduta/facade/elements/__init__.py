"""Single elements of a front (6.4): the thesis's own detectors, and what the learned eyes see."""

from veduta.facade.elements.balconies import BalconyParameters, find_balconies
from veduta.facade.elements.boosted import find_boosted
from veduta.facade.elements.cornices import (
    BandParameters,
    CorniceParameters,
    find_cornices,
    seen_bands,
)
from veduta.facade.elements.windows import WindowParameters, WindowsFound, find_windows

__all__ = [
    "BalconyParameters",
    "BandParameters",
    "CorniceParameters",
    "WindowParameters",
    "WindowsFound",
    "find_balconies",
    "find_boosted",
    "find_cornices",
    "find_windows",
    "seen_bands",
]
