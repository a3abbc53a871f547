"""What assets are made of."""

from __future__ import annotations

from veduta.grammar.assets.asset import Slot

FRAME = Slot("frame", roughness=0.6, fallback=(0.92, 0.91, 0.87))
PANE = Slot("pane", (0.55, 0.66, 0.73), roughness=0.12, texture="glass")
LEAF = Slot("leaf", roughness=0.5, fallback=(0.24, 0.32, 0.29), texture="wood")
BRASS = Slot("brass", (0.66, 0.53, 0.29), roughness=0.35, metalness=0.6)
STEEL = Slot("steel", (0.55, 0.57, 0.58), roughness=0.35, metalness=0.6)
IRON = Slot("iron", roughness=0.55, fallback=(0.13, 0.135, 0.14))
GLASS = Slot("glass", (0.66, 0.76, 0.76), roughness=0.12)
STONE = Slot("stone", roughness=0.9, fallback=(0.9, 0.87, 0.79), texture="stone")
ZINC = Slot("zinc", (0.43, 0.46, 0.49), roughness=0.6, texture="zinc")
TILE = Slot("tile", (0.5, 0.36, 0.31), roughness=0.85, texture="clay-tile")
CHEEK = Slot("cheek", roughness=0.8, fallback=(0.43, 0.46, 0.49))
BRICK = Slot("brick", roughness=0.95, fallback=(0.69, 0.52, 0.42), texture="brick")
POT = Slot("pot", (0.62, 0.42, 0.33), roughness=0.85)
PAPER = Slot("paper", roughness=0.9, fallback=(0.95, 0.9, 0.8))
FLOOR = Slot("floor", (0.56, 0.44, 0.32), roughness=0.7)
CEILING = Slot("ceiling", (1.0, 0.98, 0.94), roughness=0.9)
LAMP = Slot("lamp", (1.0, 0.97, 0.86), roughness=0.9)
SHELF = Slot("shelf", (0.63, 0.47, 0.32), roughness=0.7)
BARK = Slot("bark", (0.42, 0.34, 0.27), roughness=0.95, texture="wood")
LEAVES = Slot("leaves", roughness=0.95, fallback=(0.37, 0.48, 0.24), texture="lawn")
WARE_RED = Slot("ware-red", (0.78, 0.33, 0.24), roughness=0.6)
WARE_BLUE = Slot("ware-blue", (0.31, 0.46, 0.6), roughness=0.6)
WARE_YELLOW = Slot("ware-yellow", (0.9, 0.76, 0.42), roughness=0.6)
