"""Names that no room answers to are told; what is rightly written elsewhere is not."""

from __future__ import annotations

import numpy as np

from veduta.plan.document import Text
from veduta.plan.names.strays import stray_names

JUNCTIONS = [(0.0, 0.0), (600.0, 0.0), (600.0, 300.0), (0.0, 300.0)]
LEFT = np.array([(5, 5), (295, 5), (295, 295), (5, 295)], dtype=float)


def written(words: str, x: float, y: float, score: float = 1.0) -> Text:
    half = 4.0 * len(words)
    box = [(x - half, y - 6), (x + half, y - 6), (x + half, y + 6), (x - half, y + 6)]
    return Text(text=words, box_px=box, score=score)


def test_a_name_in_no_room_is_told() -> None:
    texts = [written("Bedroom", 150, 150), written("Living room", 450, 150)]
    (note,) = stray_names([LEFT], JUNCTIONS, texts)
    assert note == "'Living room': written where no closed room was found"


def test_the_area_that_is_printed_beside_it_is_told_and_added() -> None:
    texts = [written("Living room", 450, 150), written("18,5 m2", 450, 168)]
    far = written("30 m2", 450, 280)
    (note,) = stray_names([LEFT], JUNCTIONS, [*texts, far], 40.0)
    assert note == (
        "'Living room' (18.5 m²): written where no closed room was found; 58.5 m² with it"
    )
    (plain,) = stray_names([LEFT], JUNCTIONS, [texts[0], far], 40.0)
    assert plain == "'Living room': written where no closed room was found"


def test_titles_terraces_sizes_and_what_is_hardly_read_are_not() -> None:
    texts = [
        written("Kitchen", 300, 350),  # below all walls: a title
        written("Terrace", 450, 150),
        written("3.20 x 4.10", 450, 180),
        written("Bathroom", 450, 220, score=0.5),
        written("Storage", 310, 40),  # reaches into the room, which is too small for it
    ]
    assert stray_names([LEFT], JUNCTIONS, texts) == []


def test_two_rooms_with_doors_in_one_space_are_told() -> None:
    texts = [written("Bedroom 1", 100, 60), written("Bedroom 2", 150, 250)]
    (note,) = stray_names([LEFT], JUNCTIONS, texts)
    assert "'Bedroom 1' and 'Bedroom 2'" in note


def test_an_open_kitchen_and_two_lines_of_one_label_are_not() -> None:
    texts = [written("Kitchen", 100, 60), written("Living room", 150, 250)]
    assert stray_names([LEFT], JUNCTIONS, texts) == []
    texts = [written("Bedroom", 150, 140), written("Bathroom", 150, 155)]
    assert stray_names([LEFT], JUNCTIONS, texts) == []


def test_a_sheet_without_walls_says_nothing() -> None:
    assert stray_names([], [], [written("Bedroom", 1, 1)]) == []
