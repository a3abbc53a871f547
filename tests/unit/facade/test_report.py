"""What the reports say of the sample facade, whose elements are counted by hand."""

from __future__ import annotations

import pytest
from sample_document import FACADE_M, METRES_PER_PX, PHOTO_PX, sample_document

from veduta.facade.report import adjusted_line, measures, summary_line


def test_a_sure_facade() -> None:
    found = measures(sample_document())
    assert (found["windows"], found["doubtful_windows"], found["doubtful_elements"]) == (20, 0, 0)
    width_px = FACADE_M[0] / METRES_PER_PX
    assert found["picture_share"] == pytest.approx(width_px / PHOTO_PX[0], abs=1e-3)
    assert summary_line(found) == (
        "5 storeys, 20 windows, 12.0 x 15.0 m (scale from the height given),"
        " 92 % of the picture's width"
    )


def test_doubt_is_told() -> None:
    document = sample_document()
    windows = [item for item in document.elements if item.class_ == "window"]
    windows[0].score = 0.49
    windows[1].provenance = "inferred"  # as what a person adds
    windows[2].score, windows[2].provenance = 0.2, "inferred"
    windows[3].score = 0.5
    balcony = next(item for item in document.elements if item.class_ == "balcony")
    balcony.score = 0.3
    found = measures(document)
    assert (found["doubtful_windows"], found["doubtful_elements"]) == (2, 3)
    line = summary_line(found)
    assert line.startswith("5 storeys, ")
    assert "20 windows (2 doubtful), 1 other element doubtful, 12.0" in line


def test_doubtful_storeys_are_told() -> None:
    document = sample_document()
    document.storeys_doubtful = True
    assert summary_line(measures(document)).startswith("5 storeys (doubtful), ")


@pytest.mark.parametrize(("off", "doubtful"), [(None, False), (1.4, False), (1.6, True)])
def test_doubtful_corners_are_told(off: float | None, doubtful: bool) -> None:
    document = sample_document()
    document.rectification.residual_deg = off
    assert not measures(document)["corners_doubtful"]  # nobody gave any
    document.rectification.method = "corners"
    found = measures(document)
    assert found["corners_doubtful"] == doubtful
    assert summary_line(found).endswith(", corners doubtful") == doubtful


def test_a_whole_picture_needs_no_word() -> None:
    found = measures(sample_document()) | {"picture_share": 1.0, "windows": 1, "storeys": 1}
    assert summary_line(found) == (
        "1 storey, 1 window, 12.0 x 15.0 m (scale from the height given)"
    )


def test_summaries_of_older_runs_are_told_too() -> None:
    old = {"storeys": 3, "windows": 4, "width_m": 5.0, "height_m": 9.0, "scale": "assumed"}
    assert summary_line(old) == "3 storeys, 4 windows, 5.0 x 9.0 m (scale assumed)"
    assert adjusted_line(old) == ""


@pytest.mark.parametrize(
    ("left_out", "clipped", "line"),
    [
        (0, 0, ""),
        (1, 0, "1 element left out of the model"),
        (3, 2, "3 elements left out of the model, 2 clipped"),
        (0, 1, "1 element clipped"),
    ],
)
def test_what_does_not_fit(left_out: int, clipped: int, line: str) -> None:
    assert adjusted_line({"left_out": left_out, "clipped": clipped}) == line
