"""What a document may hold, and where in the file it says that something is wrong."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from veduta.facade.document import FacadeDocument, Shutter, Split
from veduta.facade.load import MAX_EXTENTS, MAX_PAINTED, MAX_POINTS, MAX_STRIPS, load_document
from veduta.run.errors import InputError

Make = Callable[..., FacadeDocument]
TRIANGLE = [(0.0, 0.0), (9.0, 0.0), (0.0, 9.0)]


def written(document: FacadeDocument, folder: Path) -> Path:
    """The document as a file."""
    path = folder / "facade.json"
    path.write_text(document.model_dump_json(by_alias=True), encoding="utf-8")
    return path


def fault_of(document: FacadeDocument, folder: Path) -> str:
    """What is said about a document that is refused."""
    path = written(document, folder)
    with pytest.raises(InputError) as caught:
        load_document(path)
    assert caught.value.subject == str(path)
    return caught.value.fault


def test_extents_are_counted(make_document: Make, tmp_path: Path) -> None:
    most = make_document(extents=[("sky", TRIANGLE)] * MAX_EXTENTS)
    assert len(load_document(written(most, tmp_path)).extents) == MAX_EXTENTS
    more = make_document(extents=[("sky", TRIANGLE)] * (MAX_EXTENTS + 1))
    assert fault_of(more, tmp_path) == f"extents: {MAX_EXTENTS + 1}, more than {MAX_EXTENTS}"


def test_points_are_counted_over_all_extents(make_document: Make, tmp_path: Path) -> None:
    many = TRIANGLE * (MAX_POINTS // 3 - 1)
    most = make_document(extents=[("sky", TRIANGLE), ("wall", many)])
    assert len(load_document(written(most, tmp_path)).extents) == 2
    more = make_document(extents=[("sky", TRIANGLE), ("wall", [*many, *TRIANGLE])])
    assert fault_of(more, tmp_path).startswith(f"extents[1].polygon_px: {len(many) + 3} points")


def test_shutters_are_counted(make_document: Make, tmp_path: Path) -> None:
    leaf = Shutter(kind="open", x_px=12.0, y_px=60.0, width_px=4.0, height_px=9.0, score=0.9)
    most = make_document().model_copy(update={"shutters": [leaf] * MAX_STRIPS})
    assert len(load_document(written(most, tmp_path)).shutters) == MAX_STRIPS
    more = most.model_copy(update={"shutters": [leaf] * (MAX_STRIPS + 1)})
    assert fault_of(more, tmp_path) == f"shutters: {MAX_STRIPS + 1}, more than {MAX_STRIPS}"


def test_how_often_elements_cover_the_picture(make_document: Make, tmp_path: Path) -> None:
    whole = ("window", (-50.0, -50.0, 1000.0, 1000.0))
    most = make_document(elements=[whole] * MAX_PAINTED)
    assert len(load_document(written(most, tmp_path)).elements) == MAX_PAINTED
    more = make_document(elements=[whole] * (MAX_PAINTED + 1))
    fault = f"elements: together they cover the picture {MAX_PAINTED + 1} times"
    assert fault_of(more, tmp_path).startswith(fault)


def test_classes_in_another_order(make_document: Make, tmp_path: Path) -> None:
    """labels.png would have other numbers than the docs say."""
    document = make_document()
    document.classes.reverse()
    fault = "classes: must be window, wall, balcony, door, roof, chimney, sky, shop, other, in this"
    assert fault_of(document, tmp_path) == f"{fault} order"


@pytest.mark.parametrize(
    ("place", "value", "fault"),
    [
        (("scale", "metres_per_px"), 20.0, "facade.width_px: 100 px of 20 m (scale.metres_per_px)"),
        (("scale", "metres_per_px"), 0.001, "facade.width_px: 100 px of 0.001 m"),
        (("facade", "height_px"), 30_000.0, "facade.height_px: 30000 px of 0.05 m"),
        (("rules", "roof_height_m"), -1.0, "rules.roof_height_m: -1 m"),
        (("rules", "roof_height_m"), 1001.0, "rules.roof_height_m: 1001 m"),
        (("rules", "roof_height_m"), 75.2, "rules.roof_height_m: 75.2 m, not between 0 and 75 m"),
    ],
)
def test_sizes_that_no_building_has(
    make_document: Make, tmp_path: Path, place: tuple[str, str], value: float, fault: str
) -> None:
    document = make_document()
    setattr(getattr(document, place[0]), place[1], value)
    assert fault_of(document, tmp_path).startswith(fault)


@pytest.mark.parametrize(
    ("change", "fault"),
    [
        ({"building_height_m": 0.0}, "rules.building_height_m: must be above zero"),
        ({"facade": ([], [])}, "rules.facade.sizes_m: needs 1 to 200 floors"),
        ({"facade": (["Gf"] * 201, [0.0] * 201)}, "rules.facade.sizes_m: needs 1 to 200 floors"),
        ({"facade": (["Gf", "Fl_1"], [8.5, -1.0])}, "rules.facade.sizes_m[1]: must not be neg"),
        ({"facade": (["Gf"], [4.0, 4.5])}, "rules.facade: has 1 symbols and 2 sizes_m"),
        ({"floors": [([], [1.0])]}, "rules.floors[0]: has 0 symbols and 1 sizes_m"),
        ({"floors": []}, "rules.floors: has 0 floors, and rules.facade"),
        ({"floors": [(["Wa"], [-5.0])]}, "rules.floors[0].sizes_m[0]: must not be negative"),
        ({"facade": (["Gf", "Fl_1"], [4.0, 4.0])}, "rules.facade.sizes_m: the floors are 8 m"),
    ],
)
def test_rules_that_cannot_be(
    make_document: Make, tmp_path: Path, change: dict[str, Any], fault: str
) -> None:
    document = make_document()
    for name, value in change.items():
        if name == "facade":
            value = Split(symbols=value[0], sizes_m=value[1])
        elif name == "floors":
            value = [Split(symbols=symbols, sizes_m=sizes) for symbols, sizes in value]
        setattr(document.rules, name, value)
    assert fault_of(document, tmp_path).startswith(fault)
