"""A place as USD, COLLADA and X3D, opened again by USD's own reader and as XML."""

from __future__ import annotations

from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
from lxml import etree
from place_sample import area_of, corners_of, sample_place

from veduta.place.material import Material
from veduta.place.mesh import Mesh
from veduta.place.place import Place, Standing
from veduta.place.semantics import SemanticClass
from veduta.run.errors import InputError

pxr = pytest.importorskip("pxr")
from pxr import Usd, UsdGeom, UsdShade  # noqa: E402  it may be missing

COLLADA = {"c": "http://www.collada.org/2005/11/COLLADASchema"}


@pytest.fixture(scope="module")
def place() -> Place:
    return sample_place()


def area(points: np.ndarray, triangles: np.ndarray) -> float:
    a, b, c = (points[triangles[:, place]] for place in range(3))
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2.0)


@pytest.mark.parametrize("suffix", [".usda", ".usdc", ".usd", ".usdz"])
def test_usd_reads_the_same_place(place: Place, suffix: str, tmp_path: Path) -> None:
    path = tmp_path / f"place{suffix}"
    place.write(path)
    stage = Usd.Stage.Open(str(path))
    assert UsdGeom.GetStageUpAxis(stage) == "Z"
    assert UsdGeom.GetStageMetersPerUnit(stage) == 1.0
    box = UsdGeom.BBoxCache(0, ["default"]).ComputeWorldBound(stage.GetPseudoRoot()).GetRange()
    points = corners_of(place)
    np.testing.assert_allclose(
        [box.GetMin(), box.GetMax()], [points.min(axis=0), points.max(axis=0)], atol=1e-4
    )
    meshes = [UsdGeom.Mesh(prim) for prim in stage.Traverse() if prim.IsA(UsdGeom.Mesh)]
    found = sum(
        area(
            np.array(mesh.GetPointsAttr().Get(), dtype=float),
            np.array(mesh.GetFaceVertexIndicesAttr().Get()).reshape(-1, 3),
        )
        for mesh in meshes
    )
    assert found == pytest.approx(area_of(place), rel=1e-4)
    left = [file.name for file in tmp_path.iterdir() if file.name.startswith(".")]
    assert left == []


def test_usd_binds_each_face_to_a_look_of_its_class(place: Place, tmp_path: Path) -> None:
    place.write(tmp_path / "place.usda")
    stage = Usd.Stage.Open(str(tmp_path / "place.usda"))
    textures = 0
    for prim in stage.Traverse():
        if prim.IsA(UsdShade.Shader):
            shader = UsdShade.Shader(prim)
            if shader.GetIdAttr().Get() == "UsdUVTexture":
                found = shader.GetInput("file").Get().resolvedPath
                assert Path(found).is_file()
                textures += 1
        if not prim.IsA(UsdGeom.Mesh):
            continue
        mesh = UsdGeom.Mesh(prim)
        feature = np.array(UsdGeom.PrimvarsAPI(prim).GetPrimvar("veduta:feature").Get())
        classes = list(prim.GetAttribute("veduta:class").Get())
        subsets = UsdGeom.Subset.GetAllGeomSubsets(UsdGeom.Imageable(prim))
        faces = sorted(row for one in subsets for row in one.GetIndicesAttr().Get())
        assert faces == list(range(len(mesh.GetFaceVertexCountsAttr().Get())))
        for one in subsets:
            bound = UsdShade.MaterialBindingAPI(one.GetPrim()).ComputeBoundMaterial()[0]
            look = bound.GetPrim().GetName().split("_")[0]
            assert {classes[feature[row]] for row in one.GetIndicesAttr().Get()} == {look}
    assert textures >= 2


def test_usd_without_its_package(
    place: Place, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    import sys

    monkeypatch.setitem(sys.modules, "pxr", None)
    with pytest.raises(InputError, match=r"x\.usd: .*not installed.* pip install 'veduta\[usd\]'"):
        place.write(tmp_path / "x.usd")


def test_collada_of_names_with_control_characters(tmp_path: Path) -> None:
    place = Place(title="a\x00b\x1bc", crs="x\x01")
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 0, 1]])
    material = Material("st\x02one", (0.5, 0.5, 0.5))
    mesh = Mesh.simple("sail", corners, np.array([[0, 1, 2]]), material=material)
    place.add(mesh, Standing(name="one\x03two"))
    place.write(tmp_path / "place.dae")
    root = etree.parse(str(tmp_path / "place.dae")).getroot()
    assert root.findtext("c:asset/c:title", namespaces=COLLADA) == "a?b?c"
    assert root.find(".//c:visual_scene", COLLADA).get("name") == "a?b?c"


def test_collada_has_the_same_triangles(place: Place, tmp_path: Path) -> None:
    place.write(tmp_path / "place.dae")
    root = etree.parse(str(tmp_path / "place.dae")).getroot()
    assert root.findtext("c:asset/c:up_axis", namespaces=COLLADA) == "Z_UP"
    names = {node.get("id"): node.get("name") for node in root.iterfind(".//c:material", COLLADA)}
    assert {"wall", "window", "door", "roof"} <= set(names.values())
    found, corners = 0.0, []
    for mesh in root.iterfind(".//c:mesh", COLLADA):
        text = mesh.find("c:source/c:float_array", COLLADA).text
        points = np.array(text.split(), dtype=float).reshape(-1, 3)
        corners.append(points)
        for triangles in mesh.iterfind("c:triangles", COLLADA):
            assert triangles.get("material") in names
            numbers = np.array(triangles.findtext("c:p", namespaces=COLLADA).split(), dtype=int)
            assert len(numbers) == 3 * int(triangles.get("count"))
            found += area(points, numbers.reshape(-1, 3))
    assert found == pytest.approx(area_of(place), rel=1e-4)
    every, own = np.concatenate(corners), corners_of(place)
    np.testing.assert_allclose(every.max(axis=0), own.max(axis=0), atol=1e-4)
    for image in root.iterfind(".//c:image/c:init_from", COLLADA):
        assert (tmp_path / image.text).is_file()


def test_collada_comes_back(place: Place, tmp_path: Path) -> None:
    place.write(tmp_path / "place.dae")
    again = Place.load(tmp_path / "place.dae")
    assert area_of(again) == pytest.approx(area_of(place), rel=1e-4)
    np.testing.assert_allclose(
        corners_of(again).max(axis=0), corners_of(place).max(axis=0), atol=1e-4
    )
    assert {SemanticClass.WALL, SemanticClass.WINDOW, SemanticClass.ROOF} <= _classes(again)
    assert _classes(again) <= _classes(place)


def _classes(place: Place) -> set[SemanticClass]:
    codes = [one.content.features.class_code for one in place.parts.values()]
    return {SemanticClass.of_code(code) for code in np.unique(np.concatenate(codes)).tolist()}


def test_x3d_has_the_same_triangles(place: Place, tmp_path: Path) -> None:
    place.write(tmp_path / "place.x3d")
    root = ElementTree.parse(tmp_path / "place.x3d").getroot()
    looks = [look.get("DEF") for look in root.iter("Appearance") if look.get("DEF")]
    assert {"look-wall", "look-window", "look-door", "look-roof"} <= set(looks)
    assert len(looks) == len(set(looks))
    used = {look.get("USE") for look in root.iter("Appearance")} - {None}
    assert used <= set(looks)
    found, corners = 0.0, []
    for faces in root.iter("IndexedTriangleSet"):
        points = _floats(faces.find("Coordinate"), "point")
        normals = _floats(faces.find("Normal"), "vector")
        numbers = np.array(faces.attrib["index"].split(), dtype=int).reshape(-1, 3)
        assert len(points) == len(normals)
        assert np.linalg.norm(normals, axis=1) == pytest.approx(1.0, abs=1e-3)
        found += area(points, numbers)
        # y is up there: back to x east, y north, z up.
        corners.append(np.stack([points[:, 0], -points[:, 2], points[:, 1]], axis=1))
        facing = np.cross(*(points[numbers[:, n]] - points[numbers[:, 0]] for n in (1, 2)))
        assert (np.einsum("ij,ij->i", facing, normals[numbers[:, 0]]) > -1e-6).all()
    assert found == pytest.approx(area_of(place), rel=1e-3)
    own = corners_of(place)
    every = np.concatenate(corners)
    np.testing.assert_allclose(every.max(axis=0), own.max(axis=0), atol=1e-3)
    np.testing.assert_allclose(every.min(axis=0), own.min(axis=0), atol=1e-3)


def _floats(node: Any, field: str) -> Any:
    return np.array(node.attrib[field].replace(",", " ").split(), dtype=float).reshape(-1, 3)
