"""Building lots on a map become a street of houses: models for the eye, outlines for the map.

python examples/02_town_from_geojson.py town
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

import veduta

folder = Path(sys.argv[1])
folder.mkdir(parents=True, exist_ok=True)

# Three lots in Berlin, each with its front to the street in the south.
lots = folder / "lots.geojson"
east, north, features = 13.377, 52.516, []
for number in range(3):
    left, right = east + number * 2e-4, east + number * 2e-4 + 1.9e-4
    ring = [[left, north], [right, north], [right, north + 1.2e-4], [left, north + 1.2e-4]]
    polygon = {"type": "Polygon", "coordinates": [[*ring, ring[0]]]}
    name = {"name": f"House {number + 1}"}
    features.append({"type": "Feature", "properties": name, "geometry": polygon})
lots.write_text(json.dumps({"type": "FeatureCollection", "features": features}))

town = veduta.derive("haussmann", lots, seed=7)
town.title = "Three houses"
town.write(folder / "town.glb")
town.write(folder / "town.gpkg")
print(f"{len(town.parts)} houses in {town.crs}")
