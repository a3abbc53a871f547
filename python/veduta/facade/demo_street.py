"""A procedural street around the house of the demo: lots on both sides, built by a style.

The neighbours are invented and say so. OUT/lots has the lots as anybody may write them, OUT/street
what `veduta grammar derive` makes of them, OUT/place.json the house and the street as one place.
"""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

from veduta.facade.document import FacadeDocument
from veduta.formats.place_json import read_place
from veduta.grammar.options import DeriveOptions, GrammarOptions, OutputOptions
from veduta.grammar.pipeline import DeriveResult, run_derive
from veduta.place.manifest import Place, Start, merge
from veduta.run.progress import Progress
from veduta.synthetic.seeds import stream

LOTS, STREET = "lots", "street"
LOTS_FILE = "lots.geojson"
RULES: dict[str, str] = {
    "haussmann": "haussmann",
    "terrace": "victorian",
    "modern": "modern-slab",
    "stucco": "restauration",
}
"""The style of buildings that goes with a style of facades."""
BESIDE = 3
"""Houses on each side of the rebuilt one. None stands opposite: it would hide the front."""
EYE_M, AWAY_M = 1.7, 13.0
"""Where a visitor begins: the height of the eye, and how far from the front."""
SLAB_M = 24.0
"""A slab of flats is about so much longer than a house."""
Ring = list[tuple[float, float]]


def street_lots(document: FacadeDocument, style: str, seed: int) -> str:
    """GeoJSON in metres of the facade's frame: each first edge lies along the street.

    The house stands on 0 <= x <= its width behind y = 0; the street is in front of it.
    """
    rng = stream(seed, "lots")
    more = SLAB_M if style == "modern" else 0.0
    width = document.facade.width_m

    def some(count: int) -> list[tuple[float, float]]:
        sizes = rng.uniform((10.0 + more, 10.0), (17.0 + more, 13.0), (count, 2)).round(1)
        return [(wide, deep) for wide, deep in sizes.tolist()]

    rows: list[tuple[str, Ring]] = []
    left = 0.0
    for number, (wide, deep) in enumerate(some(BESIDE)):
        rows.append((f"left-{number + 1}", _ring(left - wide, left, 0.0, deep)))
        left -= wide
    right = width
    for number, (wide, deep) in enumerate(some(BESIDE)):
        rows.append((f"right-{number + 1}", _ring(right, right + wide, 0.0, deep)))
        right += wide
    features = [
        {
            "type": "Feature",
            "properties": {"name": name},
            "geometry": {"type": "Polygon", "coordinates": [[*ring, ring[0]]]},
        }
        for name, ring in rows
    ]
    return json.dumps({"type": "FeatureCollection", "features": features}, indent=1) + "\n"


def _ring(start: float, end: float, front: float, back: float) -> Ring:
    corners = np.array([[start, front], [end, front], [end, back], [start, back]])
    return [(x, y) for x, y in corners.round(3).tolist()]


def derive_street(
    out: Path, style: str, seed: int, progress: Progress, *, force: bool
) -> DeriveResult:
    """Build OUT/lots into OUT/street, as the verb does."""
    options = GrammarOptions(derive=DeriveOptions(seed=seed), output=OutputOptions(city=False))
    lots = out / LOTS / LOTS_FILE
    return run_derive(RULES[style], lots, out / STREET, options, progress, force=force)


def joined_place(out: Path, house: str) -> Place:
    """The rebuilt house, whose place is in OUT/`house`, and the street as one place of OUT."""
    first = read_place(out / house / "place.json")
    second = read_place(out / STREET / "place.json")
    low, high = first.parts[0].bounds.min, first.parts[0].bounds.max
    start = Start(eye=(low[0] - 7.0, -AWAY_M, EYE_M), target=((low[0] + high[0]) / 2, 0.0, 5.0))
    empty = first.model_copy(update={"parts": [], "tileset": None, "start": start})
    return merge(merge(empty, first, house), second, STREET)
