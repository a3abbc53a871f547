"""The skeleton, the clips and the morphs of a mesh in USD (UsdSkel).

https://openusd.org/release/api/usd_skel_page_front.html - the mesh stands below a SkelRoot with its
Skeleton, one SkelAnimation for each clip, of which the first plays, and one BlendShape for each
morph. The skeleton stands where the part does; the mesh is in the frame of the place, in which the
joints are bound. USD's matrices have their translation in the last row.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from veduta.place.mesh import Mesh
from veduta.place.skin import Clip, Skin

if TYPE_CHECKING:
    from pxr import Sdf, Usd

CODES_A_SECOND = 1000.0
"""Time codes: a clip's times are kept to a millisecond and finer."""
Matrices = NDArray[np.float64]


def moves(content: object) -> bool:
    """Whether it is a mesh with a skeleton or with shapes that it morphs into."""
    return isinstance(content, Mesh) and (content.skin is not None or bool(content.morphs))


def add_motion(
    stage: Usd.Stage, above: Sdf.Path, mesh: Any, content: Mesh, world_from_part: Matrices
) -> None:
    """Bind a mesh to its skeleton and shapes. above: the path of its SkelRoot."""
    from pxr import UsdSkel

    binding = UsdSkel.BindingAPI.Apply(mesh.GetPrim())
    if content.morphs:
        _add_morphs(stage, binding, mesh, content, world_from_part)
    if content.skin is None:
        return
    skeleton = UsdSkel.Skeleton.Define(stage, above.AppendChild("Skeleton"))
    _fill(skeleton, content.skin, world_from_part)
    _bind(binding, content.skin)
    binding.CreateSkeletonRel().SetTargets([skeleton.GetPath()])
    taken: set[str] = set()
    for number, clip in enumerate(content.clips):
        at = above.AppendChild(_unique(f"Clip_{clip.name}", taken))
        _add_clip(stage, at, joint_paths(content.skin), clip)
        if number == 0:
            own = UsdSkel.BindingAPI.Apply(skeleton.GetPrim())
            own.CreateAnimationSourceRel().SetTargets([at])


def joint_paths(skin: Skin) -> list[str]:
    """The name of each joint with those above it, as UsdSkel tells a tree of joints."""
    found: list[str] = []
    taken: set[str] = set()
    for name, parent in zip(skin.names, skin.parent.tolist(), strict=True):
        own = _unique(name, taken)
        found.append(own if parent < 0 else f"{found[parent]}/{own}")
    return found


def _fill(skeleton: Any, skin: Skin, world_from_part: Matrices) -> None:
    """Joints with their rest pose, and the pose in which the mesh is bound to them."""
    skeleton.CreateJointsAttr(joint_paths(skin))
    skeleton.CreateRestTransformsAttr(_matrices(skin.rest_in_parent()))
    skeleton.CreateBindTransformsAttr(_matrices(world_from_part @ skin.rest))
    skeleton.AddTransformOp().Set(_matrices(world_from_part[None])[0])


def _bind(binding: Any, skin: Skin) -> None:
    """How much each vertex follows which joints."""
    from pxr import Gf, Vt

    count = skin.joints.shape[1]
    numbers = np.ascontiguousarray(skin.joints.reshape(-1).astype(np.int32))
    weights = np.ascontiguousarray(skin.weights.reshape(-1).astype(np.float32))
    binding.CreateJointIndicesPrimvar(False, count).Set(Vt.IntArray.FromNumpy(numbers))
    binding.CreateJointWeightsPrimvar(False, count).Set(Vt.FloatArray.FromNumpy(weights))
    binding.CreateGeomBindTransformAttr(Gf.Matrix4d(1.0))


def _add_clip(stage: Usd.Stage, at: Sdf.Path, joints: list[str], clip: Clip) -> None:
    from pxr import Gf, UsdSkel, Vt

    stage.SetTimeCodesPerSecond(CODES_A_SECOND)
    animation = UsdSkel.Animation.Define(stage, at)
    animation.GetPrim().SetDisplayName(clip.name)
    animation.GetPrim().SetCustomDataByKey("veduta:loops", clip.loops)
    animation.CreateJointsAttr(joints)
    moved, turned = animation.CreateTranslationsAttr(), animation.CreateRotationsAttr()
    animation.CreateScalesAttr(Vt.Vec3hArray([Gf.Vec3h(1.0, 1.0, 1.0)] * len(joints)))
    for row, time in enumerate((clip.times_s * CODES_A_SECOND).tolist()):
        places = np.ascontiguousarray(clip.translations_m[row].astype(np.float32))
        moved.Set(Vt.Vec3fArray.FromNumpy(places), time)
        turns = [Gf.Quatf(w, x, y, z) for x, y, z, w in clip.rotations_xyzw[row].tolist()]
        turned.Set(Vt.QuatfArray(turns), time)
    end = max(float(clip.times_s[-1]) * CODES_A_SECOND, stage.GetEndTimeCode())
    stage.SetStartTimeCode(0.0)
    stage.SetEndTimeCode(end)


def _add_morphs(
    stage: Usd.Stage, binding: Any, mesh: Any, content: Mesh, world_from_part: Matrices
) -> None:
    """What each vertex moves by at weight 1, as the mesh in the frame of the place."""
    from pxr import UsdSkel, Vt

    names, paths, taken = [], [], set[str]()
    for morph in content.morphs:
        name = _unique(morph.name, taken)
        at = mesh.GetPath().AppendChild(name)
        shape = UsdSkel.BlendShape.Define(stage, at)
        step = morph.positions_m.astype(np.float64) - content.positions_m.astype(np.float64)
        step = np.ascontiguousarray((step @ world_from_part[:3, :3].T).astype(np.float32))
        shape.CreateOffsetsAttr(Vt.Vec3fArray.FromNumpy(step))
        names.append(name)
        paths.append(at)
    binding.CreateBlendShapesAttr(names)
    binding.CreateBlendShapeTargetsRel().SetTargets(paths)


def _matrices(transforms: Matrices) -> Any:
    """(n, 4, 4) as USD has them: of rows."""
    from pxr import Gf, Vt

    return Vt.Matrix4dArray([Gf.Matrix4d(one.T.tolist()) for one in transforms])


def _unique(name: str, taken: set[str]) -> str:
    """A name that a prim may have, and none of the taken ones."""
    plain = re.sub(r"[^A-Za-z0-9_]", "_", name) or "_"
    plain = f"_{plain}" if plain[0].isdigit() else plain
    found, number = plain, 2
    while found in taken:
        found, number = f"{plain}_{number}", number + 1
    taken.add(found)
    return found
