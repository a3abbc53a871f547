"""COLLADA files of others: faces, transforms, units, colours; and what is no mesh."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from veduta.formats.dae_read import read_dae_mesh
from veduta.formats.place_dae import write_dae
from veduta.grammar.assets.from_file import read_asset
from veduta.place.mesh import Mesh
from veduta.place.place import Place
from veduta.place.semantics import Provenance, SemanticClass
from veduta.run.errors import InputError

HEAD = (
    '<?xml version="1.0"?>'
    '<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">'
)
EFFECTS = """
<library_effects><effect id="fx"><profile_COMMON><technique sid="t"><lambert><diffuse>
<color>1 0.5 0.25 1</color></diffuse></lambert></technique></profile_COMMON></effect>
</library_effects><library_materials>
<material id="m" name="brick"><instance_effect url="#fx"/></material></library_materials>
"""
GEOMETRY = """
<library_geometries><geometry id="g"><mesh>
<source id="s"><float_array id="a" count="12">0 0 0  2 0 0  2 1 0  0 1 0</float_array>
<technique_common><accessor source="#a" count="4" stride="3"/></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#s"/></vertices>
{faces}
</mesh></geometry></library_geometries>
"""
POLYLIST = """<polylist count="1" material="sym"><input semantic="VERTEX" source="#v" offset="1"/>
<input semantic="NORMAL" source="#s" offset="0"/><vcount>4</vcount>
<p>9 0 9 1 9 2 9 3</p></polylist>"""
TRIANGLES = """<triangles count="2"><input semantic="VERTEX" source="#v" offset="0"/>
<p>0 1 2 0 2 3</p></triangles>"""
SCENE = """
<library_visual_scenes><visual_scene id="vs"><node>{transform}<node><instance_geometry url="#g">
<bind_material><technique_common><instance_material symbol="sym" target="#m"/></technique_common>
</bind_material></instance_geometry></node></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#vs"/></scene>
"""


def written(
    folder: Path, faces: str = POLYLIST, transform: str = "", asset: str = "", scene: str = SCENE
) -> Path:
    path = folder / "a.dae"
    body = EFFECTS + GEOMETRY.format(faces=faces) + scene.replace("{transform}", transform)
    path.write_text(f"{HEAD}<asset>{asset}</asset>{body}</COLLADA>")
    return path


def test_a_polygon_keeps_its_corners_and_its_colour(tmp_path: Path) -> None:
    mesh = read_dae_mesh(written(tmp_path))
    assert mesh.points.tolist() == [[0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0]]
    assert mesh.corners.tolist() == [0, 1, 2, 3]
    assert mesh.offsets.tolist() == [0, 4]
    assert mesh.materials == (("brick", (1.0, 0.5, 0.25)),)


def test_triangles_without_a_scene(tmp_path: Path) -> None:
    mesh = read_dae_mesh(written(tmp_path, TRIANGLES, scene=""))
    assert mesh.offsets.tolist() == [0, 3, 6]
    assert mesh.materials == (("", None),)


@pytest.mark.parametrize(
    ("transform", "expected"),
    [
        ("<translate>1 2 3</translate>", (3.0, 3.0, 3.0)),
        ("<scale>2 3 4</scale>", (4.0, 3.0, 0.0)),
        ("<rotate>0 0 1 90</rotate>", (-1.0, 2.0, 0.0)),
        ("<translate>1 0 0</translate><rotate>0 0 1 90</rotate>", (0.0, 2.0, 0.0)),
        ("<matrix>0 -1 0 5 1 0 0 6 0 0 1 7 0 0 0 1</matrix>", (4.0, 8.0, 7.0)),
    ],
)
def test_the_steps_of_nodes_are_done_in_order(
    tmp_path: Path, transform: str, expected: tuple[float, float, float]
) -> None:
    mesh = read_dae_mesh(written(tmp_path, transform=transform))
    assert np.allclose(mesh.points[2], expected)


def test_units_and_the_up_axis(tmp_path: Path) -> None:
    inches = read_dae_mesh(written(tmp_path, asset='<unit name="inch" meter="0.0254"/>'))
    assert np.allclose(inches.points[2], (0.0508, 0.0254, 0.0))
    up = read_dae_mesh(written(tmp_path, asset="<up_axis>Z_UP</up_axis>"))
    assert np.allclose(up.points[2], (2.0, 0.0, -1.0))


def test_what_veduta_writes_comes_back(tmp_path: Path) -> None:
    """A place has z up, an asset y up."""
    rng = np.random.default_rng(0)
    points = rng.random((5, 3)).astype(np.float32)
    triangles = np.array([[0, 1, 2], [0, 2, 3], [1, 4, 2]], np.uint32)
    place = Place(title="t")
    place.add(
        Mesh.simple("m", points, triangles, SemanticClass.WALL, Provenance.MEASURED, name="m")
    )
    write_dae(place, tmp_path / "p.dae")
    mesh = read_dae_mesh(tmp_path / "p.dae")
    own = points.astype(float)[triangles].reshape(-1, 3)
    back = mesh.points[mesh.corners]
    expected = own[:, [0, 2, 1]] * (1.0, 1.0, -1.0)
    apart = np.linalg.norm(back[:, None] - expected[None], axis=2)
    assert apart.min(axis=0).max() < 1e-3
    assert apart.min(axis=1).max() < 1e-3
    assert len(mesh.offsets) - 1 == 3


def test_an_asset_of_rules_may_be_collada(tmp_path: Path) -> None:
    asset = read_asset("a.dae", written(tmp_path))
    assert np.ptp(asset.points_m, axis=0).tolist() == [2.0, 1.0, 0.0]
    assert asset.slots[0].colour == (1.0, 0.5, 0.25)


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("<COLLADA", "no mesh that can be read"),
        ("<x/>", "XML of another kind"),
        (HEAD + "</COLLADA>", "it has no faces"),
        (
            '<!DOCTYPE x [<!ENTITY e SYSTEM "file:///etc/passwd">]><COLLADA><a>&e;</a></COLLADA>',
            "it has no faces",
        ),
    ],
)
def test_what_is_no_mesh_is_told(tmp_path: Path, text: str, fault: str) -> None:
    path = tmp_path / "a.dae"
    path.write_text(text)
    with pytest.raises(InputError, match=fault) as told:
        read_dae_mesh(path)
    assert "Export it again" in told.value.remedy


@pytest.mark.parametrize(
    ("faces", "fault"),
    [
        (POLYLIST.replace("9 3</p>", "9 4</p>"), "a point that is not there"),
        (POLYLIST.replace("<vcount>4", "<vcount>5"), "do not fit their corners"),
        (POLYLIST.replace("#v", "other.dae#v"), "refers to another file"),
        (POLYLIST.replace("#v", "#nothing"), "nothing"),
        (POLYLIST.replace('"VERTEX"', '"VORTEX"'), "name no vertices"),
        (POLYLIST.replace("<input", "<output"), "name no vertices"),
        (POLYLIST.replace("#v", "#s"), "have no positions"),
    ],
)
def test_faces_that_cannot_be_are_told(tmp_path: Path, faces: str, fault: str) -> None:
    with pytest.raises(InputError, match=fault):
        read_dae_mesh(written(tmp_path, faces))


def test_nodes_that_hold_themselves_end(tmp_path: Path) -> None:
    scene = SCENE.replace("<node>{transform}", '<node id="n"><instance_node url="#n"/>')
    with pytest.raises(InputError, match="hold themselves"):
        read_dae_mesh(written(tmp_path, scene=scene))
    with pytest.raises(InputError, match="more than 3 corners"):
        read_dae_mesh(written(tmp_path), most_corners=3)
