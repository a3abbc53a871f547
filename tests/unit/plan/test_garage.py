"""The widest way out of a room that is named a garage is its door."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from veduta.plan.drawn import Cleaned, Drawn, DrawnOpening, DrawnRoom
from veduta.plan.garage import with_garage_doors


def drawn(*openings: DrawnOpening) -> Drawn:
    """Two rooms side by side; the first has all of the openings, the second what is called in."""
    ring = np.array([[0.0, 0.0], [0.0, 400.0], [400.0, 400.0], [400.0, 0.0]])
    rooms = (
        DrawnRoom("r1", ring, (), ("w1",), tuple(one.id for one in openings), False, 0.9),
        DrawnRoom("r2", ring + 410.0, (), ("w1",), tuple(one.id for one in openings
                  if one.id.startswith("in")), False, 0.9),
    )  # fmt: skip
    pixels = np.full((500, 500, 3), 255, np.uint8)
    ink = np.zeros((500, 500), np.float32)
    cleaned = Cleaned(pixels, ink, np.eye(3), False, 0.0, 2.0)
    return Drawn(cleaned, (), (), openings, rooms)


def opening(name: str, width_px: float, kind: str = "window") -> DrawnOpening:
    """One in the first wall."""
    return DrawnOpening(name, "w1", kind, "filled", 10.0, width_px, "none", "none", 0.9)  # type: ignore[arg-type]


WIDE, NARROW, WITHIN = opening("out1", 250.0), opening("out2", 90.0), opening("in1", 300.0, "gap")


def test_the_widest_way_out_of_a_garage_is_its_door() -> None:
    found = with_garage_doors(drawn(WIDE, NARROW, WITHIN), {"r1": "garage"}, 0.01)
    assert [(one.kind, one.type) for one in found.openings] == [
        ("door", "garage"), ("window", "filled"), ("gap", "filled")
    ]  # fmt: skip


@pytest.mark.parametrize("use", ["living", "garage"])
def test_other_rooms_and_those_with_a_door_stay(use: str) -> None:
    known = replace(NARROW, kind="door", type="garage")
    plan = drawn(WIDE, known) if use == "garage" else drawn(WIDE)
    assert with_garage_doors(plan, {"r1": use}, 0.01) is plan  # type: ignore[dict-item]
