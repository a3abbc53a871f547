"""Sizes of the parts of a window, straight or curved."""

from __future__ import annotations

FRAME_M = 0.06
DEPTH_M = 0.07
GLASS_M = 0.012
SILL_FROM_M = 0.3
"""Windows that begin lower have no sill."""

SILL_M = 0.03
SILL_BEYOND_M = {"inside": 0.12, "outside": 0.05}
"""How far sills reach beyond the faces of the wall."""
