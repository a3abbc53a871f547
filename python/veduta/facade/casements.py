"""Windows with their shutters and blinds: how far what the learned eyes call blind goes on."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.facade.eyes import Seen, SeenElement

Float = NDArray[np.float64]


@dataclass(frozen=True)
class CasementParameters:
    """chance: of a blind, the least mean over a window's height of a column that is a shutter.

    reach: how far beside a window a shutter may go, of the window's width: each leaf covers half
    of it. gap: how much of its width may lie between, as hinges do. closed: share of a window's
    area under blinds from which it counts as closed.
    """

    chance: float = 0.3
    reach: float = 0.65
    gap: float = 0.12
    closed: float = 0.5


@dataclass(frozen=True)
class Casement:
    """A window with what closes it.

    box: left, top, right, bottom in pixels, with open shutters. left, right: whether there is one
    on that side. blind: share of the window itself that is under a blind or closed shutters.
    """

    window: SeenElement
    box: tuple[float, float, float, float]
    left: bool
    right: bool
    blind: float
    is_closed: bool


def casements(
    seen: Seen, windows: Sequence[SeenElement], parameters: CasementParameters | None = None
) -> list[Casement]:
    """The windows of a picture that was looked at, each with its shutters and blinds."""
    own = parameters or CasementParameters()
    chance = seen.chance("blind").astype(np.float64)
    height, width = chance.shape
    across, down = width / seen.width_px, height / seen.height_px
    return [_casement(one, chance, (across, down), own) for one in windows]


def _casement(
    window: SeenElement, chance: Float, scale: tuple[float, float], own: CasementParameters
) -> Casement:
    height, width = chance.shape
    x0, x1 = (int(np.clip(round(x * scale[0]), 0, width)) for x in (window.x0, window.x1))
    y0, y1 = (int(np.clip(round(y * scale[1]), 0, height)) for y in (window.y0, window.y1))
    if x1 <= x0 or y1 <= y0:
        box = (window.x0, window.y0, window.x1, window.y1)
        return Casement(window, box, False, False, 0.0, False)
    columns = chance[y0:y1].mean(axis=0) >= own.chance
    reach, gap = round(own.reach * (x1 - x0)), round(own.gap * (x1 - x0))
    left = _goes_on(columns[max(0, x0 - reach) : x0][::-1], gap)
    right = _goes_on(columns[x1 : x1 + reach], gap)
    blind = float((chance[y0:y1, x0:x1] >= own.chance).mean())
    box = (window.x0 - left / scale[0], window.y0, window.x1 + right / scale[0], window.y1)
    return Casement(window, box, left > 0, right > 0, blind, blind >= own.closed)


def _goes_on(columns: NDArray[np.bool_], gap: int) -> int:
    """How many columns from the window on are a shutter, with no longer gap between."""
    places = np.flatnonzero(columns)
    if not len(places):
        return 0
    breaks = np.flatnonzero(np.diff(np.concatenate([[-1], places])) > gap + 1)
    last = len(places) if not len(breaks) else int(breaks[0])
    return 0 if last == 0 else int(places[last - 1]) + 1
