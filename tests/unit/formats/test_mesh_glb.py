"""Meshes as GLB: read back, and by other readers."""

from __future__ import annotations

import io
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh
from scipy.spatial.transform import Rotation

from veduta.formats.gltf import write_glb
from veduta.formats.mesh_glb import mesh_glb_bytes, write_mesh_glb
from veduta.formats.mesh_glb_read import read_model
from veduta.place.builder import PartBuilder
from veduta.place.features import feature_table
from veduta.place.material import Material, Texture
from veduta.place.mesh import Clip, Mesh, Morph, Skin
from veduta.place.semantics import Provenance, SemanticClass
from veduta.run.errors import InputError


def _box() -> tuple[np.ndarray, np.ndarray]:
    box = trimesh.creation.box((1.0, 2.0, 3.0))
    return np.asarray(box.vertices, np.float32), np.asarray(box.faces, np.uint32)


def _skinned() -> Mesh:
    """A box on two joints; the second hangs on the first, half way up."""
    positions, triangles = _box()
    upper = (positions[:, 2] > 0.0).astype(np.float32)
    rest = np.tile(np.eye(4), (2, 1, 1))
    rest[0, :3, 3], rest[1, :3, 3] = (0.0, 0.0, -1.5), (0.1, 0.2, 0.0)
    rest[1, :3, :3] = Rotation.from_euler("xyz", [0.3, -0.2, 0.7]).as_matrix()
    joints = np.zeros((8, 4), np.uint16)
    joints[:, 1] = 1
    weights = np.column_stack([1 - upper, upper, 0 * upper, 0 * upper]).astype(np.float32)
    skin = Skin(("root", "top"), np.array([-1, 0], np.int32), rest, joints, weights)
    local = skin.rest_in_parent()
    times = np.array([0.0, 0.5, 1.0])
    turns = np.tile(Rotation.from_matrix(local[:, :3, :3]).as_quat(), (3, 1, 1))
    turns[1, 1] = Rotation.from_euler("y", 0.4).as_quat()
    clip = Clip("nod", times, np.tile(local[:, :3, 3], (3, 1, 1)), turns, loops=True)
    return replace(Mesh.simple("puppet", positions, triangles), skin=skin, clips=(clip,))


def test_a_coloured_mesh_comes_back_as_it_was(tmp_path: Path) -> None:
    positions, triangles = _box()
    colours = np.arange(24, dtype=np.uint8).reshape(8, 3) * 10
    mesh = replace(
        Mesh.simple("box", positions, triangles, SemanticClass.WALL, colours=colours),
        attributes={"height_m": 3.0},
        notes=("one",),
        extras={"walk": {"key": 1}},
    )
    write_mesh_glb(mesh, tmp_path / "box.glb")
    again = read_model(tmp_path / "box.glb")
    assert isinstance(again, Mesh)
    np.testing.assert_array_equal(again.positions_m, positions)
    np.testing.assert_array_equal(again.triangles, triangles)
    np.testing.assert_array_equal(again.colours, colours)
    assert again.features.semantic(0) is SemanticClass.WALL
    assert again.attributes == {"height_m": 3.0}
    assert again.notes == ("one",)
    assert again.extras == {"walk": {"key": 1}}


def test_another_reader_sees_the_same_solid() -> None:
    positions, triangles = _box()
    data = mesh_glb_bytes(Mesh.simple("box", positions, triangles))
    seen = trimesh.load_scene(io.BytesIO(data), file_type="glb").to_geometry()
    assert seen.volume == pytest.approx(6.0)
    low, high = seen.bounds
    np.testing.assert_allclose(high - low, [1.0, 3.0, 2.0])  # y up


def test_features_and_materials_of_triangles_are_kept(tmp_path: Path) -> None:
    positions, triangles = _box()
    rows = [
        (SemanticClass.WALL, Provenance.MEASURED, "front"),
        (SemanticClass.OTHER, Provenance.INVENTED, "rest"),
    ]
    pixels = np.random.default_rng(1).integers(0, 255, (16, 16, 3), dtype=np.uint8)
    texture = Texture(pixels, np.eye(16, dtype=np.bool_))
    feature = np.array([0, 0, 1, 1, 0, 1, 1, 1, 0, 0, 1, 1], np.int32)
    material = np.repeat([1, 0], 6).astype(np.int32)
    mesh = replace(
        Mesh.simple("box", positions, triangles, uv=positions[:, :2] * 0.2 + 0.5),
        features=feature_table("box", rows),
        materials=(Material("plain"), Material("photo", texture=texture)),
        triangle_feature=feature,
        triangle_material=material,
    )
    write_mesh_glb(mesh, tmp_path / "box.glb")
    again = read_model(tmp_path / "box.glb")
    assert isinstance(again, Mesh)
    kept = {
        (*np.sort(again.positions_m[corners].round(4).reshape(-1)).tolist(), row, kind)
        for corners, row, kind in zip(
            again.triangles, again.triangle_feature, again.triangle_material, strict=True
        )
    }
    wanted = {
        (*np.sort(positions[corners].round(4).reshape(-1)).tolist(), row, kind)
        for corners, row, kind in zip(triangles, feature, material, strict=True)
    }
    assert kept == wanted
    photo = again.materials[1].texture
    assert photo is not None
    np.testing.assert_array_equal(photo.invented, texture.invented)


def test_morphs_and_second_coordinates_come_back(tmp_path: Path) -> None:
    positions, triangles = _box()
    other = positions * np.float32(1.5) + np.float32(0.25)
    uv = positions[:, :2].copy()
    mesh = replace(
        Mesh.simple("box", positions, triangles, uv=uv),
        uv_second=uv + np.float32(0.125),
        morphs=(Morph("next", other),),
    )
    write_mesh_glb(mesh, tmp_path / "box.glb")
    again = read_model(tmp_path / "box.glb")
    assert isinstance(again, Mesh)
    np.testing.assert_allclose(again.morphs[0].positions_m, other, atol=1e-6)
    np.testing.assert_array_equal(again.uv_second, mesh.uv_second)


def test_a_skeleton_and_its_clips_come_back(tmp_path: Path) -> None:
    mesh = _skinned()
    write_mesh_glb(mesh, tmp_path / "puppet.glb")
    again = read_model(tmp_path / "puppet.glb")
    assert isinstance(again, Mesh)
    assert again.skin is not None
    assert mesh.skin is not None
    assert again.skin.names == ("root", "top")
    np.testing.assert_array_equal(again.skin.parent, [-1, 0])
    np.testing.assert_allclose(again.skin.rest, mesh.skin.rest, atol=1e-6)
    clip, wanted = again.clips[0], mesh.clips[0]
    assert clip.loops
    np.testing.assert_allclose(clip.translations_m, wanted.translations_m, atol=1e-6)
    same = np.abs(np.einsum("tjk,tjk->tj", clip.rotations_xyzw, wanted.rotations_xyzw))
    np.testing.assert_allclose(same, 1.0, atol=1e-6)


def test_a_part_is_told_from_a_mesh(tmp_path: Path) -> None:
    builder = PartBuilder("wall")
    row = builder.feature(SemanticClass.WALL, Provenance.MEASURED, "wall")
    square = [[0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 1]]
    builder.polygon([square], row, builder.material(Material("wall")))
    part = builder.build()
    write_glb(part, tmp_path / "wall.glb")
    again = read_model(tmp_path / "wall.glb")
    assert type(again) is type(part)
    (tmp_path / "bad.glb").write_bytes(b"glTF" + bytes(40))
    with pytest.raises(InputError, match="not a GLB file of Veduta"):
        read_model(tmp_path / "bad.glb")


@pytest.mark.parametrize("fault", ["vertex", "feature", "colours"])
def test_columns_that_do_not_belong_together_are_refused(fault: str) -> None:
    positions, triangles = _box()
    mesh = Mesh.simple("box", positions, triangles)
    changes: dict[str, dict[str, object]] = {
        "vertex": {"triangles": triangles + np.uint32(1)},
        "feature": {"triangle_feature": mesh.triangle_feature + 1},
        "colours": {"colours": np.zeros((3, 3), np.uint8)},
    }
    with pytest.raises(ValueError, match="mesh 'box'"):
        replace(mesh, **changes[fault])
