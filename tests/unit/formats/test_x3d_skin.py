"""Skinned meshes as X3D: what a player of it shows is what the clip says."""

from __future__ import annotations

from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from veduta.formats.x3d_skin import mesh_x3d
from veduta.place.mesh import Mesh
from veduta.place.semantics import Provenance, SemanticClass
from veduta.place.skin import Clip, Skin

POINTS = np.array([[0, 0, 0], [1, 0, 0], [2, 0.2, 0], [2, 0, 0.5]], dtype=np.float32)


def _mesh() -> Mesh:
    rest = np.tile(np.eye(4), (2, 1, 1))
    rest[1, :3, 3] = [1.0, 0.0, 0.1]
    weights = np.zeros((4, 4), dtype=np.float32)
    weights[:, 0], weights[2:, 0], weights[2:, 1] = 1.0, 0.25, 0.75
    joints = np.zeros((4, 4), dtype=np.uint16)
    joints[2:, 1] = 1
    skin = Skin(("root", "tail"), np.array([-1, 0], dtype=np.int32), rest, joints, weights)
    times = np.array([0.0, 0.5, 2.0])
    moves = np.zeros((3, 2, 3))
    moves[:, 0, 0] = [0.0, 0.3, 1.0]
    moves[:, 1] = [1.0, 0.0, 0.1]
    vectors = np.array([[0, 0, 0], [0, 0, 0.7], [0.3, -0.4, 0.2]])
    turns = np.zeros((3, 2, 4))
    turns[..., 3] = 1.0
    turns[:, 1] = Rotation.from_rotvec(vectors).as_quat()
    clip = Clip("swing", times, moves, turns, True)
    triangles = np.array([[0, 1, 2], [1, 2, 3]], dtype=np.uint32)
    mesh = Mesh.simple(
        "worm", POINTS, triangles, SemanticClass.OTHER, Provenance.MEASURED, name="worm"
    )
    return replace(mesh, skin=skin, clips=(clip,))


def _numbers(element: ElementTree.Element, field: str, width: int) -> np.ndarray:
    return np.array(element.attrib[field].split(), dtype=np.float64).reshape(-1, width)


def _shown(root: ElementTree.Element, key: int) -> np.ndarray:
    """Vertices (v, 3) at a key, as HAnim says: centre, turn, move, and weights."""
    found = {node.attrib["DEF"]: node for node in root.iter() if "DEF" in node.attrib}
    state = {}
    for route in root.iter("ROUTE"):
        if route.attrib["toField"].startswith("set_") and "Interpolator" in str(
            found[route.attrib["fromNode"]].tag
        ):
            values = _numbers(
                found[route.attrib["fromNode"]], "keyValue",
                4 if route.attrib["toField"] == "set_rotation" else 3,
            )  # fmt: skip
            state[route.attrib["toNode"], route.attrib["toField"]] = values[key]
    humanoid = next(root.iter("HAnimHumanoid"))
    points = _numbers(humanoid.find("Coordinate"), "point", 3)  # type: ignore[arg-type]
    shown = np.zeros_like(points)

    def visit(joint: ElementTree.Element, above: np.ndarray) -> None:
        centre = _numbers(joint, "center", 3)[0]
        turn = state.get((joint.attrib["DEF"], "set_rotation"), np.array([0.0, 1.0, 0.0, 0.0]))
        own = np.eye(4)
        own[:3, :3] = Rotation.from_rotvec(turn[:3] * turn[3]).as_matrix()
        move = state.get((joint.attrib["DEF"], "set_translation"), np.zeros(3))
        own[:3, 3] = move + centre - own[:3, :3] @ centre
        whole = above @ own
        rows = np.array(joint.attrib["skinCoordIndex"].split(), dtype=int)
        weight = np.array(joint.attrib["skinCoordWeight"].split(), dtype=np.float64)
        shown[rows] += weight[:, None] * (points[rows] @ whole[:3, :3].T + whole[:3, 3])
        for child in joint.findall("HAnimJoint"):
            visit(child, whole)

    for joint in humanoid.findall("HAnimJoint"):
        if "USE" not in joint.attrib:
            visit(joint, np.eye(4))
    return shown


@pytest.mark.parametrize("key", [0, 1, 2])
def test_a_player_of_x3d_shows_what_the_clip_says(key: int) -> None:
    mesh = _mesh()
    assert mesh.skin is not None
    clip = mesh.clips[0]
    whole = np.eye(4)
    wanted = np.zeros((4, 3))
    for joint in range(2):
        own = np.eye(4)
        own[:3, :3] = Rotation.from_quat(clip.rotations_xyzw[key, joint]).as_matrix()
        own[:3, 3] = clip.translations_m[key, joint]
        whole = whole @ own
        moved = whole @ np.linalg.inv(mesh.skin.rest[joint])
        weight = mesh.skin.weights[:, joint]
        wanted += weight[:, None] * (POINTS @ moved[:3, :3].T + moved[:3, 3])
    shown = _shown(ElementTree.fromstring(mesh_x3d(mesh)), key)
    np.testing.assert_allclose(shown, wanted[:, [0, 2, 1]] * [1.0, 1.0, -1.0], atol=1e-5)


def test_clips_have_clocks_and_the_first_one_runs() -> None:
    mesh = _mesh()
    clip = mesh.clips[0]
    mesh = replace(mesh, clips=(clip, replace(clip, name="again", loops=False)))
    clocks = list(ElementTree.fromstring(mesh_x3d(mesh)).iter("TimeSensor"))
    assert [one.attrib["enabled"] for one in clocks] == ["true", "false"]
    assert [one.attrib["loop"] for one in clocks] == ["true", "false"]
    assert clocks[0].attrib["cycleInterval"] == "2"


def test_a_mesh_without_a_skeleton_or_with_turned_joints_is_refused() -> None:
    mesh = _mesh()
    with pytest.raises(ValueError, match="no skeleton"):
        mesh_x3d(replace(mesh, skin=None, clips=()))
    assert mesh.skin is not None
    rest = mesh.skin.rest.copy()
    rest[1, :3, :3] = Rotation.from_rotvec([0.0, 0.0, 0.3]).as_matrix()
    with pytest.raises(ValueError, match="turned at rest"):
        mesh_x3d(replace(mesh, skin=replace(mesh.skin, rest=rest)))
