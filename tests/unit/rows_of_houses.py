"""Lots for tests: a row of houses of 12 m by 9 m, from the origin to the east."""

from __future__ import annotations

import json
from pathlib import Path


def write_row(path: Path, count: int, *, every_m: float = 20.0) -> None:
    """Write GeoJSON with the lots `house-0`, `house-1`, ..., one every so many metres."""
    features = []
    for number in range(count):
        x = every_m * number
        ring = [[x, 0.0], [x + 12, 0.0], [x + 12, 9.0], [x, 9.0], [x, 0.0]]
        shape = {"type": "Polygon", "coordinates": [ring]}
        features.append({"type": "Feature", "id": f"house-{number}", "geometry": shape})
    path.write_text(json.dumps({"type": "FeatureCollection", "features": features}))
