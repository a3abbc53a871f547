"""What the report says of first pairs: which, by whom they were chosen, and why."""

from __future__ import annotations

from dataclasses import replace

from veduta.photos.mapping.initial_pair import Start, WeighedPair
from veduta.photos.report_starts import starts_notes, starts_table

NAMES = {number: f"{number}.jpg" for number in range(1, 8)}
PAIR = WeighedPair(2, 3, 1500, known=True, planar=0.31, angle_deg=12.4)
BY_CONDITIONS = Start(PAIR, "conditions", passed_over=4, refused=0)
PLANAR = replace(PAIR, first=5, second=6, planar=0.93)
BY_ENGINE = Start(PLANAR, "engine", passed_over=9, refused=0)
COMPONENTS = [(1, 2, 3, 4), (5, 6, 7)]


def test_the_notes_name_photos_and_reasons() -> None:
    first, second = starts_notes([BY_CONDITIONS, BY_ENGINE], COMPONENTS, NAMES)
    assert first == (
        "the map of A begins with 2.jpg and 3.jpg: 1,500 matches, of which a homography explains"
        " 31%, and rays 12° apart"
    )
    assert (
        "B begins with 5.jpg and 6.jpg: the engine chose them, for of 9 pairs none meets" in second
    )
    assert "a homography explains 93% of the matches" in second


def test_what_was_tried_before_is_said() -> None:
    (note,) = starts_notes([replace(BY_CONDITIONS, refused=2)], COMPONENTS, NAMES)
    assert "from 2 better pairs no map grew" in note
    (note,) = starts_notes([replace(BY_ENGINE, refused=1)], COMPONENTS, NAMES)
    assert "no map grew from the 1 pair that meets the conditions" in note
    assumed = replace(BY_CONDITIONS, pair=replace(PAIR, known=False))
    assert "focal length assumed" in starts_notes([assumed], COMPONENTS, NAMES)[0]


def test_components_are_found_by_their_photos() -> None:
    """The order of the starts is that of growing; a component that is gone has no row."""
    (table,) = starts_table([BY_ENGINE, BY_CONDITIONS], COMPONENTS, NAMES)
    assert [row[0] for row in table.rows] == ["A", "B"]
    assert list(table.rows[0])[1:7] == ["2.jpg", "3.jpg", 1500, 31.0, 12.4, "yes"]
    (table,) = starts_table([BY_ENGINE, BY_CONDITIONS], COMPONENTS[1:], NAMES)
    assert [(row[0], row[1]) for row in table.rows] == [("A", "5.jpg")]
    assert starts_table([], COMPONENTS, NAMES) == []
