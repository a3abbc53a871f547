"""One transition of the walk, from two local models: pose, morphs, meshes, and what they are worth."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from veduta.run.errors import NotFoundError
from veduta.walk.build.flow import FlowSettings
from veduta.walk.build.judge import JudgeLimits, Verdict, judge
from veduta.walk.build.level import compare_colours, levelled
from veduta.walk.build.local_model import LocalModel
from veduta.walk.build.marks import RED, painted
from veduta.walk.build.matches import match_features
from veduta.walk.build.mesh import MeshSettings, MorphMesh, mesh_of
from veduta.walk.build.morph import find_morphs, inverse
from veduta.walk.build.moving import find_moving
from veduta.walk.build.pose import Pose, relative_pose
from veduta.walk.build.sampling import sampled
from veduta.walk.rig import Image, Rig

Matrix = NDArray[np.float64]


@dataclass(frozen=True)
class WaySettings:
    """The parameters of a transition's steps."""

    flow: FlowSettings = FlowSettings()
    mesh: MeshSettings = MeshSettings()
    judge: JudgeLimits = JudgeLimits()


@dataclass(frozen=True, eq=False)
class Way:
    """A transition. forth, back: None where the two key positions have nothing in common.

    predicted: the end's view from the start's colours, levelled. ratio: by how much brighter the
    second picture is in each channel; None where too little is in common to say. moving: share of
    the start's and of the end's view that shows what moved, and shown: the start's view with that
    painted, where there is any. beside: of a cut, both views side by side.
    """

    second_from_first: Matrix
    forth: MorphMesh | None = None
    back: MorphMesh | None = None
    verdict: Verdict | None = None
    predicted: Image | None = None
    matches: int = 0
    residual_px: float | None = None
    energies: tuple[float, float, float] | None = None
    why: str = ""
    ratio: tuple[float, float, float] | None = None
    moving: tuple[float, float] = (0.0, 0.0)
    shown: Image | None = None
    beside: Image | None = None

    @property
    def distance_m(self) -> float:
        """Between the two left cameras."""
        return float(np.linalg.norm(self.second_from_first[:, 3]))

    @property
    def kind(self) -> Literal["morph", "fade", "cut"]:
        """morph, fade or cut."""
        if self.forth is None or self.back is None:
            return "cut"
        return "fade" if self.why else "morph"


def side_by_side(left: Image, right: Image) -> Image:
    """Two pictures in one; mosaics differ in height by a row or two, which is cut off."""
    height = min(len(left), len(right))
    return np.concatenate([left[:height], right[:height]], axis=1)


def find_way(
    first: LocalModel, second: LocalModel, rig: Rig, settings: WaySettings = WaySettings(),
    given: Matrix | None = None,
) -> Way:  # fmt: skip
    """From one key position to the next; a cut where nothing is in common.

    given: (3, 4) second_from_first where it is known; then it is not sought.
    """
    found: Pose | None = None
    pose = given
    if pose is None:
        matches = match_features(first.plane, second.plane)
        try:
            found = relative_pose(first.plane, second.plane, rig, matches)
        except NotFoundError as error:
            both = side_by_side(first.image, second.image)
            return Way(np.eye(4)[:3], why=error.evidence, beside=both)
        pose = found.second_from_first
    stereo_px_m = rig.focal_px[0] * rig.baseline_m
    moving = (
        find_moving(first, second, pose, stereo_px_m),
        find_moving(second, first, inverse(pose), stereo_px_m),
    )
    forth, back = find_morphs(first, second, pose, settings.flow, moving=moving)
    meshes = mesh_of(forth, settings.mesh), mesh_of(back, settings.mesh)
    psi = float(forth.region.mean()), float(back.region.mean())
    shared = forth.region & ~first.sky
    ratio = compare_colours(first.image[shared], sampled(second.image, forth.target)[shared])
    gain = np.array(ratio or (1.0, 1.0, 1.0))
    there, picture = judge(
        meshes[0], pose, (first.screen, second.screen), levelled(first.image, gain), second.image,
        psi[0], settings.judge,
    )  # fmt: skip
    here, _ = judge(
        meshes[1], inverse(pose), (second.screen, first.screen),
        levelled(second.image, 1.0 / gain), first.image, psi[1], settings.judge,
    )  # fmt: skip
    labelling = forth.flow.labelling
    return Way(
        pose, *meshes, there, picture, 0 if found is None else int(found.inliers.sum()),
        None if found is None else found.residual_px,
        (labelling.energy, labelling.energy_icm, labelling.bound), there.why or here.why, ratio,
        (float(moving[0].mean()), float(moving[1].mean())),
        painted(first.image, ((moving[0], RED),)) if moving[0].any() else None,
    )  # fmt: skip
