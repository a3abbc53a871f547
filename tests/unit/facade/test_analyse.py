"""The whole analysis on facades that the tests draw: floors, columns and rectangles come back."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from drawn_facade import DrawnFacade, analysed, draw_facade, rectified_of

from veduta.facade.analyse_plain import analyse_plain
from veduta.facade.document import Element, FacadeDocument, Source
from veduta.facade.options import FacadeOptions
from veduta.run.errors import NotFoundError

CASES = [(floors, shadow, floors) for floors in range(2, 8) for shadow in (False, True)]


def _windows(document: FacadeDocument) -> list[list[Element]]:
    """The windows of each floor below the eaves, from the eaves down and from left to right."""
    floors = range(document.storeys - 1, 0, -1)
    found = [e for e in document.elements if e.class_ == "window"]
    return [sorted((e for e in found if e.floor == f), key=lambda e: e.x_px) for f in floors]


def _floor_lines(document: FacadeDocument) -> list[float]:
    """Rows from the eaves to the ground floor's top (pixels), from the rule's sizes in metres."""
    heights = document.rules.facade.sizes_m[:0:-1]
    steps = np.array([0.0, *heights]) / document.scale.metres_per_px
    return (document.facade.y_px + np.cumsum(steps)).tolist()


@pytest.mark.parametrize(("floors", "shadow", "seed"), CASES)
def test_a_drawn_facade_comes_back(floors: int, shadow: bool, seed: int) -> None:
    drawn = draw_facade(floors, shadow=shadow, seed=seed)
    document = analysed(drawn.pixels)
    assert document.storeys == drawn.storeys
    _lines_run_between_windows(document, drawn)
    _windows_come_back(document, drawn)
    _energy_is_stated(document, drawn)
    assert document.scale.basis == "assumed-storey"
    true_scale = 3.0 * floors / (drawn.boundaries[-1] - drawn.boundaries[0])
    assert document.scale.metres_per_px == pytest.approx(true_scale, rel=0.04)


def test_corners_that_were_named_are_the_facade() -> None:
    """A neighbour is cut off where nobody has said what the facade is, and only there."""
    drawn = draw_facade(4).pixels
    height, width = drawn.shape[:2]
    neighbour = np.full((height, width // 2, 3), (120, 60, 50), np.uint8)
    pixels = np.concatenate([drawn, neighbour], axis=1)
    found = rectified_of(pixels)
    source = Source(image="a.png", sha256="0" * 64, width_px=1, height_px=1)
    for method, share in (("rectified", 2 / 3), ("corners", 1.0)):
        record = found.record.model_copy(update={"method": method})
        document, _ = analyse_plain(replace(found, record=record), source, FacadeOptions())
        taken = document.facade.width_px / record.width_px
        assert taken == pytest.approx(share, abs=0.03)


def _lines_run_between_windows(document: FacadeDocument, drawn: DrawnFacade) -> None:
    lines = _floor_lines(document)
    storey = (drawn.boundaries[-1] - drawn.boundaries[0]) / (drawn.storeys - 1)
    assert abs(lines[0] - drawn.boundaries[0]) <= max(4, 0.08 * storey)
    columns = len(drawn.stripes)
    rows = [drawn.windows[i * columns] for i in range(drawn.storeys - 1)]
    for line, (_, y, _, h) in zip(lines[1:], rows, strict=True):
        assert line >= y + h - 2
    for line, (_, y, _, _) in zip(lines[:-1], rows, strict=True):
        assert line <= y + 2


def _windows_come_back(document: FacadeDocument, drawn: DrawnFacade) -> None:
    floors = _windows(document)
    assert [len(floor) for floor in floors] == [len(drawn.stripes)] * len(floors)
    found = np.array(
        [(e.x_px, e.y_px, e.x_px + e.width_px, e.y_px + e.height_px) for f in floors for e in f]
    )
    true = np.array([(x, y, x + w, y + h) for x, y, w, h in drawn.windows])
    storey = (drawn.boundaries[-1] - drawn.boundaries[0]) / (drawn.storeys - 1)
    off = np.abs(found - true)
    assert np.median(off) <= 2.5
    assert np.quantile(off[:, :3], 0.9) <= max(3.0, 0.05 * storey)
    # Below the lower edge there is a ledge, which may be taken for a railing in front of it.
    assert np.quantile(off[:, 3], 0.9) <= max(4.5, 0.08 * storey)


def _energy_is_stated(document: FacadeDocument, drawn: DrawnFacade) -> None:
    assert set(document.energy) == {"floors", "columns"}
    for name, nodes in [("floors", drawn.storeys - 1), ("columns", len(drawn.stripes))]:
        term = document.energy[name]
        assert math.isfinite(term.total)
        assert term.total < 0, "better than what is nothing alike"
        assert term.nodes == nodes
        assert term.labels > 100
        assert len(term.terms) == 5
        assert sum(term.terms.values()) == pytest.approx(term.total, abs=1e-6)


def test_the_same_picture_gives_the_same_document() -> None:
    drawn = draw_facade(4)
    assert analysed(drawn.pixels) == analysed(drawn.pixels.copy())


def test_plain_and_noisy_pictures_hold_no_facade() -> None:
    rng = np.random.default_rng(0)
    noise = rng.integers(0, 256, (500, 400, 3)).astype(np.uint8)
    for pixels in (noise, np.full((500, 400, 3), 127, np.uint8)):
        with pytest.raises(NotFoundError):
            analysed(pixels)


def test_next_to_no_photo_holds_no_facade() -> None:
    drawn = draw_facade(4)
    rectified = rectified_of(drawn.pixels)
    height, width = drawn.pixels.shape[:2]
    source = Source(image="drawn.png", sha256="0" * 64, width_px=width, height_px=height)
    rectified.valid[:, : round(0.95 * width)] = False
    with pytest.raises(NotFoundError, match="facade"):
        analyse_plain(rectified, source, FacadeOptions())
