"""The ground floor of a house without shops: windows under those of the floors above.

The chain over the ground floor (`ground`) knows the wall by the colour that it has above, so a
ground floor of another stone or paint reads as one shop front. Here its surface is taken from
itself, and windows are looked for under those of the floors. Shop windows stand under them as well;
but those reach down to the street, and what is between them is hardly wider than a frame. So most
stripes must show a window that stands out from what is beside it and from what is below its sill.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from veduta.facade.appearance import class_scores, wall_colour
from veduta.facade.boxes import Box, score
from veduta.facade.columns import Columns
from veduta.facade.evidence import Evidence
from veduta.facade.floors import Floors
from veduta.facade.window_band import Candidate, band_of_windows

# In storeys: the least ground floor, heights of windows in it, the least height of a sill over the
# street, and the part below the sill that is looked at.
_GROUND = 0.5
_WINDOW = (0.25, 0.75)
_SILL = 0.2
_BELOW = 0.3
# In storeys: the least height of a shop under windows.
_SHOP = 0.8
# The least share of the stripes, and number of them, that show a window.
_SHARE, _LEAST = 0.6, 4
# Mean log-odds of a window, and by how much they are above those beside it; and the medians over
# all stripes of these and of how much they are above those below the sill.
_SURE, _STANDS_OUT = -0.2, 0.6
_ALL_SURE, _ALL_STAND_OUT, _ALL_END = 0.3, 1.0, 0.4


def find_ground_windows(evidence: Evidence, floors: Floors, columns: Columns) -> list[Box]:
    """Windows of the ground floor under those above; none where it has not a row of them."""
    top, bottom, storey = floors.ground_top, evidence.height, floors.mean_storey
    if bottom - top < _GROUND * storey:
        return []
    surface = wall_colour(evidence, top, bottom, storey)
    scores = class_scores(evidence, surface, top, bottom, storey)
    band = band_of_windows(evidence, columns.stripes, scores, (top, bottom), storey, _WINDOW)
    shown = [c for c in band if c.sure > _SURE and c.stands_out > _STANDS_OUT]
    if len(shown) < max(_LEAST, _SHARE * len(band)) or bottom - top - band[0].b < _SILL * storey:
        return []
    below = scores.window[band[0].b :][: round(_BELOW * storey)].mean(0)
    medians = np.median([(c.sure, c.stands_out, c.sure - _mean(below, c)) for c in band], axis=0)
    if (medians < (_ALL_SURE, _ALL_STAND_OUT, _ALL_END)).any():
        return []
    return [Box("window", c.x, top + c.t, c.w, c.b - c.t, 0, None, score(c.sure)) for c in shown]


def with_windows(ground: list[Box], windows: list[Box], storey: float) -> list[Box]:
    """The boxes of the ground floor with `windows` for the shops and windows that they are in.

    A door stays, and a window that it overlaps is left out. A shop stays below the sills of windows
    where it has room there: under a mezzanine.
    """
    doors = [box for box in ground if box.kind == "door"]
    kept = [window for window in windows if not any(_beside(window, door) for door in doors)]
    others = []
    for box in ground:
        over = [window for window in kept if _beside(box, window)]
        if box.kind == "door" or not over:
            others.append(box)
        elif box.kind == "shop":
            top = max(window.y + window.height for window in over)
            height = box.y + box.height - top
            if height >= _SHOP * storey:
                others.append(replace(box, y=top, height=height))
    return sorted([*others, *kept], key=lambda box: box.x)


def _mean(line: np.ndarray, c: Candidate) -> float:
    return float(line[c.x : c.x + c.w].mean())


def _beside(a: Box, b: Box) -> bool:
    """Whether two boxes share pixel columns."""
    return a.x < b.x + b.width and b.x < a.x + a.width
