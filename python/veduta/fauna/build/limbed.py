"""The whole of an animal with limbs from its document: skin, skeleton, clips."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from veduta.fauna.build.limbed_body import BodyLooks, Hull, hull_of
from veduta.fauna.build.limbed_clips import footage_clip, joined_clip, stride_clip
from veduta.fauna.build.limbed_coat import dressed
from veduta.fauna.build.limbed_skeleton import Bones, bones_of, limbed_skin
from veduta.fauna.document.limbed import LimbedAnimal
from veduta.fauna.motion.joined import joined_gaits
from veduta.fauna.motion.stride import Stride, stride_of
from veduta.place.features import feature_table
from veduta.place.manifest import AnimalClip
from veduta.place.material import Texture
from veduta.place.mesh import Mesh
from veduta.place.semantics import Provenance, SemanticClass
from veduta.place.skin import Clip


@dataclass(frozen=True, eq=False)
class BuiltLimbed:
    """The animal as a mesh with clips (the usual one first), and its strides."""

    mesh: Mesh
    bones: Bones
    strides: tuple[Stride, ...]
    clips: tuple[AnimalClip, ...]
    doubts: tuple[str, ...]


def build_limbed(
    animal: LimbedAnimal, coat: Texture | None = None, speed: float | None = None
) -> BuiltLimbed:
    """All that follows from a document, edited or not. speed: lengths a second, else the gait's."""
    bones = bones_of(animal)
    hull = hull_of(bones, BodyLooks())
    strides = []
    for gait in animal.gaits:
        cycle = gait.cycle_s if speed is None or gait.stride <= 0.0 else gait.stride / speed
        gait = gait.model_copy(update={"cycle_s": cycle})
        strides.append(stride_of(animal, bones.figure, gait))
    clips = [stride_clip(stride, bones, animal) for stride in strides]
    joined = joined_gaits(bones.figure, tuple(strides), side=animal.plan.view == "side")
    clips += [] if joined is None else [joined_clip(joined, bones, animal)]
    pace = speed or _pace(animal)
    seen = footage_clip(animal, bones, pace)
    clips += [] if seen is None else [seen]
    doubts = [
        f"in the clip {stride.name} a standing foot is {stride.slides:.1%} of the body's length from"
        " its place"
        for stride in strides
        if stride.slides > 0.01
    ]
    told = tuple(_told(clip) for clip in clips)
    return BuiltLimbed(
        _mesh(animal, bones, hull, tuple(clips), coat), bones, tuple(strides), told, tuple(doubts)
    )


def _pace(animal: LimbedAnimal) -> float:
    if not animal.gaits:
        return 0.0
    return animal.gaits[0].stride / animal.gaits[0].cycle_s


def _told(clip: Clip) -> AnimalClip:
    return AnimalClip(
        name=clip.name, seconds=float(clip.times_s[-1]), loops=clip.loops,
        stride=float(clip.translations_m[-1, 0, 0]),
    )  # fmt: skip


def _mesh(
    animal: LimbedAnimal, bones: Bones, hull: Hull, clips: tuple[Clip, ...], coat: Texture | None
) -> Mesh:
    worn = dressed(bones, hull, coat, animal.seen)
    provenance = Provenance.MEASURED if animal.shape == "measured" else Provenance.INVENTED
    faces = len(worn.triangles)
    return Mesh(
        id=animal.name,
        positions_m=hull.positions[worn.vertex].astype(np.float32),
        triangles=worn.triangles,
        features=feature_table(
            animal.name,
            [
                (SemanticClass.OTHER, provenance, "body: the side that was seen"),
                (SemanticClass.OTHER, Provenance.INVENTED, "body: mirrored"),
            ],
        ),
        materials=(worn.material,),
        triangle_feature=worn.mirrored.astype(np.int32),
        triangle_material=np.zeros(faces, dtype=np.int32),
        normals=hull.normals[worn.vertex].astype(np.float32),
        uv=worn.uv.astype(np.float32),
        skin=limbed_skin(bones, hull.joints[worn.vertex], hull.weights[worn.vertex]),
        clips=clips,
        notes=tuple(animal.doubts),
    )
