"""A rule is written here, derived, edited and derived again; one window is made otherwise.

python examples/05_edit_a_rule.py house.obj
"""

from __future__ import annotations

import sys

from veduta import grammar

RULES = """
attr storeys = 3
Lot    --> extrude(storeys * 3) comp(f) { side : Front | top : Roof }
Front  --> set(material.name, "wall") split(y) { { 3 : Floor }* }
Floor  --> split(x) { { ~2 : Bay }* }
Bay    --> 50% : split(x) { ~1 : Wall | 1 : Window | ~1 : Wall } else : Wall
Window --> set(material.name, "window") color(0.4, 0.6, 0.8)
Wall   --> set(material.name, "wall") color(0.8, 0.7, 0.6)
Roof   --> set(material.name, "roof") color(0.5, 0.2, 0.1)
"""
LOT = [[(0, 0), (12, 0), (12, 8), (0, 8)]]

house = grammar.derive(grammar.parse(RULES), LOT, seed=1)
print(f"{len(house)} shapes, log of their chance {house.log_prior:.2f}")

bay = next(shape for shape in house.shapes() if shape.name == "Bay")
other = 1 - bay.choices[0].index
grammar.rederive(bay, choices=[other])
print(f"after one choice was made otherwise: {house.log_prior:.2f}")

taller = grammar.derive(grammar.parse(RULES), LOT, seed=1, attributes={"storeys": 5.0})
print(f"{len(taller)} shapes with five storeys")
taller.place().write(sys.argv[1])
