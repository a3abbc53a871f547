"""The styles as closed volumes (LoD 2.2 of CityJSON), against sums over their faces."""

from __future__ import annotations

import json
from collections import Counter
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from test_styles import LOTS, Ring, ring, rules_of

from veduta import _core
from veduta.formats.cityjson_text import CLASSES, KINDS
from veduta.grammar.levels import PANELS, VOLUME
from veduta.grammar.outline import Attribute
from veduta.grammar.rules import style_names

SEEDS = 3
MM = 1e-3
Faces = list[list[NDArray[np.float64]]]


def volumes_of(style: str, rings: list[Ring], given: dict[str, Attribute]) -> list[Faces | None]:
    """The faces of the LoD 2.2 solid for each seed, rings as (n, 3) in metres; None without one."""
    derived = [
        _core.derive_lots(
            rules_of(style),
            [rings] * SEEDS,
            list(range(SEEDS)),
            attributes=[given | {"LOD": level}] * SEEDS,
            edits=[[]] * SEEDS,
        )
        for level in (PANELS, VOLUME)
    ]
    found = []
    for row in range(SEEDS):
        body, _, vertices, _ = derived[0].city(
            row, (0.0, 0.0, 0.0), CLASSES, KINDS, volumes=derived[1]
        )
        points = np.array(json.loads(vertices)) * MM
        geometries: list[dict[str, Any]] = json.loads(f"[{body}]")
        shells = [one["boundaries"][0] for one in geometries if one["lod"] == "2.2"]
        assert len(shells) <= 1
        found.append([[points[ring] for ring in face] for face in shells[0]] if shells else None)
    return found


def area_vector(rings: list[NDArray[np.float64]]) -> NDArray[np.float64]:
    """The area of a face along its normal (m2): half the sum of the cross products of its edges."""
    total: NDArray[np.float64] = sum(
        (np.cross(ring, np.roll(ring, -1, axis=0)).sum(axis=0) / 2 for ring in rings), np.zeros(3)
    )
    return total


def volume_m3(faces: Faces) -> float:
    """The divergence theorem: a third of the sum of place times area vector."""
    return float(sum(rings[0][0] @ area_vector(rings) for rings in faces)) / 3


def map_area_m2(rings: list[Ring]) -> float:
    return float(area_vector([np.array(one) for one in rings])[2])


def assert_closed(faces: Faces) -> None:
    """Each edge is there once each way, so that two faces meet at it."""
    edges: Counter[tuple[bytes, bytes]] = Counter()
    for own in (one for rings in faces for one in rings):
        ends = [point.tobytes() for point in own + 0.0]
        edges.update(zip(ends, [*ends[1:], ends[0]], strict=True))
    assert set(edges.values()) == {1}
    assert all((to, start) in edges for start, to in edges)


@pytest.mark.parametrize("style", style_names())
@pytest.mark.parametrize("name", LOTS)
def test_a_building_has_a_closed_volume_over_its_ground(style: str, name: str) -> None:
    given: dict[str, Attribute] = {"withGarage": False} if style == "suburban-house" else {}
    for faces in volumes_of(style, LOTS[name], given):
        assert faces is not None
        assert_closed(faces)
        top = sum(max(area_vector(rings)[2], 0.0) for rings in faces)
        foot = sum(max(-area_vector(rings)[2], 0.0) for rings in faces)
        assert top == pytest.approx(foot, rel=1e-4)
        if style != "suburban-house":  # it leaves a garden
            assert foot == pytest.approx(map_area_m2(LOTS[name]), rel=1e-3)
        assert volume_m3(faces) > 2 * foot


def test_a_flat_roof_lies_behind_its_parapet() -> None:
    lot = [ring((0, 0), (14, 0), (14, 12), (0, 12))]
    inside = 13.5 * 11.5
    for faces in volumes_of("modern-slab", lot, {"height": 19}):
        assert faces is not None
        assert volume_m3(faces) == pytest.approx(168 * 19 - inside * 0.6, rel=1e-4)


def test_a_gable_roof_has_no_eaves_from_afar() -> None:
    """A rectangle of 14 x 9 m under a roof of 30 degrees: half of its box."""
    lot = [ring((0, 0), (14, 0), (14, 9), (0, 9))]
    given: dict[str, Attribute] = {"height": 8, "roof": "gable", "roofAngle": 30}
    roof = min(4.0, (8 - 2.3) * 0.55)
    rise = min(np.tan(np.radians(30)), roof * 46 / (2 * 126)) * 4.5
    for faces in volumes_of("suburban-house", lot, given):
        assert faces is not None
        assert volume_m3(faces) == pytest.approx(126 * (8 - roof) + 126 * rise / 2, rel=1e-3)
