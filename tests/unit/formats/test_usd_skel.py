"""What moves, in USD: skinned by USD's own code, and compared with sums of weighted matrices."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from veduta.place.mesh import Mesh, Morph
from veduta.place.place import Place, Standing
from veduta.place.semantics import Provenance, SemanticClass
from veduta.place.skin import Clip, Skin

pxr = pytest.importorskip("pxr")
from pxr import Gf, Usd, UsdGeom, UsdSkel  # noqa: E402  it may be missing

TIMES_S = np.array([0.0, 0.25, 1.0])


def animal() -> Mesh:
    """A strip of eight vertices along x on a chain of three joints, a side branch among them."""
    rng = np.random.default_rng(3)
    x = np.repeat(np.arange(4.0), 2)
    points = np.stack([x, np.tile([0.0, 0.5], 4), np.zeros(8)], axis=1)
    corner = np.array([[0, 2, 1], [1, 2, 3]])
    triangles = np.concatenate([corner + 2 * step for step in range(3)]).astype(np.uint32)
    rest = np.tile(np.eye(4), (3, 1, 1))
    for joint, (at, turn) in enumerate([((0, 0, 0), 0.3), ((1, 0, 0.2), -0.5), ((2, 0.1, 0), 1.0)]):
        rest[joint, :3, :3] = Rotation.from_rotvec([0.0, turn, 0.2 * turn]).as_matrix()
        rest[joint, :3, 3] = at
    joints = np.tile(np.array([0, 1, 2, 0], np.uint16), (8, 1))
    weights = rng.random((8, 4)).astype(np.float32)
    weights[:, 3] = 0.0
    weights /= weights.sum(axis=1, keepdims=True)
    skin = Skin(("root", "a b", "root"), np.array([-1, 0, 0], np.int32), rest, joints, weights)
    turns = Rotation.random(9, random_state=5).as_quat().reshape(3, 3, 4)
    clips = tuple(
        Clip(name, TIMES_S, rng.normal(size=(3, 3, 3)), turns, loops=True)
        for name in ("go", "stop")
    )
    mesh = Mesh.simple("animal", points, triangles, SemanticClass.OTHER, Provenance.MEASURED)
    higher = (points + np.array([0.0, 0.0, 1.0])).astype(np.float32)
    return Mesh(
        **{name: getattr(mesh, name) for name in (
            "id", "positions_m", "triangles", "features", "materials", "triangle_feature",
            "triangle_material", "normals", "uv",
        )},
        morphs=(Morph("up", higher),), skin=skin, clips=clips,
    )  # fmt: skip


def standing() -> Standing:
    transform = np.eye(4)
    transform[:3, :3] = Rotation.from_rotvec([0.0, 0.0, 0.7]).as_matrix()
    transform[:3, 3] = [10.0, -4.0, 2.0]
    return Standing(transform=transform)


def skinned(mesh: Mesh, clip: Clip, row: int, transform: np.ndarray) -> np.ndarray:
    """(v, 3) linear blend skinning, as its definition has it."""
    skin = mesh.skin
    assert skin is not None
    local = np.tile(np.eye(4), (3, 1, 1))
    local[:, :3, :3] = Rotation.from_quat(clip.rotations_xyzw[row]).as_matrix()
    local[:, :3, 3] = clip.translations_m[row]
    pose = local.copy()
    for joint, parent in enumerate(skin.parent.tolist()):
        if parent >= 0:
            pose[joint] = pose[parent] @ local[joint]
    move = pose @ np.linalg.inv(skin.rest)
    points = np.column_stack([mesh.positions_m, np.ones(len(mesh.positions_m))])
    each = np.einsum("jab,vb->vja", move, points)
    chosen = np.take_along_axis(each, skin.joints[:, :, None].astype(np.int64), axis=1)
    placed = (chosen * skin.weights[:, :, None]).sum(axis=1)
    return (placed @ transform.T)[:, :3]


@pytest.fixture(scope="module")
def stage(tmp_path_factory: pytest.TempPathFactory) -> Usd.Stage:
    place = Place()
    place.add(animal(), standing())
    path = tmp_path_factory.mktemp("usd") / "animal.usda"
    place.write(path)
    return Usd.Stage.Open(str(path))


def one_of(stage: Usd.Stage, kind: type) -> Usd.Prim:
    return next(prim for prim in stage.Traverse() if prim.IsA(kind))


def mesh_of(stage: Usd.Stage) -> UsdGeom.Mesh:
    return UsdGeom.Mesh(one_of(stage, UsdGeom.Mesh))


def test_usd_moves_the_mesh_as_its_joints_do(stage: Usd.Stage) -> None:
    content, world_from_part = animal(), standing().transform
    assert stage.GetEndTimeCode() / stage.GetTimeCodesPerSecond() == 1.0
    root = one_of(stage, UsdSkel.Root)
    baked = Usd.Stage.CreateInMemory()
    baked.GetRootLayer().TransferContent(stage.GetRootLayer())
    own = UsdSkel.Root.Get(baked, root.GetPath())
    assert UsdSkel.BakeSkinning(own, Gf.Interval(0.0, stage.GetEndTimeCode()))
    mesh = mesh_of(baked)
    for row, time in enumerate(TIMES_S):
        code = time * stage.GetTimeCodesPerSecond()
        found = np.array(mesh.GetPointsAttr().Get(code), dtype=np.float64)
        seen = np.array(mesh.ComputeLocalToWorldTransform(code)).T
        found = found @ seen[:3, :3].T + seen[:3, 3]
        wanted = skinned(content, content.clips[0], row, world_from_part)
        np.testing.assert_allclose(found, wanted, atol=2e-5)


def test_usd_knows_all_clips_and_morphs(stage: Usd.Stage) -> None:
    clips = [prim for prim in stage.Traverse() if prim.IsA(UsdSkel.Animation)]
    assert [prim.GetDisplayName() for prim in clips] == ["go", "stop"]
    skeleton = UsdSkel.Skeleton(one_of(stage, UsdSkel.Skeleton))
    assert list(skeleton.GetJointsAttr().Get()) == ["root", "root/a_b", "root/root_2"]
    topology = UsdSkel.Topology(skeleton.GetJointsAttr().Get())
    assert topology.Validate()[0]
    shape = UsdSkel.BlendShape(one_of(stage, UsdSkel.BlendShape))
    np.testing.assert_allclose(
        np.array(shape.GetOffsetsAttr().Get()), np.tile([0.0, 0.0, 1.0], (8, 1)), atol=1e-6
    )
    binding = UsdSkel.BindingAPI(mesh_of(stage).GetPrim())
    assert list(binding.GetBlendShapesAttr().Get()) == ["up"]


def test_a_packed_file_holds_the_motion(tmp_path: Path) -> None:
    place = Place()
    place.add(animal())
    place.write(tmp_path / "animal.usdz")
    stage = Usd.Stage.Open(str(tmp_path / "animal.usdz"))
    assert any(prim.IsA(UsdSkel.Animation) for prim in stage.Traverse())
