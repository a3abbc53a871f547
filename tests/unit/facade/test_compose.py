"""What the steps found, in a document: metres agree with pixels, extents with the skyline."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from drawn_facade import analysed, draw_facade, rectified_of
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from veduta.facade.boxes import Box
from veduta.facade.columns import Columns
from veduta.facade.compose import Parse, compose
from veduta.facade.document import CLASSES, FacadeDocument, Source
from veduta.facade.evidence import Evidence, gather
from veduta.facade.extent import Skyline
from veduta.facade.floors import Floors
from veduta.facade.options import FacadeOptions, ScaleOptions
from veduta.facade.outputs import rasterise
from veduta.facade.plausible import HARDLY_ALIKE
from veduta.facade.scale import ASSUMED_STOREY_M, metres
from veduta.facade.sides import Sides
from veduta.run.errors import InputError

BOUNDARIES = [60, 110, 165, 210]
BOXES = [
    Box("window", 20, 75, 22, 25, 3, 0, 0.9),
    Box("window", 90, 75, 22, 25, 3, 1, 0.4),
    Box("balcony", 18, 92, 26, 12, 3, None, 0.7),
    Box("door", 40, 240, 20, 60, 0, None, 0.5),
]


def _document(
    skyline: NDArray[np.int64],
    sides: Sides,
    scale: ScaleOptions | None = None,
    size: tuple[int, int] = (160, 300),
    doubts: tuple[str, ...] = (),
    no_sky: str = "",
    evidence: Evidence | None = None,
) -> FacadeDocument:
    """A document of hand-made finds; all but the skyline count from the left side."""
    width, height = size
    rectified = rectified_of(np.zeros((height, width, 3), np.uint8))
    cut = skyline[sides.left : sides.right]
    parse = Parse(
        evidence=evidence or gather(rectified.pixels, rectified.valid),
        sky=Skyline(skyline, int(np.median(skyline))),
        skyline=Skyline(cut, int(np.median(cut)), no_sky),
        sides=sides,
        floors=Floors(BOUNDARIES, 50.0, -1.5, {"similarity": -1.5}, 100),
        columns=Columns([(20, 22), (90, 22)], -0.5, {}, 50),
        boxes=BOXES,
        doubts=list(doubts),
    )
    source = Source(image="a.png", sha256="0" * 64, width_px=width, height_px=height)
    return compose(parse, rectified, source, FacadeOptions(scale=scale or ScaleOptions()))


skylines = st.lists(st.integers(5, 55), min_size=160, max_size=160).map(np.array)


@given(skylines, st.integers(0, 15), st.integers(130, 160), st.integers(280, 300))
def test_metres_agree_with_pixels(
    skyline: NDArray[np.int64], left: int, right: int, bottom: int
) -> None:
    document = _document(skyline, Sides(left, right, bottom))
    facade, m = document.facade, document.scale.metres_per_px
    assert (facade.x_px, facade.y_px) == (left, BOUNDARIES[0])
    assert (facade.x_px + facade.width_px, facade.y_px + facade.height_px) == (right, bottom)
    assert facade.width_m == pytest.approx(facade.width_px * m)
    assert facade.height_m == pytest.approx(facade.height_px * m)
    assert len(document.elements) == len(BOXES)
    for element, box in zip(document.elements, BOXES, strict=True):
        assert (element.class_, element.floor, element.column) == (box.kind, box.floor, box.column)
        assert (element.x_px, element.y_px) == (left + box.x, box.y)
        assert element.x_m == pytest.approx(box.x * m)
        assert element.y_m == pytest.approx((bottom - element.y_px - element.height_px) * m)
        assert element.width_m == pytest.approx(element.width_px * m)
        assert element.height_m == pytest.approx(element.height_px * m)
        assert element.y_m >= -1e-9


@given(skylines, st.integers(0, 15), st.integers(130, 160), st.integers(280, 300))
def test_extents_paint_what_was_found(
    skyline: NDArray[np.int64], left: int, right: int, bottom: int
) -> None:
    """Painted pixel by pixel: surroundings, roof, wall, sky down to the skyline, boxes."""
    document = _document(skyline, Sides(left, right, bottom))
    true = np.full((300, 160), CLASSES.index("other"))
    true[: BOUNDARIES[0], left:right] = CLASSES.index("roof")
    true[BOUNDARIES[0] : bottom, left:right] = CLASSES.index("wall")
    true[np.arange(300)[:, None] < skyline[None]] = CLASSES.index("sky")
    for box in BOXES:
        columns = slice(left + box.x, min(right, left + box.x + box.width))
        true[box.y : min(bottom, box.y + box.height), columns] = CLASSES.index(box.kind)
    assert (rasterise(document) == true).all()


long_edges, ratios = st.integers(721, 2000), st.floats(0.5, 1.0)


@settings(max_examples=20)
@given(long_edges, ratios, st.booleans())
def test_the_edges_of_the_picture_are_reached(long: int, ratio: float, upright: bool) -> None:
    """The analysis image has whole pixels: its last is not the last but one of the photo's."""
    short = round(long * ratio)
    width, height = size = (short, long) if upright else (long, short)
    whole = gather(np.zeros((height, width, 3), np.uint8), np.ones((height, width), bool))
    sides = Sides(0, whole.width, whole.height)
    document = _document(np.full(whole.width, 20), sides, size=size, evidence=whole)
    facade = document.facade
    assert (facade.x_px, facade.x_px + facade.width_px) == (0, pytest.approx(width))
    assert facade.y_px + facade.height_px == pytest.approx(height)
    labels = rasterise(document)
    assert (labels != CLASSES.index("other")).all()
    for element, box in zip(document.elements, BOXES, strict=True):
        assert element.x_px == pytest.approx(box.x * width / whole.width, abs=0.01)
        assert element.y_px == pytest.approx(box.y * height / whole.height, abs=0.01)


def test_doubts_about_the_storeys_are_noted() -> None:
    document = _document(np.full(160, 20), Sides(0, 160, 300))
    assert not document.storeys_doubtful
    assert HARDLY_ALIKE not in document.notes
    unlike = _document(np.full(160, 20), Sides(0, 160, 300), doubts=(HARDLY_ALIKE,))
    assert unlike.storeys_doubtful
    assert HARDLY_ALIKE in unlike.notes


def test_a_roof_without_sky_above_it_is_inferred() -> None:
    for reason, wanted in (("", "measured"), ("the upper edge is textured", "inferred")):
        document = _document(np.full(160, 20), Sides(0, 160, 300), no_sky=reason)
        provenance = {extent.class_: extent.provenance for extent in document.extents}
        assert provenance["roof"] == wanted
        assert provenance["wall"] == "measured"
        assert any("are inferred" in note for note in document.notes) == bool(reason)


def test_what_the_photo_speaks_against_is_inferred() -> None:
    document = _document(np.full(160, 20), Sides(0, 160, 300))
    found = [element.provenance for element in document.elements]
    assert found == ["measured", "inferred", "measured", "measured"]


def test_energies_and_storeys() -> None:
    document = _document(np.full(160, 20), Sides(0, 160, 300))
    assert document.storeys == len(BOUNDARIES)
    floors, columns = document.energy["floors"], document.energy["columns"]
    assert (floors.total, floors.nodes, floors.labels) == (-1.5, 3, 100)
    assert (columns.total, columns.nodes, columns.labels) == (-0.5, 2, 50)


def test_the_analysis_resolution_drops_out() -> None:
    """The same drawing at twice the size is the same building."""
    drawn = draw_facade(5)
    large = np.repeat(np.repeat(drawn.pixels, 2, axis=0), 2, axis=1)
    document = analysed(large)
    assert document.rectification.height_px == 2 * len(drawn.pixels)
    assert document.storeys == drawn.storeys
    assert document.facade.y_px == pytest.approx(2 * drawn.boundaries[0], abs=12)
    windows = [e for e in document.elements if e.class_ == "window" and e.floor]
    assert len(windows) == len(drawn.windows)
    lefts = sorted({round(e.column or 0): e.x_px for e in windows}.values())
    assert lefts == pytest.approx([2 * x for x, _ in drawn.stripes], abs=8)


@pytest.mark.parametrize(
    ("options", "basis", "expected"),
    [
        (ScaleOptions(height_m=20.0), "height", 20.0 / (300 - 60)),
        (ScaleOptions(storey_m=3.6), "storey", 3.6 / 50),
        (ScaleOptions(), "assumed-storey", ASSUMED_STOREY_M / 50),
        (ScaleOptions(height_m=20.0, storey_m=3.6), "height", 20.0 / (300 - 60)),
    ],
)
def test_scale_bases(options: ScaleOptions, basis: str, expected: float) -> None:
    rows = [float(b) for b in BOUNDARIES]
    assert np.mean(np.diff(rows)) == 50.0
    scale = metres(rows, 300.0, options)
    assert (scale.basis, scale.metres_per_px) == (basis, pytest.approx(expected))
    document = _document(np.full(160, 20), Sides(0, 160, 300), options)
    assert document.scale == scale
    assert any("assumed" in note for note in document.notes) == (basis == "assumed-storey")


def test_a_size_that_no_facade_has() -> None:
    with pytest.raises(ValueError, match="less than or equal to 1000"):
        ScaleOptions(height_m=5000.0)
    unchecked = ScaleOptions.model_construct(height_m=5000.0, storey_m=None)
    with pytest.raises(InputError, match="--height-m: makes the facade 5000 m high"):
        _document(np.full(160, 20), Sides(0, 160, 300), unchecked)


def test_what_was_given_comes_out() -> None:
    drawn = draw_facade(4)
    tall = analysed(drawn.pixels, ScaleOptions(height_m=17.5))
    assert tall.facade.height_m == pytest.approx(17.5)
    storey = analysed(drawn.pixels, ScaleOptions(storey_m=3.3))
    assert np.mean(storey.rules.facade.sizes_m[1:]) == pytest.approx(3.3)
    widths = [d.facade.width_m / d.scale.metres_per_px for d in (tall, storey)]
    assert widths == pytest.approx([drawn.pixels.shape[1]] * 2)
    pairs = itertools.zip_longest(tall.elements, storey.elements)
    assert all((a.x_px, a.y_px) == (b.x_px, b.y_px) for a, b in pairs)


def test_why_there_is_no_sky_is_noted() -> None:
    sides = Sides(0, 160, 300, ("left of it: a neighbour",))
    document = _document(np.zeros(160, np.int64), sides)
    assert all(extent.class_ != "sky" for extent in document.extents)
    assert "left of it: a neighbour" in document.notes
