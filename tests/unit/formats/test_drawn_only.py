"""What is drawn only is in formats that draw, and in none that measures or classifies."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
import trimesh

from veduta.formats.gltf import read_glb, write_glb
from veduta.place.builder import PartBuilder
from veduta.place.load import load
from veduta.place.material import Material
from veduta.place.part import Part
from veduta.place.place import Place
from veduta.place.semantics import DRAWN_ONLY, Provenance, SemanticClass

SIDE_M = 4.0
OUT_M = 1.0
"""The sheet reaches out of the slab, so that an outline with it would be larger."""


def _slab() -> Part:
    """A wall that lies, 4 x 4 m, and a sheet of shadow over it and 1 m beside it."""
    builder = PartBuilder("slab")
    wall = builder.feature(SemanticClass.WALL, Provenance.MEASURED, "wall")
    shade = builder.feature(SemanticClass.SHADOW, Provenance.INVENTED, "shade", shell=1)
    stone = builder.material(Material("stone", (0.6, 0.6, 0.6)))
    dark = builder.material(Material("dark", (0.1, 0.1, 0.1), opacity=0.1))
    far = SIDE_M + OUT_M
    builder.polygon([[(0, 0, 0), (SIDE_M, 0, 0), (SIDE_M, 4, 0), (0, 4, 0)]], wall, stone)
    for height in (0.001, 0.002):
        builder.polygon([[(0, 0, height), (far, 0, height), (far, 4, height)]], shade, dark)
    return builder.build()


@pytest.fixture(scope="module")
def place() -> Place:
    made = Place(title="A slab", crs="EPSG:25833")
    made.origin_m = (389_000.0, 5_819_000.0, 34.0)
    made.add(_slab())
    return made


def test_shadows_alone_are_drawn_only_and_have_no_area() -> None:
    assert list(DRAWN_ONLY) == [SemanticClass.SHADOW]
    np.testing.assert_allclose(_slab().feature_area_m2, [SIDE_M * 4, 0.0])


@pytest.mark.parametrize("suffix", [".stl", ".ply"])
def test_meshes_that_know_no_transparency_leave_it_out(
    place: Place, suffix: str, tmp_path: Path
) -> None:
    place.write(tmp_path / f"a{suffix}")
    read = trimesh.load_mesh(tmp_path / f"a{suffix}")
    assert len(read.faces) == 2
    assert read.bounds[1].tolist() == pytest.approx([SIDE_M, 4.0, 0.0])


@pytest.mark.parametrize("suffix", [".gml", ".3.gml", ".city.json"])
def test_city_models_leave_it_out(place: Place, suffix: str, tmp_path: Path) -> None:
    place.write(tmp_path / f"a{suffix}")
    text = (tmp_path / f"a{suffix}").read_text("utf-8")
    assert "wall" in text
    assert "shade" not in text
    assert "nstallation" not in text


def test_outlines_end_where_the_slab_ends(place: Place, tmp_path: Path) -> None:
    import pyogrio

    place.write(tmp_path / "a.gpkg")
    _, _, shapes, columns = pyogrio.raw.read(tmp_path / "a.gpkg", columns=["area_m2"])
    assert len(shapes) == 1
    assert columns[0][0] == pytest.approx(SIDE_M * 4)


@pytest.mark.parametrize("suffix", [".obj", ".dae", ".usda", ".x3d", ".glb"])
def test_formats_that_draw_have_it_thin(place: Place, suffix: str, tmp_path: Path) -> None:
    place.write(tmp_path / f"a{suffix}")
    if suffix == ".glb":
        faces = sum(len(one.faces) for one in trimesh.load_scene(tmp_path / "a.glb").dump())
        assert faces == 4
        return
    text = (tmp_path / ("a.mtl" if suffix == ".obj" else f"a{suffix}")).read_text("utf-8")
    thin = {
        ".obj": "\nd 0.1", ".dae": "<transparency><float>0.1", ".usda": "opacity = 0.1",
        ".x3d": 'transparency="0.9"',
    }  # fmt: skip
    assert thin[suffix] in re.sub(r">\s+<", "><", text)


def test_a_model_and_a_kept_place_say_it_again(place: Place, tmp_path: Path) -> None:
    write_glb(_slab(), tmp_path / "a.glb")
    assert read_glb(tmp_path / "a.glb").features.semantic(1) is SemanticClass.SHADOW
    place.save(tmp_path / "kept")
    (one,) = load(tmp_path / "kept").parts.values()
    assert one.content.features.semantic(1) is SemanticClass.SHADOW


def test_what_others_call_a_shadow_is_a_surface(tmp_path: Path) -> None:
    """A material's name says what a surface is, but takes none away."""
    (tmp_path / "a.mtl").write_text("newmtl shadow\nKd 0.1 0.1 0.1\n")
    text = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl shadow\nf 1 2 3\n"
    (tmp_path / "a.obj").write_text(text)
    (one,) = load(tmp_path / "a.obj").parts.values()
    assert one.content.features.semantic(0) is SemanticClass.OTHER


def test_a_shadow_of_a_city_model_is_a_surface(place: Place, tmp_path: Path) -> None:
    """What others call so has a body: it is not left out where it is written again."""
    path = tmp_path / "a.city.json"
    place.write(path)
    whole = load(path)
    text = path.read_text("utf-8")
    renamed = text.replace('"class":"wall"', '"class":"shadow"')
    assert renamed != text
    path.write_text(renamed)
    again = load(path)
    for one, other in zip(whole.parts.values(), again.parts.values(), strict=True):
        areas = other.content.feature_area_m2
        assert one.content.feature_area_m2.sum() == pytest.approx(areas.sum())
