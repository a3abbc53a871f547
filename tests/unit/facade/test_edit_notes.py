"""What an edited document says of itself."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from veduta.facade.document import FacadeDocument
from veduta.facade.edit_notes import Edits, told
from veduta.facade.plausible import HARDLY_ALIKE, NOT_PARTED
from veduta.facade.scale import ASSUMED_STOREY

Make = Callable[..., FacadeDocument]
FOUND = "the left side is that of the picture"


@pytest.fixture
def doubted(make_document: Make) -> FacadeDocument:
    """A document of assumed scale whose storeys are in doubt."""
    document = make_document()
    notes = [FOUND, ASSUMED_STOREY, HARDLY_ALIKE, NOT_PARTED]
    return document.model_copy(update={"storeys_doubtful": True, "notes": notes})


def test_nothing_edited_is_the_same_document(doubted: FacadeDocument) -> None:
    assert told(doubted, Edits()) is doubted


def test_an_edited_scale_is_no_longer_assumed(doubted: FacadeDocument) -> None:
    document = told(doubted, Edits(scale=True))
    assert document.scale.basis == "edited"
    assert document.scale.metres_per_px == doubted.scale.metres_per_px
    assert document.notes == [FOUND, HARDLY_ALIKE, NOT_PARTED]
    assert document.storeys_doubtful


def test_who_edits_the_floors_settles_the_doubt(doubted: FacadeDocument) -> None:
    document = told(doubted, Edits(floors=True))
    assert not document.storeys_doubtful
    assert document.notes == [FOUND, ASSUMED_STOREY]


def test_so_does_who_says_it(doubted: FacadeDocument) -> None:
    said = doubted.model_copy(update={"storeys_doubtful": False})
    assert told(said, Edits()).notes == [FOUND, ASSUMED_STOREY]


def test_an_edit_elsewhere_leaves_both(doubted: FacadeDocument) -> None:
    document = told(doubted, Edits(metres=("window (elements[3])",), rules=True))
    assert document.storeys_doubtful
    assert document.scale == doubted.scale
    assert document.notes[:4] == doubted.notes
    assert "window (elements[3])" in document.notes[4]
    assert len(document.notes) == 6


def test_notes_of_earlier_edits_make_place(doubted: FacadeDocument) -> None:
    once = told(doubted, Edits(metres=("the facade",), rules=True))
    twice = told(once, Edits(metres=("door (elements[2])",)))
    assert [note for note in twice.notes if "the facade" in note or "made anew" in note] == []
    assert sum("door (elements[2])" in note for note in twice.notes) == 1


def test_many_names_are_counted(doubted: FacadeDocument) -> None:
    names = tuple(f"window (elements[{n}])" for n in range(40))
    (note,) = set(told(doubted, Edits(metres=names + names)).notes) - set(doubted.notes)
    assert "elements[4]" in note
    assert "elements[5]" not in note
    assert note.endswith("and 35 more")


@pytest.mark.parametrize("border", ["x_px", "y_px", "width_px", "height_px"])
def test_a_wall_that_is_painted_elsewhere_is_said(make_document: Make, border: str) -> None:
    document = make_document()
    assert told(document, Edits(rules=True)).notes[-1].startswith("rules")
    setattr(document.facade, border, getattr(document.facade, border) + 3.0)
    assert told(document, Edits(rules=True)).notes[-1].startswith("extents: ")


def test_a_document_without_a_painted_wall_has_nothing_to_say(make_document: Make) -> None:
    document = make_document(extents=[("sky", [(0, 0), (120, 0), (0, 40)])])
    assert len(told(document, Edits(rules=True)).notes) == 1
