"""Floor plans become a furnished house: as IFC for architects, and as USD for film and games.

python examples/03_plan_to_ifc.py ground.png upper.png out
"""

from __future__ import annotations

import sys
from pathlib import Path

import veduta

*drawings, folder = sys.argv[1:]
house = veduta.read_plan(drawings, folder)
out = Path(folder)
print(f"{out / 'house.ifc'}: {(out / 'house.ifc').stat().st_size / 1e6:.1f} MB")
house.write(out / "house.usdz")
for tour in house.tours:
    rooms = [stretch.name for stretch in tour.stretches if stretch.room]
    print(f"{tour.name}: {' - '.join(rooms)}")
