"""Dimensions of `plan.dxf` on houses that are no rectangles, by two readers."""

from __future__ import annotations

import io
import math
from pathlib import Path

import ezdxf
import numpy as np
import pytest
from sample_plan import DEPTH_M, OUTER_M, WIDTH_M, sample_plan, sample_storey, wall, window

from veduta.plan.document import Junction, Storey
from veduta.plan.drawing import Drawing, draw
from veduta.plan.house.build import build_house
from veduta.plan.options import HouseOptions
from veduta.plan.outputs.dxf import plan_dxf

HALF = OUTER_M / 2.0
EL = [(0.0, 0.0), (8.0, 0.0), (8.0, 3.7), (4.0, 3.7), (4.0, 6.2), (0.0, 6.2)]
"""Between centre lines: outer faces are 8.3 by 6.5 m, with pieces of 4.3 and 4, 4 and 2.5 m."""
YOU = [
    (0.0, 0.0), (9.0, 0.0), (9.0, 6.0), (6.0, 6.0),
    (6.0, 2.0), (3.5, 2.0), (3.5, 6.0), (0.0, 6.0),
]  # fmt: skip
"""9.3 by 6.3 m: legs of 3.8 and 3.3 m beside a court of 2.2 m, which is 4 m deep."""


def around(corners: list[tuple[float, float]], turn_rad: float = 0.0) -> Storey:
    """A storey of these outer walls alone, with a window in the first."""
    c, s = math.cos(turn_rad), math.sin(turn_rad)
    at = [(c * x - s * y, s * x + c * y) for x, y in corners]
    names = [f"j{row}" for row in range(len(at))]
    junctions = [Junction(id=n, at_m=place, type="L") for n, place in zip(names, at, strict=True)]
    walls = [wall(f"w{row}", name, names[(row + 1) % len(names)]) for row, name in enumerate(names)]
    return sample_storey(
        junctions=junctions, walls=walls, openings=[window("n1", "w0", 1.0, 1.2)], rooms=[]
    )


def drawing_of(storey: Storey) -> Drawing:
    (space,) = build_house(sample_plan(storey), HouseOptions()).spaces
    return draw(space)


def measured(content: bytes) -> list[float]:
    document = ezdxf.read(io.StringIO(content.decode()))
    assert not document.audit().errors
    return sorted(one.get_measurement() for one in document.modelspace().query("DIMENSION"))


SHAPES = [
    (EL, [2.5, 4.0, 4.0, 4.3, 6.5, 8.3]),
    (YOU, [2.2, 2.3, 3.3, 3.8, 4.0, 6.3, 9.3]),
]


@pytest.mark.parametrize(("corners", "pieces"), SHAPES)
def test_pieces_lie_between_outer_faces(
    corners: list[tuple[float, float]], pieces: list[float]
) -> None:
    content = plan_dxf([drawing_of(around(corners))])
    assert measured(content) == pytest.approx(pieces, abs=1e-3)


@pytest.mark.parametrize(("corners", "pieces"), SHAPES)
def test_a_house_askew_on_its_sheet_is_measured_along_its_walls(
    corners: list[tuple[float, float]], pieces: list[float]
) -> None:
    content = plan_dxf([drawing_of(around(corners, math.radians(20.0)))])
    assert measured(content) == pytest.approx(pieces, abs=1e-3)


def test_a_bow_has_no_corners_of_its_own() -> None:
    storey = around([(0.0, 0.0), (5.0, 0.0), (5.0, 4.0), (0.0, 4.0)])
    south, *others = storey.walls
    bowed = south.model_copy(update={"bulge": 0.25})
    drawing = drawing_of(storey.model_copy(update={"walls": [bowed, *others], "openings": []}))
    wide, high = np.ptp(np.concatenate(drawing.outlines_m), axis=0)
    *pieces, overall = measured(plan_dxf([drawing]))
    assert overall == pytest.approx(wide if wide > high else high, abs=1e-3)
    assert len(pieces) <= 5


def test_a_wall_that_is_a_little_thicker_makes_no_corner() -> None:
    storey = sample_storey()
    thick = {"south-1": OUTER_M + 0.06}
    walls = [
        one.model_copy(update={"thickness_m": thick.get(one.id, one.thickness_m)})
        for one in storey.walls
    ]
    found = measured(plan_dxf([drawing_of(storey.model_copy(update={"walls": walls}))]))
    assert found == pytest.approx([DEPTH_M + OUTER_M + 0.03, WIDTH_M + OUTER_M], abs=1e-3)


@pytest.mark.parametrize(("corners", "pieces"), SHAPES)
def test_a_second_reader_reads_the_same_sizes(
    corners: list[tuple[float, float]], pieces: list[float], tmp_path: Path
) -> None:
    pyogrio = pytest.importorskip("pyogrio")
    if "DXF" not in pyogrio.list_drivers():
        pytest.skip("this GDAL reads no DXF")
    path = tmp_path / "plan.dxf"
    path.write_bytes(plan_dxf([drawing_of(around(corners))]))
    meta, _, _, fields = pyogrio.raw.read(path, layer="entities")
    read = dict(zip(meta["fields"], fields, strict=True))
    texts = [
        text
        for layer, text in zip(read["Layer"], read["Text"], strict=True)
        if layer == "A-ANNO-DIMS" and text
    ]
    written_cm = sorted(float(text) for text in texts)
    assert written_cm == pytest.approx([100.0 * one for one in pieces], abs=0.5)


def test_blocks_ask_for_the_attributes_that_their_references_have() -> None:
    document = ezdxf.read(io.StringIO(plan_dxf([drawing_of(around(EL))]).decode()))
    (placed,) = document.modelspace().query("INSERT")
    asked = document.blocks.get(placed.dxf.name).query("ATTDEF")
    assert [one.dxf.tag for one in asked] == [one.dxf.tag for one in placed.attribs]
    assert {one.dxf.tag for one in asked} == {"ID", "TYPE", "WIDTH"}
    assert all(one.is_invisible for one in asked)
