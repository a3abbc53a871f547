"""What an edit changes elsewhere in the document: it agrees with itself, and keeps the edit."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from drawn_facade import analysed, draw_facade
from hypothesis import given
from hypothesis import strategies as st

from veduta.facade.document import Element, FacadeDocument
from veduta.facade.load import load_document
from veduta.facade.reconcile import reconciled
from veduta.run.errors import InputError

NOTE = "rules and derivation made anew from what was edited"
FLOORS = 4


@pytest.fixture(scope="module")
def found() -> FacadeDocument:
    """What the analysis found in a drawn facade: four floors of windows above shops."""
    document = analysed(draw_facade(FLOORS).pixels)
    assert document.storeys == FLOORS + 1
    return document


Change = Callable[[Any], None]


def edited(document: FacadeDocument, change: Change) -> FacadeDocument:
    """The document after a person has edited its file."""
    content = json.loads(document.model_dump_json(by_alias=True))
    change(content)
    return FacadeDocument.model_validate(content)


def after(document: FacadeDocument, change: Change) -> FacadeDocument:
    """The same, made to agree with itself; a second time there is nothing left to do."""
    done = reconciled(edited(document, change))
    assert reconciled(done) == done
    assert_agrees(done)
    return done


def assert_agrees(document: FacadeDocument) -> None:
    """Rules and tree say what the facade's box and the windows say."""
    facade, rules = document.facade, document.rules
    m = document.scale.metres_per_px
    assert facade.height_m == pytest.approx(facade.height_px * m, abs=0.011)
    assert rules.building_height_m == pytest.approx(facade.height_m, abs=0.011)
    assert sum(rules.facade.sizes_m) == pytest.approx(facade.height_m, abs=0.1)
    assert len(rules.facade.symbols) == len(rules.facade.sizes_m) == len(rules.floors) + 1
    for split in rules.floors:
        assert sum(split.sizes_m) == pytest.approx(facade.width_m, abs=0.011)
    volume, roof = document.derivation.children
    assert (roof.y_m, roof.height_m) == pytest.approx((facade.height_m, rules.roof_height_m))
    (front,) = volume.children
    sizes = [floor.height_m for floor in front.children]
    assert sizes == pytest.approx(rules.facade.sizes_m, abs=0.011)
    for split, floor in zip(rules.floors, front.children[1:], strict=True):
        assert [cell.symbol for cell in floor.children] == split.symbols
        assert [c.width_m for c in floor.children] == pytest.approx(split.sizes_m, abs=0.011)


def windows(document: FacadeDocument, floor: int | None) -> list[Element]:
    of_floor = [e for e in document.elements if e.class_ == "window" and e.floor == floor]
    return sorted(of_floor, key=lambda e: e.x_m)


def index_of(document: FacadeDocument, element: Element) -> int:
    return document.elements.index(element)


def window_sizes(document: FacadeDocument, floor: int) -> list[float]:
    return document.rules.floors[floor - 1].sizes_m[1::2]


def test_what_nobody_edited_stays_as_it_is(found: FacadeDocument) -> None:
    assert reconciled(found) is not found
    assert reconciled(found).model_dump_json() == found.model_dump_json()
    assert_agrees(found)


def test_a_wider_window(found: FacadeDocument) -> None:
    window = windows(found, 2)[1]

    def widen(content: Any) -> None:
        content["elements"][index_of(found, window)]["width_px"] += 10

    done = after(found, widen)
    m = done.scale.metres_per_px
    expected = [w.width_m for w in windows(found, 2)]
    expected[1] += 10 * m
    assert window_sizes(done, 2) == pytest.approx(expected)
    assert window_sizes(done, 3) == window_sizes(found, 3)
    assert done.rules.facade == found.rules.facade
    assert done.notes == [
        *found.notes,
        "pixels and metres differed, and the pixels decided:"
        f" window (elements[{index_of(found, window)}])",
        NOTE,
    ]


def test_a_document_that_is_loaded_agrees(found: FacadeDocument, tmp_path: Path) -> None:
    def change(content: Any) -> None:
        content["elements"][index_of(found, windows(found, 1)[0])]["width_px"] -= 6
        content["rules"]["floors"][1]["sizes_m"][0] += 1.0
        content["derivation"]["children"] = []

    path = tmp_path / "facade.json"
    path.write_text(edited(found, change).model_dump_json(by_alias=True))
    done = load_document(path)
    assert_agrees(done)
    assert done == reconciled(edited(found, change))
    assert done.rules.floors[1:] == found.rules.floors[1:]


def test_a_window_moved_to_the_next_floor(found: FacadeDocument) -> None:
    window = windows(found, 2)[1]
    above = windows(found, 3)[1]
    at = index_of(found, window)

    def move(content: Any) -> None:
        content["elements"].pop(index_of(found, above))
        now_at = at - (index_of(found, above) < at)
        content["elements"][now_at]["y_px"] = above.y_px

    done = after(found, move)
    assert len(window_sizes(done, 2)) == len(window_sizes(found, 2)) - 1
    assert len(window_sizes(done, 3)) == len(window_sizes(found, 3))
    assert windows(done, 3)[1].x_px == window.x_px


def test_a_new_window_stands_in_the_floor_that_holds_it(found: FacadeDocument) -> None:
    left, right = windows(found, 3)[:2]
    gap = (left.x_px + left.width_px + right.x_px) / 2

    def add(content: Any) -> None:
        sizes = {"x_px": gap - 4, "y_px": left.y_px, "width_px": 8, "height_px": left.height_px}
        metres = {"x_m": 1, "y_m": 1, "width_m": 1, "height_m": 1}
        content["elements"].append({"class": "window", **sizes, **metres, "score": 1})

    done = after(found, add)
    assert done.elements[-1].floor == 3
    assert window_sizes(done, 3)[1] == pytest.approx(8 * done.scale.metres_per_px)
    assert len(window_sizes(done, 3)) == len(window_sizes(found, 3)) + 1


def test_windows_that_overlap_share_the_width(found: FacadeDocument) -> None:
    window = windows(found, 1)[0]

    def double(content: Any) -> None:
        copy = dict(content["elements"][index_of(found, window)])
        content["elements"].append(copy | {"x_px": copy["x_px"] + copy["width_px"] / 2})

    done = after(found, double)
    assert window_sizes(done, 1)[:2] == pytest.approx([window.width_m, window.width_m / 2])


def test_the_ground_line_moves(found: FacadeDocument) -> None:
    def raise_it(content: Any) -> None:
        content["facade"]["height_px"] -= 20

    done = after(found, raise_it)
    sizes = list(found.rules.facade.sizes_m)
    sizes[0] -= 20 * done.scale.metres_per_px
    assert done.rules.facade.sizes_m == pytest.approx(sizes)
    assert done.rules.roof_height_m == found.rules.roof_height_m
    assert [e.floor for e in done.elements] == [e.floor for e in found.elements]


def test_the_eaves_move_up(found: FacadeDocument) -> None:
    def lift(content: Any) -> None:
        content["facade"]["y_px"] -= 12
        content["facade"]["height_px"] += 12

    done = after(found, lift)
    sizes = list(found.rules.facade.sizes_m)
    sizes[-1] += 12 * done.scale.metres_per_px
    assert done.rules.facade.sizes_m == pytest.approx(sizes)


@pytest.mark.parametrize("spare", [0.0, 0.3, -0.3])
def test_the_eaves_come_down_by_a_floor(found: FacadeDocument, spare: float) -> None:
    """By a little more or less than a floor, too: no sliver of it remains."""
    sizes, m = found.rules.facade.sizes_m, found.scale.metres_per_px
    down = (sizes[-1] + spare) / m

    def lower(content: Any) -> None:
        content["facade"]["y_px"] += down
        content["facade"]["height_px"] -= down

    done = after(found, lower)
    assert done.storeys == found.storeys - 1
    assert done.rules.facade.sizes_m == pytest.approx([*sizes[:-2], sizes[-2] - spare])
    in_roof = len(windows(found, None)) + len(windows(found, FLOORS))
    assert len(windows(done, None)) == in_roof


def test_the_height_of_the_roof(found: FacadeDocument) -> None:
    def raise_it(content: Any) -> None:
        content["rules"]["roof_height_m"] = 6.5

    done = after(found, raise_it)
    assert done.rules == found.rules.model_copy(update={"roof_height_m": 6.5})
    assert done.notes == [*found.notes, NOTE]


def test_a_boundary_between_floors(found: FacadeDocument) -> None:
    def move(content: Any) -> None:
        content["rules"]["facade"]["sizes_m"][1] += 0.2
        content["rules"]["facade"]["sizes_m"][2] -= 0.2

    expected = list(found.rules.facade.sizes_m)
    expected[1] += 0.2
    expected[2] -= 0.2
    done = after(found, move)
    assert done.rules.facade.sizes_m == expected
    assert done.rules.floors == found.rules.floors


def test_a_floor_is_parted_in_two(found: FacadeDocument) -> None:
    """Its windows, and those above, are then one floor up."""

    def part(content: Any) -> None:
        split = content["rules"]["facade"]
        size = split["sizes_m"][2]
        split["sizes_m"][2:3] = [0.1 * size, 0.9 * size]

    done = after(found, part)
    assert done.storeys == found.storeys + 1
    assert not done.storeys_doubtful
    assert window_sizes(done, 2) == []
    for floor in (2, 3, 4):
        assert window_sizes(done, floor + 1) == pytest.approx(window_sizes(found, floor))


def test_floors_that_do_not_add_up_are_refused(found: FacadeDocument, tmp_path: Path) -> None:
    def raise_it(content: Any) -> None:
        content["rules"]["facade"]["sizes_m"][1] += 0.4

    path = tmp_path / "facade.json"
    path.write_text(edited(found, raise_it).model_dump_json(by_alias=True))
    with pytest.raises(InputError, match=r"sizes_m: the floors are .* together, but the facade"):
        load_document(path)


def test_storeys_that_the_floors_are_not_are_refused(found: FacadeDocument, tmp_path: Path) -> None:
    path = tmp_path / "facade.json"
    wrong = edited(found, lambda content: content.update(storeys=found.storeys + 1))
    path.write_text(wrong.model_dump_json(by_alias=True))
    with pytest.raises(InputError, match=r"storeys: 6, but rules\.facade\.sizes_m has 5 floors"):
        load_document(path)


def test_the_scale_scales_everything(found: FacadeDocument) -> None:
    def double(content: Any) -> None:
        content["scale"]["metres_per_px"] *= 2

    done = after(found, double)
    assert done.rules.roof_height_m == pytest.approx(2 * found.rules.roof_height_m)
    twice = [2 * size for size in found.rules.facade.sizes_m]
    assert done.rules.facade.sizes_m == pytest.approx(twice)
    assert window_sizes(done, 1) == pytest.approx([2 * size for size in window_sizes(found, 1)])
    assert [e.floor for e in done.elements] == [e.floor for e in found.elements]
    assert (found.scale.basis, done.scale.basis) == ("assumed-storey", "edited")


def test_a_scale_that_moves_small_sizes_by_millimetres_is_told_once(
    found: FacadeDocument,
) -> None:
    def change(content: Any) -> None:
        content["scale"]["metres_per_px"] *= 0.99609375
        content["facade"]["height_px"] = 1.0

    done = after(found, change)
    for item in done.elements:
        assert item.width_m == pytest.approx(item.width_px * done.scale.metres_per_px, abs=1e-9)


def test_a_roof_that_was_edited_is_not_scaled(found: FacadeDocument) -> None:
    def change(content: Any) -> None:
        content["scale"]["metres_per_px"] *= 2
        content["rules"]["roof_height_m"] = 6.5

    assert after(found, change).rules.roof_height_m == 6.5


lengths = st.floats(0.5, 500.0)


@given(data=st.data())
def test_any_edit_agrees_in_the_end(found: FacadeDocument, data: st.DataObject) -> None:
    def change(content: Any) -> None:
        for name in data.draw(st.sets(st.sampled_from(["box", "scale", "roof", "windows"]))):
            if name == "scale":
                content["scale"]["metres_per_px"] *= data.draw(st.floats(0.2, 5.0))
            elif name == "roof":
                content["rules"]["roof_height_m"] = data.draw(st.floats(0.0, 9.0))
            elif name == "box":
                content["facade"]["y_px"] += data.draw(st.floats(-60.0, 200.0))
                content["facade"]["height_px"] = data.draw(lengths)
            else:
                for at in data.draw(st.sets(st.integers(0, len(content["elements"]) - 1))):
                    content["elements"][at]["y_px"] = data.draw(st.floats(-50.0, 900.0))
                    content["elements"][at]["x_px"] = data.draw(st.floats(-50.0, 600.0))
                    content["elements"][at]["width_px"] = data.draw(lengths)

    after(found, change)
