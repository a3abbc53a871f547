"""From the picture of a sheet to the text on it."""

from __future__ import annotations

from functools import partial

import numpy as np
from numpy.typing import NDArray

from veduta.plan.document import Text
from veduta.plan.names.vocabulary import meanings
from veduta.plan.scale.quantities import read_quantities
from veduta.plan.text.engine import Line, read_line, side_by_side
from veduta.plan.text.letters import find_letters
from veduta.plan.text.regions import find_regions
from veduta.plan.text.strips import in_colour, strip_of

MOST_REGIONS = 250
LEAST_SCORE = 0.5
"""What was read less surely is dropped."""
_SIGNS = frozenset("’‘“”′″–—×²㎡ØⅡ≤≥±√∅¼½¾")  # of plans, beyond the Latin letters
_SURE = 0.9  # a line that is read so well stands the way in which it was read
_LONG = 1.5  # a region this much longer than wide runs along its long side


def read_texts(
    pixels: NDArray[np.uint8],
    overview: NDArray[np.float64] | None = None,
) -> list[Text]:
    """The text on a sheet.

    `pixels` is (h, w, 3) sRGB or (h, w) gray, upright and not mirrored (see `orientation`). Boxes
    are in its pixels; corners go clockwise in the direction of reading, from the upper left corner
    of the first letter. Regions that say nothing with `LEAST_SCORE` are left out. `overview`
    (n, 4, 2) is what `find_overview` gave, where it was called before.
    """
    pixels = in_colour(pixels)
    regions = find_regions(pixels, overview)
    read = side_by_side(partial(_read_region, pixels), regions[:MOST_REGIONS])
    texts = [
        Text(text=line.text, box_px=[(float(x), float(y)) for x, y in quad], score=line.score)
        for quad, line in read
        if line.score >= LEAST_SCORE and (_is_latin(line.text) or _is_known(line.text))
    ]
    return [*texts, *find_letters(pixels, texts)]


def _is_latin(text: str) -> bool:
    """Whether it has letters or digits, and none of the scripts that symbols are misread for."""
    return any(letter.isalnum() for letter in text) and all(
        ord(letter) < 0x0250 or letter in _SIGNS for letter in text
    )


def _is_known(text: str) -> bool:
    """Whether it is a word for a room or an area in another script, as 6帖 is."""
    return bool(meanings(text) or any(one.kind == "area" for one in read_quantities(text)))


def _read_region(
    pixels: NDArray[np.uint8], quad: NDArray[np.float64]
) -> tuple[NDArray[np.float64], Line]:
    """The corners in the direction of reading, and what the region says."""
    best_quad, best = quad, Line("", 0.0)
    for turns in _ways_round(quad):
        turned = np.roll(quad, -turns, axis=0)
        line = read_line(strip_of(pixels, turned))
        if line.score > best.score:
            best_quad, best = turned, line
        if best.score >= _SURE and turns in (0, 3):
            break
    return best_quad, best


def _ways_round(quad: NDArray[np.float64]) -> tuple[int, ...]:
    """Which sides of a region may be the top of its text, the likeliest first.

    0 is as it stands, 3 reads upwards, 1 downwards. Plans are read from below and from the right.
    """
    across = np.linalg.norm(quad[1] - quad[0])
    down = np.linalg.norm(quad[3] - quad[0])
    if across > _LONG * down:
        return (0,)
    if down > _LONG * across:
        return (3, 1)
    return (0, 3, 1)
