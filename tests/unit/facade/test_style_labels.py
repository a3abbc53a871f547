"""What of a derived front is seen from the street: slabs under railings."""

import numpy as np
import pytest

from veduta.facade.style.elevation import Elevation
from veduta.facade.style.labels import front_of

Box = tuple[float, float, float, float]
RAILING: Box = (1.0, 4.0, 5.0, 5.0)
SLAB: Box = (0.9, 3.8, 5.1, 4.0)


def balconies(*boxes: Box) -> list[list[float]]:
    """Those that a front of 6 m has, whose surfaces of balconies lie in these boxes."""
    count = len(boxes)
    names = ("balcony",) * count, ("chosen",) * count
    found = Elevation(*names, np.array(boxes), np.zeros(count), (), 9.0)
    rows = front_of(found, 6.0, 1.0).boxes["balcony"]
    return [[round(value, 6) for value in row] for row in rows.tolist()]


def test_a_slab_and_what_carries_it_are_of_the_balcony() -> None:
    """Consoles and shadow reach 0.3 m below it."""
    assert balconies(RAILING) == [list(RAILING)]
    assert balconies(RAILING, SLAB) == [[1.0, 3.5, 5.0, 5.0]]
    assert balconies(RAILING, RAILING, SLAB, SLAB) == [[1.0, 3.5, 5.0, 5.0]]


@pytest.mark.parametrize(
    "slab",
    [
        (0.9, 2.8, 5.1, 3.0),  # of the floor below
        (0.9, 3.8, 2.0, 4.0),  # under a small part of it
    ],
)
def test_slabs_elsewhere_carry_no_railing(slab: Box) -> None:
    assert balconies(RAILING, slab) == [list(RAILING)]


def test_a_slab_alone_is_no_balcony() -> None:
    assert balconies(SLAB) == []
