"""Terraces before doors to the garden: thin lines and a word, no walls and no room."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from shapely.geometry import Polygon
from shapely.geometry.base import BaseGeometry

from veduta.synthetic.plans import curves
from veduta.synthetic.plans.canvas import Canvas, text_size_px
from veduta.synthetic.plans.house import Language, Storey
from veduta.synthetic.plans.places import place_of
from veduta.synthetic.plans.styles import Style

WORDS: Mapping[Language, tuple[str, ...]] = {
    "en": ("Terrace", "Patio"), "pt": ("Varanda", "Terraço"), "fr": ("Terrasse", "Balcon"),
    "de": ("Terrasse", "Balkon"), "fi": ("Terassi", "Parveke"),
}  # fmt: skip
SHARE = 0.6
LEAST_M2 = 2.0


@dataclass(frozen=True)
class Terrace:
    """Its outline in metres, and the word on it."""

    area: Polygon
    word: str


def terraces_of(
    rng: np.random.Generator, style: Style, storey: Storey, house: BaseGeometry
) -> list[Terrace]:
    """Before some of the French and sliding doors in outer walls; clear of the house itself."""
    made: list[Terrace] = []
    for door in storey.openings:
        wall = storey.wall(door.wall)
        if door.type not in ("french", "sliding") or not wall.outer or rng.random() >= SHARE:
            continue
        place = place_of(wall, door)
        side = 1.0 if wall.left is None else -1.0
        deep, more = rng.uniform(1.6, 2.4), rng.uniform(0.4, 1.2)
        low, high = max(-more, -door.along_m), door.width_m + more
        high = min(high, curves.wall_length(wall) - door.along_m)
        far = side * (place.half_m + deep)
        area = place.box(low, high, side * place.half_m, far).difference(house)
        if isinstance(area, Polygon) and area.area > LEAST_M2:
            words = WORDS[style.language]
            made.append(Terrace(area, words[int(rng.integers(len(words)))]))
    return made


def draw_terraces(canvas: Canvas, style: Style, terraces: list[Terrace]) -> None:
    """Their outlines and words; the word where it fits."""
    height = float(np.clip(0.2 / canvas.metres_per_px, 11.0, 22.0))
    for terrace in terraces:
        canvas.outline(terrace.area, 0.8 * style.pen_px, style.ink)
        x0, y0, x1, y1 = terrace.area.bounds
        word = terrace.word.upper() if style.capitals else terrace.word
        wide = text_size_px(word, height, style.font, style.weight)[0] * canvas.metres_per_px
        if wide < 0.9 * (x1 - x0):
            middle = ((x0 + x1) / 2, (y0 + y1) / 2)
            canvas.text(word, middle, height, style.font, style.ink, style.weight)
