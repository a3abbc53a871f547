"""Things that stand for themselves."""

from __future__ import annotations

from veduta.plan.furnish.arrangement import Order, Prefer, Variant, alone, fixed, widths_of
from veduta.plan.furnish.choice import Choice
from veduta.plan.furnish.room import RoomSpace

WHERE: dict[str, tuple[Order, Prefer]] = {
    "bathtub": ("far", "ends"), "shower": ("far", "ends"), "washer": ("far", "ends"),
    "dryer": ("far", "beside"), "utility-sink": ("far", "beside"), "towel-rail": ("any", "middle"),
    "basket": ("far", "ends"), "wardrobe": ("any", "ends"), "chest": ("any", "middle"),
    "chest-tall": ("any", "ends"), "bookcase": ("any", "ends"), "bookcase-low": ("any", "middle"),
    "dressing-table": ("any", "window"), "sideboard": ("any", "middle"),
    "cabinet": ("far", "ends"), "piano": ("any", "middle"), "fireplace": ("far", "middle"),
    "plant": ("any", "window"), "floor-lamp": ("far", "ends"), "picture": ("any", "middle"),
    "clock": ("far", "middle"), "wall-shelf": ("any", "middle"),
    "mirror-standing": ("near", "ends"), "hall-mirror": ("near", "middle"),
    "console": ("any", "middle"), "umbrella-stand": ("near", "ends"),
    "shelf-rack": ("far", "ends"), "boxes": ("far", "ends"), "boiler": ("far", "middle"),
    "water-tank": ("far", "ends"), "sauna-bench": ("far", "middle"),
    "sauna-stove": ("near", "ends"), "workbench": ("far", "middle"), "bicycle": ("any", "ends"),
    "armchair": ("any", "window"), "kitchen-unit": ("any", "beside"),
    "oven-tower": ("any", "beside"), "planter": ("far", "ends"), "grill": ("far", "ends"),
    "toilet": ("far", "any"), "basin": ("near", "any"), "handbasin": ("near", "any"),
    "fridge": ("any", "ends"), "fridge-small": ("any", "ends"),
    "kitchen-sink": ("any", "window"), "kitchen-hob": ("any", "middle"),
    "lounger": ("far", "ends"),
}  # fmt: skip
FREE = frozenset({"car", "kitchen-island", "exercise-ball"})
"""They stand in the room."""
CORNERS = frozenset({"shower"})
"""They have glass on the other sides."""


def single(kind: str, choice: Choice, space: RoomSpace) -> list[Variant]:
    """One thing of a type: as wide as usual, then less; then what stands in for it."""
    found: list[Variant] = []
    seen: set[str] = set()
    current: str | None = kind
    while current is not None and current not in seen and choice.knows(current):
        seen.add(current)
        entry = choice.entry(current)
        shares = (1.0, 0.7, 0.4, 0.0)
        order, prefer = WHERE.get(current, WHERE.get(kind, ("any", "any")))
        for width in _wide(kind, space, entry.widths_m[1]) + widths_of(entry, *shares):
            size = entry.sized(width)
            if current in FREE:
                piece = alone(entry, size, y=size[1] / 2.0 + 0.02)
                found.append(Variant(width, fixed([piece]), free=True))
            else:
                found.append(
                    Variant(
                        width,
                        fixed([alone(entry, size)]),
                        order,
                        prefer,
                        entry.walls,
                        max(entry.side_m, 0.04),
                        corner=current in CORNERS,
                    )
                )
        current = choice.smaller(current)
    return found


def _wide(kind: str, space: RoomSpace, most: float) -> list[float]:
    """Wardrobes take the wall that there is."""
    if kind != "wardrobe":
        return []
    longest = max((stretch.length for stretch in space.stretches), default=0.0)
    share = 1.0 if space.room.use == "wardrobe" else 0.6
    return [round(min(most, share * longest), 1)] if share * longest > 1.9 else []
