"""What a place consists of, as numbers: area and count of each class, and how much was measured.

python examples/08_count_windows.py out
"""

from __future__ import annotations

import sys
from collections import Counter, defaultdict

import veduta
from veduta import Provenance

counts: Counter[str] = Counter()
areas: defaultdict[str, float] = defaultdict(float)
measured: defaultdict[str, float] = defaultdict(float)
for part in veduta.load(sys.argv[1]).parts.values():
    features = part.content.features
    for row, area in enumerate(part.content.feature_area_m2):
        name = features.semantic(row).value
        counts[name] += 1
        areas[name] += area
        measured[name] += area if features.provenance(row) is Provenance.MEASURED else 0.0
for name, area in sorted(areas.items(), key=lambda item: -item[1]):
    share = measured[name] / area if area else 0.0
    print(f"{name:<10}{counts[name]:>6}{area:>10.1f} m2   {share:>5.0%} measured")
