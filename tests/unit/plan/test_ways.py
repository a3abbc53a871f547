"""Names of rooms tell which of several ways the walls of a sheet are drawn in."""

from __future__ import annotations

from functools import partial

import numpy as np
import pytest

from veduta.plan.document import Text
from veduta.plan.reading import read_storey
from veduta.synthetic.plans.degrade import DEGRADATIONS
from veduta.synthetic.plans.sets import sheets_of
from veduta.synthetic.plans.styles import BY_NAME
from veduta.synthetic.plans.truth_file import SheetTruth

CLEAN = next(one for one in DEGRADATIONS if one.name == "clean")


def names(truth: SheetTruth) -> list[Text]:
    """A name in the middle of each room."""
    found = []
    for room in truth.storey.rooms:
        middle = np.append(np.mean(room.outline_m, axis=0), 1.0)
        x, y = (truth.px_from_m @ middle)[:2]
        box = [(x - 20, y - 6), (x + 20, y - 6), (x + 20, y + 6), (x - 20, y + 6)]
        found.append(Text(text="Bedroom", box_px=box, score=1.0))
    return found


@pytest.mark.parametrize(("seed", "style"), [(4014, "single"), (4003, "hollow")])
def test_names_that_lie_in_one_room_speak_against_a_reading(seed: int, style: str) -> None:
    """A flight's sides look like hollow walls there, and the space between lines of dimensions."""
    picture, truth = next(iter(sheets_of(seed, BY_NAME[style], CLEAN)))
    read = partial(read_storey, np.asarray(picture))
    named = read(names(truth))
    rooms = len(truth.storey.rooms)
    assert rooms - 1 <= len(named.rooms) <= rooms + 1
    assert len(read().rooms) < rooms / 2  # nothing else tells
