"""Windows in the roof: dormers and skylights between the ridge and the eaves."""

from __future__ import annotations

import numpy as np

from veduta.facade.appearance import class_scores, wall_colour
from veduta.facade.columns import split_columns
from veduta.facade.evidence import Evidence
from veduta.facade.extent import Skyline
from veduta.facade.floors import Floors
from veduta.facade.opening_rows import window_rows
from veduta.facade.openings import Box

# In storeys: the least roof that can hold a window, and the heights of a window in it.
_ROOF = 0.4
_WINDOW = (0.2, 0.75)
# Mean log-odds that a roof window must reach.
_SURE = 0.1


def find_roof_windows(evidence: Evidence, skyline: Skyline, floors: Floors) -> list[Box]:
    """The stripes and rows of windows in the roof, by the terms that find those of the floors.

    What the surface is there (slate, zinc) is taken from the roof itself. Each window must stand
    out on its own: dormers need not stand over the windows below, nor over all of them.
    """
    top, bottom = skyline.level, floors.eaves
    storey = floors.mean_storey
    if bottom - top < _ROOF * storey:
        return []
    surface = wall_colour(evidence, top, bottom, storey)
    scores = class_scores(evidence, surface, top, bottom, storey)
    stripes = split_columns(evidence, top, bottom, storey, scores).stripes
    if not stripes:
        return []
    inside = np.zeros(evidence.width, bool)
    for x, w in stripes:
        inside[x : x + w] = True
    edges = np.minimum(np.abs(evidence.gy[top:bottom]), 25)
    t, b = window_rows(scores.window, edges, inside, storey, _WINDOW)
    boxes = []
    for k, (x, w) in enumerate(stripes):
        sure = float(scores.window[t:b, x : x + w].mean()) if b > t else 0.0
        if sure > _SURE and (skyline.rows[x : x + w] < top + t).all():
            boxes.append(Box("window", x, top + t, w, b - t, None, k, min(1.0, 0.5 + sure / 2)))
    return boxes
