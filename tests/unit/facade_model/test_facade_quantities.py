"""Counts and areas of a front, against sums by hand."""

from __future__ import annotations

import csv
import io

import numpy as np
from sample_document import element, sample_document, sample_photo

from veduta.facade.model import build_part
from veduta.facade.quantities import quantities, quantities_csv


def test_windows_to_wall_counts_overlaps_once() -> None:
    one, other = element("window", 1.0, 4.0, 1.0, 2.0), element("window", 1.5, 4.0, 1.0, 2.0)
    document = sample_document([one, other, element("door", 4.0, 0.0, 1.0, 2.0)])
    found = quantities(document)
    front = document.facade.width_m * document.facade.height_m
    assert np.isclose(found.front_m2, front)
    assert np.isclose(found.window_to_wall, 3.0 / front)
    assert np.isclose(found.glazed, 5.0 / front)
    assert np.isclose(found.wall_m2, front - 5.0)
    assert quantities(sample_document([])).window_to_wall == 0.0


def test_the_table_has_each_kind_and_each_surface() -> None:
    elements = [element("window", 1.0, 4.0, 1.0, 2.0), element("window", 3.0, 4.0, 1.2, 2.0)]
    document = sample_document(elements)
    part = build_part(document, sample_photo(document), "house")
    rows = list(csv.DictReader(io.StringIO(quantities_csv(document, part))))
    windows = next(row for row in rows if (row["what"], row["floor"]) == ("window", "all"))
    assert windows["count"] == "2"
    assert float(windows["area_m2"]) == 4.4
    assert float(windows["mean_width_m"]) == 1.1
    surfaces = {row["what"]: float(row["area_m2"]) for row in rows if ":" in row["what"]}
    assert surfaces["surface: wall"] > 0
    assert np.isclose(sum(surfaces.values()), part.feature_area_m2.sum(), atol=0.01)
