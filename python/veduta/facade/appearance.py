"""How much each pixel of the floors looks like a window or a railing rather than like wall.

Nothing is learned: windows are unlike the wall's colour, striped vertically (frames, jambs,
curtains) and full of upright edges; their panes mirror the sky or show the dark, and both are less
yellow than a wall. Railings are textured in both directions, wall is neither. Each cue is taken
relative to its median or to the wall over the same facade, so that light, resolution and contrast
drop out.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.facade.evidence import Evidence, Float, blur

# Cues in the order: texture across x, texture across y, unlikeness to wall, bluer than wall,
# upright edges around; then the level at which a pixel is as likely wall.
_WINDOW = ((0.33, -0.33, 1.5, 0.3, 0.4), 0.95)
_RAILING = ((1.0, 0.5, 0.25, 0.0, 0.0), 0.35)
# Weight of level edges where stripes are looked for.
_LEVEL = 0.3
LIMIT = 1.5
_SPREAD_X = 0.02
_SPREAD_Y = 0.028
# In storeys: the neighbourhood whose upright edges count for a pixel; steps of Lab's b that count
# as much as a factor e in the other cues.
_AROUND_X, _AROUND_Y = 0.06, 0.1
_BLUER = 6.0


@dataclass(frozen=True)
class Wall:
    """How far each pixel of the floors is from the wall's colour around it.

    `unlike` (n, w) is a colour distance, `colour` (n, w, 3) Lab; rows from the eaves down.
    """

    unlike: Float
    colour: Float


@dataclass(frozen=True)
class Scores:
    """Log-odds against wall, clipped, (n, w) each; rows from the eaves to the ground floor.

    `level` is what level edges around a pixel add to `window` where stripes are looked for: heads,
    sills and lintels are in the stripes of windows, but ledges run through all of them.
    """

    window: Float
    railing: Float
    level: Float


def wall_colour(evidence: Evidence, top: int, bottom: int, storey: float) -> Wall:
    """Colour of the wall around each pixel: a mean of the smooth pixels at about the same height.

    Repeated with the pixels that are unlike it left out, so it follows shadows across the facade.
    """
    lab = evidence.lab[top:bottom]
    edges = np.minimum(np.abs(evidence.gx[top:bottom]), 20)
    texture = blur(edges, max(1.0, storey / 20), storey / 6)
    seen = evidence.valid[top:bottom]
    usual = float(np.percentile(texture[seen], 35)) if seen.any() else 0.0
    smooth = np.exp(-((texture / max(usual, 1e-3)) ** 2)) * seen
    weight = smooth + 1e-4 * seen
    colour, distance = lab, np.zeros(lab.shape[:2], np.float32)
    for _ in range(3):
        total = blur(weight, 0.7 * storey, 0.06 * storey) + 1e-6
        spread = [blur(weight * lab[:, :, c], 0.7 * storey, 0.06 * storey) for c in range(3)]
        colour = np.dstack([s / total for s in spread])
        scaled = (lab - colour) * np.array([0.7, 1.3, 1.3], np.float32)
        distance = np.sqrt((scaled**2).sum(-1))
        weight = smooth * np.exp(-((distance / 12) ** 2)) + 1e-4 * seen
    return Wall(distance.astype(np.float32), colour.astype(np.float32))


def class_scores(evidence: Evidence, wall: Wall, top: int, bottom: int, storey: float) -> Scores:
    """Scores of every pixel between the eaves and the ground floor."""
    lightness = evidence.lab[top:bottom, :, 0]
    fine = storey / 48
    spread = storey * _SPREAD_X, storey * _SPREAD_Y
    seen = evidence.valid[top:bottom]
    textures = []
    for across_x in (True, False):
        sigma = (fine, 0.0) if across_x else (0.0, fine)
        detail = np.minimum(np.abs(lightness - blur(lightness, *sigma)), 30)
        textures.append(_relative(blur(detail, *spread), seen))
    upright = np.minimum(np.abs(evidence.gx[top:bottom]), 20)
    upright = _relative(blur(upright, storey * _AROUND_X, storey * _AROUND_Y), seen)
    level = np.minimum(np.abs(evidence.gy[top:bottom]), 20)
    level = _LEVEL * _relative(blur(level, storey * _AROUND_X, storey * _AROUND_Y), seen)
    unlike = _relative(blur(wall.unlike, *spread), seen)
    bluer = blur(wall.colour[:, :, 2] - evidence.lab[top:bottom, :, 2], *spread) / _BLUER
    cues = np.dstack([*textures, unlike, np.clip(bluer, -LIMIT, LIMIT), upright])
    # Not "@": the small products of some BLAS builds raise false floating-point flags.
    weighed = cv2.transform(
        cues, np.array([[*weights, -level] for weights, level in (_WINDOW, _RAILING)])
    )
    window, railing = np.moveaxis(np.clip(weighed, -LIMIT, LIMIT).astype(np.float32), -1, 0)
    return where_seen(Scores(window, railing, level), evidence, top)


def where_seen(scores: Scores, evidence: Evidence, top: int) -> Scores:
    """The scores, but 0 (nothing known) where the rectified image has no photo."""
    seen = evidence.valid[top : top + len(scores.window)]
    if seen.all():
        return scores
    return Scores(scores.window * seen, scores.railing * seen, scores.level * seen)


def _relative(values: Float, seen: NDArray[np.bool_]) -> Float:
    """Logarithm against the median of what is photo."""
    middle = max(float(np.median(values[seen])) if seen.any() else 0.0, 1e-3)
    return np.asarray(cv2.log(values / middle + 0.1), np.float32)
