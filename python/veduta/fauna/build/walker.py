"""What goes along a path: the skeleton of an animal with its usual clip, its legs and its spine."""

from __future__ import annotations

import numpy as np

from veduta.fauna.build.limbed import BuiltLimbed
from veduta.fauna.build.limbed_skeleton import Bones
from veduta.fauna.motion.carried import joints_in
from veduta.fauna.motion.figure import Floats, Limb
from veduta.fauna.motion.steps import Footing
from veduta.fauna.motion.stride import Stride
from veduta.fauna.motion.transfer import Leg, Walker
from veduta.place.mesh import Mesh
from veduta.place.skin import Clip, Skin

_LEAST_LIFT = 0.03
"""A foot swings so high at least, in lengths."""


def limbed_walker(built: BuiltLimbed) -> Walker | None:
    """An animal with limbs by its first gait; None where it has none that goes on."""
    skin, strides = built.mesh.skin, built.strides
    if skin is None or not strides or strides[0].stride <= 0.0:
        return None
    stride, bones = strides[0], built.bones
    clip = next(one for one in built.mesh.clips if one.name == stride.name)
    legs = tuple(
        _leg(skin, clip, bones, limb, stride)
        for limb in bones.figure.feet()
        if limb.name in stride.steps
    )
    spine = np.zeros(len(skin.names), dtype=np.bool_)
    for limb in bones.figure.limbs:
        if limb.side == "middle" and not limb.part.ground:
            spine[[segment + 1 for segment in limb.segments]] = True
    way = stride.stride * bones.length_m
    return Walker(skin, clip, way, bones.length_m, spine, legs)


def limbless_walker(mesh: Mesh, clip: str, length_m: float, *, swims: bool) -> Walker | None:
    """An animal without limbs by one of its clips; None where that does not go on."""
    if mesh.skin is None:
        return None
    chosen = next(one for one in mesh.clips if one.name == clip)
    way = float(chosen.translations_m[-1, 0, 0])
    if way <= 0.0:
        return None
    spine = np.ones(len(mesh.skin.names), dtype=np.bool_)
    spine[0] = False
    return Walker(mesh.skin, chosen, way, length_m, spine, (), swims)


def _leg(skin: Skin, clip: Clip, bones: Bones, limb: Limb, stride: Stride) -> Leg:
    """A leg with its steps: where its foot stands, on average, and how high it swings."""
    down, up = stride.steps[limb.name]
    joints = tuple(segment + 1 for segment in limb.segments)
    last = limb.segments[-1]
    end_m = bones.end_m[last] - bones.start_m[last]
    duty = (up - down) % 1.0
    phase = (down + duty * np.linspace(0.0, 1.0, 9)) % 1.0
    swing = (up + (1.0 - duty) * np.linspace(0.0, 1.0, 9)) % 1.0
    seconds = float(clip.times_s[-1])

    def ends(at: Floats) -> Floats:
        return joints_in(skin, clip, at * seconds).ends(joints[-1], end_m)

    stands, swings = ends(phase), ends(swing)
    sole = float(bones.deep_m[last, 1]) * (1.0 if bones.across == 1 else float(bones.round[last]))
    carried = stands[:, 0] + stride.stride * bones.length_m * duty * np.linspace(-0.5, 0.5, 9)
    lift = max(float(swings[:, 2].max()) - sole, _LEAST_LIFT * bones.length_m)
    foot = Footing(
        limb.name, down, up, float(carried.mean()), float(stands[:, 1].mean()), lift, sole
    )
    return Leg(foot, joints, end_m)
