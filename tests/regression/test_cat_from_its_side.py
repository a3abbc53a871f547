"""Bounds on a real animal with legs: the walking cat, of which the fit sees the left side alone."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "benchmarks" / "fauna"))

from cat_views import cat_rows

pytestmark = pytest.mark.regression


def test_the_cat_from_its_side_and_from_views_that_were_not_given(
    veduta_data: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("cat_views.DATA", veduta_data)
    found = {str(row["what"]): row["value"] for row in cat_rows()}
    values = {name.split(": ")[1]: float(value or 0.0) for name, value in found.items()}
    views = [value for name, value in values.items() if name.startswith("IoU")]
    assert len(views) == 4
    side, *others = views
    assert 0.86 <= side <= 0.97
    assert min(others[:2]) >= 0.8
    assert 0.72 <= others[2] <= 0.95
    assert values["frames in which the chart of a foot is right"] >= 0.85
    assert values["cycle off by"] <= 0.03
    assert values["a standing foot in the clip slides or sinks (lengths)"] <= 0.01
    assert np.isfinite(list(values.values())).all()
