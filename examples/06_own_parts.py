"""A place of your own parts, with classes and provenance, for the studio and for city models.

python examples/06_own_parts.py out
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

import veduta
from veduta import Mesh, Place, Provenance, SemanticClass, Standing

# A hill of 40 x 40 points, 1 m apart, coloured by its height.
x, y = np.meshgrid(np.arange(40.0), np.arange(40.0))
z = 4.0 * np.exp(-((x - 20.0) ** 2 + (y - 20.0) ** 2) / 120.0)
points = np.stack([x.ravel(), y.ravel(), z.ravel()], axis=1)
corner = (np.arange(39)[:, None] * 40 + np.arange(39)).ravel()
lower = np.stack([corner, corner + 1, corner + 41], axis=1)
upper = np.stack([corner, corner + 41, corner + 40], axis=1)
green = np.clip(90 + 30 * points[:, 2], 0, 255).astype(np.uint8)
colours = np.stack([green // 2, green, green // 3], axis=1)
hill = Mesh.simple(
    "hill",
    points,
    np.concatenate([lower, upper]),
    SemanticClass.GROUND,
    Provenance.INVENTED,
    colours=colours,
)

place = Place(title="A hill", author="Nobody", licence="CC0")
place.add(hill, Standing(name="The hill", ground=True))
out = Path(sys.argv[1])
out.mkdir(parents=True, exist_ok=True)
place.save(out)
place.write(out / "hill.city.json")
print(f"{veduta.load(out).title}: look at it with `veduta view {out}`")
