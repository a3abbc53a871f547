"""A place as OBJ, STL, PLY and GLB, opened again by trimesh."""

from __future__ import annotations

import json
import re
import struct
from pathlib import Path

import numpy as np
import pytest
import trimesh
from place_sample import area_of, corners_of, sample_place

from veduta.place.holding import COLOURED_CORNERS, left_out_of
from veduta.place.mesh import Mesh
from veduta.place.place import Place, PlacedPart, Standing
from veduta.place.registry import format_named, format_of, formats
from veduta.place.semantics import Provenance, SemanticClass
from veduta.run.errors import InputError

Y_UP = np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]])


@pytest.fixture(scope="module")
def place() -> Place:
    return sample_place()


def bounds(place: Place, turn: np.ndarray | None = None) -> np.ndarray:
    """Of all corners; the open door lies within them."""
    points = corners_of(place) @ (np.eye(3) if turn is None else turn).T
    return np.array([points.min(axis=0), points.max(axis=0)])


@pytest.mark.parametrize("suffix", [".obj", ".stl", ".ply", ".glb", ".dae"])
def test_trimesh_reads_the_same_place(place: Place, suffix: str, tmp_path: Path) -> None:
    path = tmp_path / f"place{suffix}"
    place.write(path)
    scene = trimesh.load_scene(path)
    turn = Y_UP if suffix in (".obj", ".glb") else None
    np.testing.assert_allclose(scene.bounds, bounds(place, turn), atol=2e-5)
    assert scene.to_geometry().area == pytest.approx(area_of(place), rel=1e-4)
    left = [file.name for file in tmp_path.iterdir() if file.name.startswith(".")]
    assert left == []


def test_obj_has_materials_of_classes_and_textures(place: Place, tmp_path: Path) -> None:
    place.write(tmp_path / "a b.obj")
    text = (tmp_path / "a b.obj").read_text("utf-8")
    materials = (tmp_path / "a b.mtl").read_text("utf-8")
    assert "mtllib a b.mtl" in text
    used = set(re.findall(r"^usemtl (.*)$", text, re.M))
    known = set(re.findall(r"^newmtl (.*)$", materials, re.M))
    assert used == known
    assert {"wall", "window", "door", "roof"} <= known
    for picture in re.findall(r"^map_Kd (.*)$", materials, re.M):
        assert (tmp_path / picture).is_file()
        assert " " not in picture
    assert re.findall(r"^o (.*)$", text, re.M) == ["house", "ball", "door", "posts"]


def test_obj_textures_meet_their_surfaces(place: Place, tmp_path: Path) -> None:
    """The colour that trimesh finds at a wall's corner is the one that the part has there."""
    place.write(tmp_path / "place.obj")
    scene = trimesh.load_scene(tmp_path / "place.obj", split_object=False)
    textured = [
        one for one in scene.geometry.values() if getattr(one.visual.material, "image", None)
    ]
    assert textured
    for one in textured:
        assert np.ptp(one.visual.uv, axis=0).min() > 0.0
        colours = one.visual.to_color().vertex_colors[:, :3].astype(float)
        assert colours.std() > 1.0  # a photo, not one pixel of it


def test_obj_has_the_colours_of_corners(tmp_path: Path) -> None:
    triangle = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], dtype=float)
    colours = np.array([[255, 0, 0], [0, 255, 0], [0, 0, 51]], dtype=np.uint8)
    place = Place()
    place.add(Mesh.simple("t", triangle, np.array([[0, 1, 2]]), colours=colours))
    place.write(tmp_path / "t.obj")
    rows = [
        line.split()[1:]
        for line in (tmp_path / "t.obj").read_text().splitlines()
        if line[:2] == "v "
    ]
    found = {tuple(np.round(np.array(row[:3], float) @ Y_UP, 3)): row[3:] for row in rows}
    for at, colour in zip(triangle, colours / 255.0, strict=True):
        np.testing.assert_allclose(np.array(found[tuple(at)], float), colour, atol=1e-4)
    for suffix in (".dae", ".city.json"):
        assert COLOURED_CORNERS in left_out_of(place, format_of(tmp_path / f"t{suffix}"))
    assert COLOURED_CORNERS not in left_out_of(place, format_of(tmp_path / "t.obj"))


def test_ply_has_colours_and_classes(place: Place, tmp_path: Path) -> None:
    place.write(tmp_path / "place.ply")
    mesh = trimesh.load_mesh(tmp_path / "place.ply", process=False)
    ball = place.parts["ball"].content
    near = np.linalg.norm(mesh.vertices - ball.positions_m[0], axis=1).argmin()
    assert mesh.visual.vertex_colors[near, :3].tolist() == [200, 100, 50]
    header = (tmp_path / "place.ply").read_bytes()[:2000].decode("ascii", "ignore")
    assert f"{SemanticClass.WINDOW.code}=window" in header
    assert mesh.metadata["_ply_raw"]["face"]["data"]["class"].max() <= SemanticClass.OTHER.code


def glb_root(path: Path) -> tuple[dict, bytes]:
    data = path.read_bytes()
    size = struct.unpack_from("<I", data, 12)[0]
    return json.loads(data[20 : 20 + size]), data[28 + size :]


def test_glb_has_a_node_a_part_and_a_material_a_class(place: Place, tmp_path: Path) -> None:
    place.write(tmp_path / "place.glb")
    root, content = glb_root(tmp_path / "place.glb")
    top = [root["nodes"][number] for number in root["scenes"][0]["nodes"]]
    assert [node["extras"]["veduta"]["part"] for node in top] == list(place.parts)
    names = {material["name"] for material in root["materials"]}
    assert {"wall", "window", "door", "roof", "balcony"} <= names
    tables = root["extensions"]["EXT_structural_metadata"]["propertyTables"]
    assert [table["count"] for table in tables] == [
        len(one.content.features) for one in place.parts.values()
    ]
    house = place.parts["house"].content.features
    for name in ("id", "name"):
        column = tables[0]["properties"][name]
        views = [root["bufferViews"][column[key]] for key in ("values", "stringOffsets")]
        assert all(view["byteOffset"] % 8 == 0 for view in views)
        text, offsets = (content[view["byteOffset"] :][: view["byteLength"]] for view in views)
        ends = np.frombuffer(offsets, "<u4")
        words = [text[a:b].decode() for a, b in zip(ends[:-1], ends[1:], strict=True)]
        assert words == list(getattr(house, name))


def test_glb_parts_triangles_by_class(place: Place, tmp_path: Path) -> None:
    """Each primitive's triangles are of features of the class that its material is named after."""
    place.write(tmp_path / "place.glb")
    root, content = glb_root(tmp_path / "place.glb")

    def array(number: int, dtype: str) -> np.ndarray:
        accessor = root["accessors"][number]
        view = root["bufferViews"][accessor["bufferView"]]
        return np.frombuffer(content[view["byteOffset"] :][: view["byteLength"]], dtype)

    seen = 0
    parts = list(place.parts.values())
    for mesh in root["meshes"]:
        for primitive in mesh["primitives"]:
            if "_FEATURE_ID_0" not in primitive["attributes"]:
                continue
            (told,) = primitive["extensions"]["EXT_mesh_features"]["featureIds"]
            features = parts[told["propertyTable"]].content.features
            feature = array(primitive["attributes"]["_FEATURE_ID_0"], "<f4").astype(int)
            corners = array(primitive["indices"], "<u4")
            classes = {features.semantic(row).value for row in set(feature[corners].tolist())}
            name = root["materials"][primitive["material"]]["name"]
            assert classes == {name.split(".")[0]}
            seen += len(corners) // 3
    assert seen > 100


def test_the_place_outlives_its_folder(place: Place, tmp_path: Path) -> None:
    """What is saved, loaded and written is the same as what is written at once."""
    place.save(tmp_path / "out")
    place.write(tmp_path / "first.stl")
    Place.load(tmp_path / "out").write(tmp_path / "second.stl")
    first, second = (trimesh.load_mesh(tmp_path / f"{name}.stl") for name in ("first", "second"))
    assert first.area == pytest.approx(second.area, rel=1e-5)
    np.testing.assert_allclose(first.bounds, second.bounds, atol=1e-5)


def test_an_empty_place_is_no_error(tmp_path: Path) -> None:
    for suffix in (".glb", ".obj", ".stl"):
        Place().write(tmp_path / f"empty{suffix}")
        assert (tmp_path / f"empty{suffix}").stat().st_size > 0


def test_a_feature_that_no_triangle_has(tmp_path: Path) -> None:
    place = Place()
    mesh = Mesh.simple(
        "none", np.zeros((0, 3)), np.zeros((0, 3)), SemanticClass.WALL, Provenance.INVENTED
    )
    place.add(mesh)
    place.write(tmp_path / "none.stl")
    assert (tmp_path / "none.stl").stat().st_size == 84


def test_strays_do_not_widen_what_one_looks_at(tmp_path: Path) -> None:
    points = np.random.default_rng(3).uniform(-1.0, 1.0, (3000, 3))
    points[:3] = 80.0
    triangles = np.arange(3000, dtype=np.uint32).reshape(-1, 3)
    for name, places in (("strewn", points), ("compact", np.clip(points, -1.0, 1.0))):
        place = Place()
        wall, measured = SemanticClass.WALL, Provenance.MEASURED
        mesh = Mesh.simple("m", places.astype(np.float32), triangles, wall, measured)
        place.add(mesh, Standing())
        place.save(tmp_path / name)
        (part,) = json.loads((tmp_path / name / "place.json").read_text())["parts"]
        if name == "compact":
            assert "core" not in part
        else:
            assert part["bounds"]["max"] == [80.0, 80.0, 80.0]
            assert max(map(abs, part["core"]["min"] + part["core"]["max"])) <= 1.0


def test_endings_and_names(tmp_path: Path) -> None:
    assert format_of(tmp_path / "X.OBJ").name == "obj"
    assert format_named("stl").suffix == ".stl"
    assert len({one.name for one in formats().values()}) == len(formats())
    with pytest.raises(InputError, match=r"x\.doc: has no ending .* Name it with one of: .*\.obj"):
        format_of(Path("x.doc"))
    with pytest.raises(InputError, match="word: is no format"):
        format_named("word")


def test_a_town_of_tiles_without_a_city_model_is_refused_with_the_remedy(tmp_path: Path) -> None:
    place = Place(tileset="tileset.json", folder=tmp_path)

    def unreadable() -> Mesh:
        raise InputError("tile.glb", "not a GLB file of Veduta", "Let Veduta write it again.")

    place.parts["tile"] = PlacedPart("tile", Standing(), unreadable)
    for suffix in (".obj", ".glb"):
        with pytest.raises(InputError, match="--separate"):
            place.write(tmp_path / f"x{suffix}")
