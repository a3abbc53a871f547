"""Leaves whose traces are lost and lines of furniture are no walls, nor does their ink carry on."""

from __future__ import annotations

import numpy as np
import pytest

from veduta.plan.names.vocabulary import meanings
from veduta.plan.openings.classify import Judged
from veduta.plan.openings.gaps import Gap
from veduta.plan.openings.leaf_pieces import hung_leaves, unproven
from veduta.plan.reading import without_pieces
from veduta.plan.walls.axes import Axis, OnAxis
from veduta.plan.walls.find import Found
from veduta.plan.walls.pieces import Piece
from veduta.plan.walls.solid import Thickness

THIN = 12.0


def piece(start: tuple[float, float], end: tuple[float, float], thick: float = THIN) -> Piece:
    return Piece(np.array(start), np.array(end), thick, "filled")


def way(start: tuple[float, float], end: tuple[float, float], kind: str, score: float) -> Judged:
    ends = np.array(start), np.array(end)
    gap = Gap(0, True, 1, False, *ends, THIN, ends[1])
    if kind == "swing":
        return Judged(gap, "door", "swing", "start", "left", score)
    return Judged(gap, "gap", "plain", "none", "none", score)


WALLS = [piece((0, 0), (100, 0)), piece((180, 0), (400, 0)), piece((0, 200), (400, 200))]
DOOR = way((100, 0), (180, 0), "plain", 0.7)


def test_a_slab_at_a_jamb_as_long_as_its_way_is_wide_is_a_leaf() -> None:
    leaf = piece((104, 4), (104, 82), 6.0)
    assert hung_leaves([*WALLS, leaf], [DOOR], THIN) == {3}
    for other in (
        piece((104, 4), (104, 82)),  # as thick as walls
        piece((104, 4), (104, 192), 6.0),  # on to the next wall
        piece((140, 4), (140, 82), 6.0),  # at no jamb
        piece((104, 4), (160, 60), 6.0),  # not square to the way
    ):
        assert hung_leaves([*WALLS, other], [DOOR], THIN) == set()
    swing = way((100, 0), (180, 0), "swing", 0.8)
    assert hung_leaves([*WALLS, leaf], [swing], THIN) == set()


@pytest.mark.parametrize(
    ("thick", "kind", "score", "open_px", "stays"),
    [
        (8.0, "plain", 0.7, 160.0, False),
        (8.0, "swing", 0.5, 160.0, False),
        (8.0, "swing", 0.8, 160.0, True),
        (12.0, "plain", 0.7, 160.0, True),
        (8.0, "plain", 0.7, 80.0, True),
    ],
)
def test_a_thin_line_that_is_mostly_open_is_no_wall(
    thick: float, kind: str, score: float, open_px: float, stays: bool
) -> None:
    line = piece((0, 0), (0, 200), thick)
    judged = way((0, 10), (0, 10 + open_px), kind, score)
    axis = Axis(line, (OnAxis(judged, 10.0, 10.0 + open_px, along=True),))
    assert unproven([axis], THIN) == ([axis] if stays else [])


def test_what_is_solid_of_a_leaf_goes_with_it() -> None:
    """But for where a wall stands: the leaf begins in it."""
    solid = np.zeros((240, 420), np.bool_)
    solid[14:26, 10:400] = solid[20:100, 100:106] = True
    pieces = [piece((10, 20), (400, 20)), piece((103, 20), (103, 100), 6.0)]
    found = Found(pieces, solid, Thickness(5.0, 14.0), THIN)
    left = without_pieces(found, {1})
    assert left.pieces == pieces[:1]
    assert left.solid[14:26, 10:400].all()
    assert not left.solid[40:100].any()


@pytest.mark.parametrize(
    ("label", "use"),
    [
        ("LD 9.2帖", "living"),
        ("収納", "wardrobe"),
        ("押入", "wardrobe"),
        ("物入", "storage"),
        ("床下収納", "storage"),
        ("PS", "technical"),
    ],
)
def test_words_of_japanese_flats(label: str, use: str) -> None:
    assert meanings(label)[0].use == use
