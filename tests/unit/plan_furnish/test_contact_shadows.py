"""Dark edges on the floor where furniture meets it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from sample_plan import rectangle, sample_plan, sample_storey
from shapely.geometry import Polygon, box

from veduta.formats.gltf import read_glb, write_glb
from veduta.place.part import Part
from veduta.place.semantics import DRAWN_ONLY, Provenance
from veduta.plan.document import Furniture
from veduta.plan.house.build import build_house
from veduta.plan.house.contact_shadows import LAYERS_M, LOOK
from veduta.plan.house.floors import FINISH_M
from veduta.plan.options import HouseOptions

NAME = LOOK.replace(" ", "-")


def _thing(
    kind: str, at: tuple[float, float], size: tuple[float, float, float], **more: object
) -> Furniture:
    values = {"id": f"{kind}{at[0]}", "object": kind, "room": "living", "at_m": at}
    return Furniture.model_validate({**values, "size_m": size, **more})


def _part(*things: Furniture) -> Part:
    storey = sample_storey(furniture=list(things))
    return build_house(sample_plan(storey), HouseOptions()).part


def _sheets(part: Part) -> list[tuple[Polygon, float, int]]:
    """The outline of each polygon of shadow, its height, and its feature."""
    own = {number for number, one in enumerate(part.materials) if one.name == NAME}
    found = []
    for polygon in np.flatnonzero(np.isin(part.polygon_material, list(own))).tolist():
        first, last = part.polygon_offsets[polygon : polygon + 2]
        rings = [
            part.positions_m[part.ring_offsets[k] : part.ring_offsets[k + 1]]
            for k in range(first, last)
        ]
        shape = Polygon(rings[0][:, :2], [ring[:, :2] for ring in rings[1:]])
        heights = np.concatenate(rings)[:, 2]
        assert np.ptp(heights) < 1e-6
        found.append((shape, float(heights[0]), int(part.polygon_feature[polygon])))
    return found


def test_what_stands_on_the_floor_has_a_soft_edge_around_it() -> None:
    part = _part(_thing("wardrobe-white", (2.0, 2.5), (1.0, 0.6, 2.0)))
    sheets = _sheets(part)
    reach = [max(abs(x - 2.0) for x, _ in shape.exterior.coords) - 0.5 for shape, _, _ in sheets]
    assert len(sheets) == len(LAYERS_M)
    assert sorted(reach) == pytest.approx(sorted(LAYERS_M), abs=0.012)
    heights = [height for _, height, _ in sheets]
    assert all(FINISH_M < height < FINISH_M + 0.003 for height in heights)
    # The widest lies lowest: none is hidden by one that is drawn over it.
    assert [one for _, one in sorted(zip(heights, reach, strict=True))] == sorted(reach)[::-1]


def test_it_is_invented_and_says_what_it_is() -> None:
    part = _part(_thing("wardrobe-white", (2.0, 2.5), (1.0, 0.6, 2.0)))
    (feature,) = {one for _, _, one in _sheets(part)}
    assert part.features.name[feature] == "ground floor living contact shadows"
    assert part.features.provenance_code[feature] == Provenance.INVENTED.code
    assert part.features.semantic(feature) in DRAWN_ONLY
    assert part.feature_area_m2[feature] == 0.0


def test_it_stays_in_its_room() -> None:
    """The wardrobe touches the wall, which is thinner than the shadow is wide."""
    part = _part(_thing("wardrobe-white", (4.64, 2.5), (0.6, 0.6, 2.0)))
    room = box(0.15, 0.15, 4.94, 4.85).buffer(1e-3)
    assert all(room.covers(shape) for shape, _, _ in _sheets(part))


def test_a_table_is_lighter_between_its_legs_than_at_them() -> None:
    part = _part(_thing("dining-table-oak", (2.0, 2.5), (1.6, 0.9, 0.74)))
    middle, leg = box(1.95, 2.45, 2.05, 2.55), box(1.2, 2.05, 2.8, 2.95)
    below = sum(shape.covers(middle) for shape, _, _ in _sheets(part))
    corners = sum(shape.intersects(leg) for shape, _, _ in _sheets(part))
    assert 1 <= below < len(LAYERS_M) <= corners


def test_what_stands_on_a_rug_casts_its_shadow_on_it_and_the_rug_none() -> None:
    rug = _thing("rug-bordered", (2.0, 2.5), (2.0, 1.4, 0.012))
    assert _sheets(_part(rug)) == []
    chest = _thing("wardrobe-white", (2.0, 2.5), (1.0, 0.6, 2.0))
    heights = [height for _, height, _ in _sheets(_part(rug, chest))]
    assert all(height > FINISH_M + 0.012 for height in heights)


def test_what_hangs_high_or_stands_on_a_thing_has_none() -> None:
    shelf = _thing("wardrobe-white", (2.0, 2.5), (0.3, 0.3, 0.3), above_m=0.9)
    box_on_it = _thing("wardrobe-white", (2.1, 2.5), (0.3, 0.3, 0.3), above_m=0.3, on=shelf.id)
    assert _sheets(_part(shelf, box_on_it)) == []


def test_what_hangs_low_has_a_wide_and_thin_one() -> None:
    """From .3 m on: as far as a part of what stands there, .1 m out and .1 m in, nothing dark."""
    sheets = _sheets(_part(_thing("wardrobe-white", (2.0, 2.5), (1.0, 0.6, 0.8), above_m=0.3)))
    reach = sorted(max(abs(x - 2.0) for x, _ in one.exterior.coords) - 0.5 for one, _, _ in sheets)
    assert 2 <= len(sheets) < len(LAYERS_M)
    assert reach[0] == pytest.approx(-0.1, abs=0.02)
    assert reach[-1] == pytest.approx(0.1, abs=0.02)


def test_a_file_says_how_thin_it_is(tmp_path: Path) -> None:
    write_glb(_part(_thing("wardrobe-white", (2.0, 2.5), (1.0, 0.6, 2.0))), tmp_path / "a.glb")
    (look,) = [one for one in read_glb(tmp_path / "a.glb").materials if one.name == NAME]
    assert look.opacity == pytest.approx(0.095)
    assert max(look.colour) < 0.1


def test_rooms_that_lie_apart_have_features_of_their_own() -> None:
    first = _thing("wardrobe-white", (2.0, 2.5), (1.0, 0.6, 2.0))
    other = _thing("wardrobe-white", (6.5, 2.5), (1.0, 0.6, 2.0), room="bath")
    part = _part(first, other)
    assert len({one for _, _, one in _sheets(part)}) == 2
    assert all(
        shape.intersection(Polygon(rectangle(5.0, 0.0, 5.06, 5.0))).is_empty
        for shape, _, _ in _sheets(part)
    )
