"""Every type of roof over 120 real outlines that other roof software fails on.

`benchmarks/measuring/roof_checks.py` says how they are judged; docs/roofs.md has the table.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from roof_checks import FOOTPRINTS, TYPES, faults, read_outlines, solid

from veduta import _core

pytestmark = pytest.mark.regression

EVERYWHERE = [kind for kind in TYPES if kind != "pyramid"]


def test_at_least_twelve_types_apply_everywhere() -> None:
    """The promise, before it is kept below."""
    assert len(EVERYWHERE) >= 12


@pytest.mark.parametrize("kind", EVERYWHERE)
def test_a_type_over_every_outline(veduta_data: Path, kind: str) -> None:
    """Closed, no place covered twice, as large from above as the outline; none fails."""
    path = veduta_data / FOOTPRINTS
    if not path.is_file():
        pytest.skip(f"no {path}")
    outlines = read_outlines(path)
    assert len(outlines) == 120
    rng = np.random.default_rng(7)
    wrong = {over.name: faults(solid(kind, over), over, rng) for over in outlines}
    assert not {name: why for name, why in wrong.items() if why}


def test_pyramids_stand_where_all_edges_are_seen(veduta_data: Path) -> None:
    """The others are refused with the reason, not built wrong."""
    path = veduta_data / FOOTPRINTS
    if not path.is_file():
        pytest.skip(f"no {path}")
    rng = np.random.default_rng(7)
    built = 0
    for over in read_outlines(path):
        try:
            made = solid("pyramid", over)
        except _core.RoofFault:
            with pytest.raises(_core.RoofFault, match="in sight of all edges"):
                solid("pyramid", over)
            continue
        built += 1
        assert not faults(made, over, rng), over.name
    assert built == 65
