"""Two places become one, and the whole one file.

python examples/07_merge_places.py one two both.glb
"""

from __future__ import annotations

import sys

import veduta

first, second, target = sys.argv[1:4]
both = veduta.load(first).merge(veduta.load(second))
both.write(target)
box = both.bounds_m()
if box is not None:
    size = box[1] - box[0]
    print(f"{len(both.parts)} parts, {size[0]:.1f} x {size[1]:.1f} x {size[2]:.1f} m")
