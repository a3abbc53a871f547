"""Whether the picture shows a building at all, before anything is fitted to it."""

from __future__ import annotations

import numpy as np

from veduta.facade.evidence import Evidence
from veduta.run.errors import NotFoundError

# Lightness steps per pixel of an edge, and the least share of pixels on edges.
_EDGE = 6.0
_EDGES = 0.01
# Half-angle about the axes, and the least share of edges within it. Edges of all directions give
# 0.22 (noise, meadows and animals 0.22 to 0.25); rectified facades 0.35 to 0.78, trees included.
_HALF_ANGLE_DEG = 10.0
_ALIGNED = 0.3

REMEDY = (
    "Give a photo of one house front, from about straight ahead; if this is one, name the corners"
    " of the front with --corners."
)


def require_building(evidence: Evidence) -> None:
    """Raise NotFoundError where hardly any edge is upright or level, as a building's are."""
    strength = np.hypot(evidence.gx, evidence.gy)
    edges = (strength > _EDGE) & evidence.valid
    if edges.sum() < _EDGES * max(int(evidence.valid.sum()), 1):
        reason = "the picture is nearly empty: it has no outlines as a building has"
        raise NotFoundError("a facade", reason, REMEDY)
    direction = np.rad2deg(np.arctan2(evidence.gy[edges], evidence.gx[edges])) % 90
    aligned = float((np.minimum(direction, 90 - direction) < _HALF_ANGLE_DEG).mean())
    if aligned < _ALIGNED:
        raise NotFoundError(
            "a facade",
            f"only {100 * aligned:.0f} % of its outlines are upright or level, as a building's "
            f"are; a picture of mere noise has {200 * _HALF_ANGLE_DEG / 90:.0f} %",
            REMEDY,
        )
