"""The catalogue: every row can be built, and what it claims of its shape is so."""

from __future__ import annotations

import sqlite3
from pathlib import Path

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from sample_plan import sample_plan

from veduta.plan.call import plan_call
from veduta.plan.furnish.catalogue.digest import catalogue_digests
from veduta.plan.furnish.catalogue.entry import Entry, Size
from veduta.plan.furnish.catalogue.read import builtin_catalogue, catalogue_of
from veduta.plan.furnish.furnish import GROUPS, furnish
from veduta.plan.furnish.models.build import BUILDERS
from veduta.plan.furnish.shapes import asset_of
from veduta.plan.furnish.upon import UPON
from veduta.plan.house.build import build_house
from veduta.plan.options import HouseOptions, PlanOptions
from veduta.plan.pipeline import result_key_of
from veduta.run.errors import InputError

CATALOGUE = builtin_catalogue()
NAMES = sorted(CATALOGUE.entries)


def mesh_of(entry: Entry, size: Size, *, coarse: bool) -> trimesh.Trimesh:
    """Its mesh, z up, front to -y."""
    shared = asset_of(entry, size, CATALOGUE, coarse=coarse).shared_mesh
    return trimesh.Trimesh(shared.positions_m, shared.indices, process=False)


def test_the_catalogue_hangs_together() -> None:
    types = {entry.type for entry in CATALOGUE.entries.values()}
    assert len(CATALOGUE.entries) >= 120
    for entry in CATALOGUE.entries.values():
        assert entry.model in BUILDERS
        assert set(entry.finishes.values()) <= set(CATALOGUE.finishes)
    known = types | set(GROUPS)
    assert {one.type for one in CATALOGUE.wanted} <= known
    assert set(CATALOGUE.smaller) | set(CATALOGUE.smaller.values()) <= known
    assert set(UPON) <= types
    assert {kind for row in UPON.values() for kind, _, _ in row} <= types


@settings(max_examples=12, deadline=None)
@given(name=st.sampled_from(NAMES), share=st.floats(0.0, 1.0), coarse=st.booleans())
def test_an_object_fills_its_box_at_any_size(name: str, share: float, coarse: bool) -> None:
    entry = CATALOGUE.entries[name]
    size = entry.sized(*(low + share * (high - low) for low, high in (entry.widths_m,
                                                                     entry.depths_m)))  # fmt: skip
    mesh = mesh_of(entry, size, coarse=coarse)
    half = np.array([size[0] / 2, size[1] / 2])
    assert mesh.bounds[0] == pytest.approx([*-half, 0.0], abs=1e-5)
    assert mesh.bounds[1] == pytest.approx([*half, size[2]], abs=1e-5)


@pytest.mark.parametrize("kind", ["desk", "nightstand", "tv-bench", "dining-table", "chest"])
def test_things_on_an_object_rest_on_its_shape(kind: str) -> None:
    """A ray from above meets it where its surface is said to be."""
    entry = CATALOGUE.of_type(kind)[0]
    width, depth, height = entry.size_m
    corners = mesh_of(entry, entry.size_m, coarse=True).triangles
    for surface in entry.surfaces:
        for x, y in ((surface.left, surface.front), (surface.right, surface.back)):
            at = np.array([(x - 0.5) * width, (y - 0.5) * depth])
            assert top_at(corners, at) == pytest.approx(surface.height * height, abs=0.012)


def top_at(corners: np.ndarray, at: np.ndarray) -> float:
    """The highest point of triangles (n, 3, 3) above a place (2,), by barycentric weights."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    u, v, w = (b - a)[:, :2], (c - a)[:, :2], at - a[:, :2]
    area = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    flat = np.abs(area) > 1e-9
    safe = np.where(flat, area, 1.0)
    s = (w[:, 0] * v[:, 1] - w[:, 1] * v[:, 0]) / safe
    t = (u[:, 0] * w[:, 1] - u[:, 1] * w[:, 0]) / safe
    inside = flat & (s >= -1e-6) & (t >= -1e-6) & (s + t <= 1.0 + 1e-6)
    heights = a[:, 2] + s * (b - a)[:, 2] + t * (c - a)[:, 2]
    return float(heights[inside].max())


def own_catalogue(folder: Path, file: str = "seat.glb") -> Path:
    """A catalogue with one sofa, a box of 2 x 1 x 1 m as GLB."""
    folder.mkdir(exist_ok=True)
    trimesh.creation.box((2.0, 1.0, 1.0)).export(folder / "seat.glb")
    schema = Path(str(builtin_schema())).read_text(encoding="utf-8")
    path = folder / "mine.sqlite"
    with sqlite3.connect(path) as base:
        base.executescript(schema)
        base.execute(
            "INSERT INTO object (name, type, class, file, width_m, depth_m, height_m, walls)"
            " VALUES ('my-sofa', 'sofa', 'seat', ?, 1.6, 0.8, 0.8, 'back')",
            (file,),
        )
    base.close()
    return path


def builtin_schema() -> Path:
    """Where the tables are declared."""
    import veduta.plan.furnish.catalogue as package

    return Path(package.__file__).with_name("schema.sql")


def test_objects_of_a_users_own_are_used_at_their_size(tmp_path: Path) -> None:
    path = own_catalogue(tmp_path)
    catalogue = catalogue_of(path)
    assert len(catalogue_digests(path, catalogue)) == 2
    entry = catalogue.entries["my-sofa"]
    asset = asset_of(entry, entry.size_m, catalogue)
    assert np.ptp(asset.points_m, axis=0) == pytest.approx([1.6, 0.8, 0.8])
    for seed in range(12):
        document, _ = furnish(sample_plan(), catalogue, seed, 0.25)
        if any(one.object == "my-sofa" for one in document.storeys[0].furniture or ()):
            break
    else:
        pytest.fail("a sofa of four is never chosen")
    part = build_house(document, HouseOptions(catalogue=path)).part
    assert part.instances is not None
    assert "my-sofa" in {mesh.name for mesh in part.instances.meshes}
    with pytest.raises(KeyError):
        build_house(document, HouseOptions())


def test_a_result_depends_on_what_a_catalogue_holds_and_not_on_where_it_lies(
    tmp_path: Path,
) -> None:
    document = tmp_path / "plan.json"
    document.write_text(sample_plan().model_dump_json(by_alias=True))
    call = plan_call([document])

    def key(folder: str, mesh: bytes = b"") -> str:
        path = own_catalogue(tmp_path / folder)
        seat = path.with_name("seat.glb")
        seat.write_bytes(seat.read_bytes() + mesh)
        options = PlanOptions(house=HouseOptions(catalogue=path))
        return result_key_of(call, options, catalogue_digests(path, catalogue_of(path)))

    here = key("here")
    assert here == key("there")
    assert here != key("elsewhere", b"\0")
    assert here != result_key_of(call, PlanOptions(), [])


def test_a_bad_catalogue_is_refused_with_its_fault(tmp_path: Path) -> None:
    text = tmp_path / "text.sqlite"
    text.write_text("no database at all, but long enough to be read as one" * 40)
    with pytest.raises(InputError, match="no catalogue of objects"):
        catalogue_of(text)
    missing = own_catalogue(tmp_path, "other.glb")
    with pytest.raises(InputError, match="my-sofa"):
        catalogue_digests(missing, catalogue_of(missing))
    with sqlite3.connect(missing) as base:
        base.execute("UPDATE object SET walls = 'ceiling'")
    base.close()
    with pytest.raises(InputError, match="walls of 'my-sofa'"):
        catalogue_of(missing)
