"""How much light rooms need, and how far a lamp of a house reaches.

EN 12464-1:2021 asks for 100 lx in corridors and 200 lx in bathrooms; it says nothing of dwellings.
The other values are chosen beside these: places of work are brighter, stores and gardens darker.
"""

from __future__ import annotations

from veduta.plan.document import RoomUse

LUX: dict[RoomUse, float] = {
    "living": 100.0, "dining": 150.0, "kitchen": 200.0, "bedroom": 100.0, "bathroom": 200.0,
    "toilet": 100.0, "utility": 200.0, "storage": 100.0, "wardrobe": 100.0, "hall": 100.0,
    "corridor": 100.0, "stairs": 150.0, "study": 200.0, "sauna": 50.0, "garage": 100.0,
    "balcony": 30.0, "terrace": 30.0, "technical": 150.0, "other": 100.0, "unknown": 100.0,
}  # fmt: skip
"""Mean illuminance of the floor at night."""
UTILISATION = 0.5
"""Share of a lamp's light that reaches the floor of a room with light walls, sooner or later."""
CEILING_LUMEN, WALL_LUMEN = 3000.0, 1200.0
"""The brightest lamp of each kind that does not dazzle in a home."""
LEAST_LUMEN = 300.0
_STEP_LUMEN = 50.0
REACH_PER_HEIGHT = 1.25
"""Radius of illumination on the floor, in heights of the lamp: there it has a quarter of the light
that falls below it (the cube of the cosine)."""
WALL_SPACING_M = 4.0
"""The longest piece of wall that one wall lamp is for."""


def needed_lumen(use: RoomUse, area_m2: float) -> float:
    """What the lamps of a room give together: the lumen method."""
    return LUX[use] * area_m2 / UTILISATION


def lumen_each(needed: float, count: int) -> float:
    """What each of some lamps gives: a round number."""
    steps = -(-needed / count // _STEP_LUMEN)
    return max(LEAST_LUMEN, steps * _STEP_LUMEN)
