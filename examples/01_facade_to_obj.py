"""A photo of a facade becomes an OBJ file with its texture.

python examples/01_facade_to_obj.py photo.jpg house.obj
"""

from __future__ import annotations

import sys

import veduta

photo, target = sys.argv[1:3]
house = veduta.read_facade(photo, height_m=18.0)
house.write(target)

for part in house.parts.values():
    features = part.content.features
    windows = (features.class_code == veduta.SemanticClass.WINDOW.code).sum()
    print(f"{part.id}: {windows} windows, {part.content.attributes['storeysAboveGround']} storeys")
