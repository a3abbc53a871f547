"""Lots of a real city model: every building stands on the ground that the file gives it."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from veduta.grammar.lots import read_lots

pytestmark = pytest.mark.regression


def test_delft(veduta_data: Path) -> None:
    """160 buildings of LoD1, prisms without a bottom: their tops are the oracle of the areas."""
    path = veduta_data / "city" / "delft.json"
    if not path.is_file():
        pytest.skip(f"no {path}")
    found = read_lots(path)
    assert (found.crs, len(found.lots), len(found.failures)) == ("EPSG:7415", 160, 0)
    document = json.loads(path.read_text())
    points = np.array(document["vertices"]) * document["transform"]["scale"]
    for lot in found.lots:
        (shell,) = document["CityObjects"][lot.name]["geometry"][0]["boundaries"]
        corners = points[np.array([face[0] for face in shell])]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2
        level = np.linalg.norm(normals[:, :2], axis=1) < 0.1 * np.abs(normals[:, 2])
        top = float(normals[level, 2].sum())
        x, y = np.concatenate(lot.rings_m[:1]).T
        built = 0.5 * float(x @ np.roll(y, -1) - y @ np.roll(x, -1))
        for hole in lot.rings_m[1:]:
            x, y = hole.T
            built += 0.5 * float(x @ np.roll(y, -1) - y @ np.roll(x, -1))
        assert built == pytest.approx(top, abs=0.01)
