"""A document made from the truth compares as perfect, and known errors as what they are."""

from __future__ import annotations

import functools

import numpy as np
import pytest

from veduta.facade.compare import compare, iou, match
from veduta.facade.document import (
    DerivationNode,
    Element,
    Extent,
    FacadeBox,
    FacadeDocument,
    Rectification,
    RuleParameters,
    Scale,
    Source,
    Split,
)
from veduta.geometry import homography
from veduta.synthetic.facade import SyntheticFacade, make_facade
from veduta.synthetic.options import SyntheticOptions
from veduta.synthetic.truth import TrueElement

METRES_PER_PX = 0.02
ABOVE_M = 3.0


@functools.cache
def made() -> SyntheticFacade:
    options = SyntheticOptions(style="modern", long_side_px=800, samples=1, detached=True)
    return make_facade(5, options)


def element(true: TrueElement, height_m: float, dx_m: float, dy_m: float) -> Element:
    r = true.visible
    x, y = r.x_m + dx_m, r.y_m + dy_m
    return Element.model_validate(
        {
            "class": true.label,
            "x_px": x / METRES_PER_PX,
            "y_px": (ABOVE_M + height_m - y - r.height_m) / METRES_PER_PX,
            "width_px": r.width_m / METRES_PER_PX,
            "height_px": r.height_m / METRES_PER_PX,
            "x_m": x,
            "y_m": y,
            "width_m": r.width_m,
            "height_m": r.height_m,
            "score": 1.0,
            "floor": true.floor,
            "column": true.column,
        }
    )


def perfect(dx_m: float = 0.0, dy_m: float = 0.0, drop: int = 0) -> FacadeDocument:
    """What a perfect reader writes; all elements shifted, or the first windows left out."""
    truth = made().truth
    width, height = truth.width_m / METRES_PER_PX, (truth.height_m + ABOVE_M) / METRES_PER_PX
    scale = 1.0 / METRES_PER_PX
    px_from_m = np.array(
        [[scale, 0, 0], [0, -scale, (truth.height_m + ABOVE_M) * scale], [0, 0, 1.0]]
    )
    rectified = homography.normalised(px_from_m @ np.linalg.inv(truth.photo_from_facade))
    top = ABOVE_M * scale
    root = DerivationNode(
        symbol="Facade", x_m=0, y_m=0, width_m=truth.width_m, height_m=truth.height_m
    )
    elements = [element(e, truth.height_m, dx_m, dy_m) for e in truth.elements]
    kept = [e for e in elements if e.class_ != "window"]
    windows = [e for e in elements if e.class_ == "window"]
    return FacadeDocument(
        source=Source(image="x.jpg", sha256="0", width_px=800, height_px=800),
        rectification=Rectification(
            method="corners",
            width_px=round(width),
            height_px=round(height),
            rectified_from_source=rectified.tolist(),
            aspect="focal-length",
        ),
        scale=Scale(metres_per_px=METRES_PER_PX, basis="height"),
        facade=FacadeBox(
            x_px=0,
            y_px=top,
            width_px=width,
            height_px=truth.height_m * scale,
            width_m=truth.width_m,
            height_m=truth.height_m,
        ),
        extents=[
            Extent.model_validate({"class": name, "polygon_px": polygon})
            for name, polygon in (
                ("sky", [(0, 0), (width, 0), (width, top), (0, top)]),
                ("wall", [(0, top), (width, top), (width, height), (0, height)]),
            )
        ],
        elements=kept + windows[drop:],
        storeys=truth.storeys,
        rules=RuleParameters(
            building_height_m=truth.height_m,
            roof_height_m=0,
            facade=Split(symbols=[], sizes_m=[]),
            floors=[],
        ),
        derivation=root,
        energy={},
    )


def test_a_perfect_document_is_perfect() -> None:
    result = compare(perfect(), made().truth)
    assert result.windows.precision == result.windows.recall == 1.0
    assert (result.windows.elsewhere, result.windows.cut_off, result.windows.missed) == (0, 0, ())
    assert result.storeys.found == result.storeys.true
    assert result.columns.found == result.columns.true
    assert result.off_m(1.0) < 1e-9
    assert result.accuracy > 0.985
    assert min(result.class_recall.values()) > 0.95
    assert 0.5 < result.compared <= 1.0


@pytest.mark.parametrize(("dx", "dy"), [(0.1, 0.0), (0.0, -0.2), (0.12, 0.16)])
def test_a_shift_is_measured_in_metres(dx: float, dy: float) -> None:
    result = compare(perfect(dx, dy), made().truth)
    assert result.windows.recall == 1.0
    np.testing.assert_allclose(result.corners_off_m, np.hypot(dx, dy), atol=1e-9)
    assert result.accuracy < compare(perfect(), made().truth).accuracy - 0.01


def test_a_shift_by_a_bay_matches_nothing_in_place() -> None:
    result = compare(perfect(1.2), made().truth)
    assert result.windows.matched == 0
    assert np.isnan(result.off_m(0.5))


def test_missing_windows_are_named() -> None:
    full = compare(perfect(), made().truth).windows
    result = compare(perfect(drop=3), made().truth).windows
    assert result.matched == full.matched - 3
    assert result.precision == 1.0
    assert len(result.missed) == 3
    assert all(name.startswith("floor 0 column") for name in result.missed)


def test_windows_beside_the_house_are_told_apart() -> None:
    result = compare(perfect(made().truth.width_m), made().truth).windows
    assert result.elsewhere == result.found
    assert result.precision == 0.0


def test_overlap_and_matching_by_hand() -> None:
    a, b = np.array([0.0, 0, 2, 2]), np.array([1.0, 0, 3, 2])
    assert iou(a, b) == pytest.approx(2 / 6)
    assert iou(a, a + 10) == 0.0
    nearly = np.add(a, [0.1, 0, 0.1, 0])
    assert match([nearly, a, b], [a]) == [(1, 0)]
    assert match([a], []) == []
