"""Lens model, principal point and sharing of cameras, chosen by observations that no fit has seen.

The observations of long tracks are held out in five parts, one part after the other (k-fold cross
validation; Stone, 1974). For each candidate the bundle is adjusted to the others, and the points
that it gives are projected into the photos of the held-out ones. A model that is too poor leaves
them far from where they were seen, and so does one that follows the noise. The simplest candidate
is taken that is not worse than the best by more than two standard errors of their difference.
Photos, and not observations, count as independent there, because the errors of one photo go
together; two and not one, because the best of a dozen is best by chance. Candidates that are
clearly worse after some parts are not tried on further ones (a race; Maron and Moore, 1994).

What a held-out observation costs is bounded (Geman and McClure): false matches, and points whose
place is known badly, leave errors of many pixels whatever the camera, and with squared errors
their chance decides. The adjustment bounds them, too (Cauchy's loss): with squares it had not
settled after a hundred steps, because points of false matches ran off to infinity.

One part alone is too few: in it, the tangential terms of one camera of 24 photos are worth two
standard errors, though to all observations they are worth about 140 in chi square; 26 of 30
simulated sets came out right, and 40 of 40 with five parts.

The principal point may only leave the middle where several photos share a camera. One photo alone
cannot tell it from a turn of the camera: on fountain-P11 free ones for each photo move the cameras
by 6 to 36 mm, a shared one by 3 mm, and the held-out errors of all of these are the same.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
import pycolmap
from numpy.typing import NDArray

from veduta.photos.options import CameraOptions, Lens, PrincipalPoint, Sharing
from veduta.photos.structure import Structure, adjusted, errors_px

MODELS: Mapping[Lens, str] = {
    "pinhole": "PINHOLE",
    "simple-radial": "SIMPLE_RADIAL",
    "radial": "RADIAL",
    "opencv": "OPENCV",
    "fisheye": "OPENCV_FISHEYE",
}
AUTO: tuple[Lens, ...] = ("pinhole", "simple-radial", "radial", "opencv")
"""What is tried where nothing is said: a fisheye's photos are mapped otherwise from the start."""
PARTS = 5
"""Observations are held out in so many parts, one after the other."""
FEWEST_HELD_OUT = 10
"""Observations of each part: fewer say nothing, and the simplest kind is taken."""
SHORTEST_TRACK = 4
"""Of shorter tracks nothing is held out: three observations have to stay."""
MOST_POINTS, FEWEST_POINTS, POINTS_PER_PHOTO = 5000, 1200, 200
"""Points that the choice is made on: so many per photo, within bounds. More do not change it and
take their time: of seven photos 1,200 points chose as 4,445 did, in a third of the time."""
MOST_ERROR_PX = 8.0
"""A larger error of a held-out observation counts as this in the reported mean."""
HALF_COST = 2.0
"""The error of half the bound on the cost, in medians of the best candidate's errors."""
CHANCE = 2.0
"""Standard errors by which a simpler candidate may be worse."""
HEAT_POINTS = 600
"""Points of a first race, that leaves out what is worse by far."""
OUT_OF_THE_HEAT = 4.0
"""Standard errors there, which few photos tell badly."""
OUT_OF_THE_RACE = 3.0
"""Standard errors by which a candidate is worse that is not tried on further parts."""

FEWEST_SHARING = 5
"""Photos of a camera from which its principal point is found."""


@dataclass(frozen=True)
class CameraKind:
    """What is assumed of the cameras."""

    lens: Lens
    sharing: Sharing
    principal_point: PrincipalPoint


@dataclass(frozen=True)
class Candidate:
    """A kind of camera, and the held-out errors that it left.

    parameters: how many numbers describe all cameras of this kind. errors_px: (h,) infinite behind
    the camera. photo_of: (h,) the photo of each.
    """

    kind: CameraKind
    parameters: int
    errors_px: NDArray[np.float64]
    photo_of: NDArray[np.int64]

    @property
    def error_px(self) -> float:
        """Root mean square, false matches bounded."""
        return float(np.sqrt(np.mean(np.minimum(self.errors_px, MOST_ERROR_PX) ** 2)))

    def costs(self, half_px: float) -> NDArray[np.float64]:
        """(h,) from 0 to 1; a half at an error of `half_px`."""
        squared = np.minimum(self.errors_px, 1e6) ** 2
        costs: NDArray[np.float64] = squared / (squared + half_px**2)
        return costs


@dataclass(frozen=True)
class LensChoice:
    """The kind of camera that was chosen; `tried` is in the order of simplicity."""

    kind: CameraKind
    tried: tuple[Candidate, ...]


def choose_lens(
    structure: Structure, options: CameraOptions, groups: Mapping[int, int], seed: int
) -> LensChoice:
    """Choose among what the options leave open.

    groups: of each photo (its image id), the group of photos that could share a camera.
    """
    kinds = _kinds(structure, options, groups)
    if len(kinds) == 1:
        return LensChoice(kinds[0], ())
    rng = np.random.default_rng(seed)
    wanted = POINTS_PER_PHOTO * len(structure.names)
    sample = structure.sampled(min(MOST_POINTS, max(FEWEST_POINTS, wanted)), rng)
    part_of = held_out_parts(sample, rng)
    if np.bincount(part_of[part_of >= 0], minlength=PARTS).min() < FEWEST_HELD_OUT:
        return LensChoice(kinds[0], ())
    kinds = _after_a_heat(sample, kinds, groups, rng)
    starts = {kind: with_cameras(sample, kind, groups) for kind in kinds}
    tried, fitted = _race_on(sample, part_of == 0, starts)
    tried.sort(key=lambda candidate: candidate.parameters)
    for part in range(1, PARTS):
        close = [one.kind for one in not_worse(tried, OUT_OF_THE_RACE)]
        if len(close) == 1:
            break
        # What fits the other parts is nearly there, and takes a third of the steps.
        more, _ = _race_on(sample, part_of == part, {kind: fitted[kind] for kind in close})
        tried = [_joined(one, more) for one in tried]
    return LensChoice(simplest_of(tried).kind, tuple(tried))


def _after_a_heat(
    sample: Structure,
    kinds: list[CameraKind],
    groups: Mapping[int, int],
    rng: np.random.Generator,
) -> list[CameraKind]:
    """Those that are not clearly worse on few points: the others would take most of the time."""
    few = sample.sampled(HEAT_POINTS, rng)
    if len(few.points) >= len(sample.points):
        return kinds
    part_of = held_out_parts(few, rng)
    if int((part_of == 0).sum()) < FEWEST_HELD_OUT:
        return kinds
    tried, _ = _race_on(
        few, part_of == 0, {kind: with_cameras(few, kind, groups) for kind in kinds}
    )
    left = {one.kind for one in not_worse(tried, OUT_OF_THE_HEAT)}
    return [kind for kind in kinds if kind in left]


def _kinds(
    structure: Structure, options: CameraOptions, groups: Mapping[int, int]
) -> list[CameraKind]:
    """What the options leave open, and the photos can tell."""
    own = [image for image in structure.image_ids if image not in structure.views]
    if not own:
        return [CameraKind("pinhole", "shared", "middle")]
    lenses: Sequence[Lens] = AUTO if options.lens == "auto" else (options.lens,)
    sharings: Sequence[Sharing] = (
        ("shared", "per-photo") if options.cameras == "auto" else (options.cameras,)
    )
    sizes = Counter(groups[image] for image in own)
    if max(sizes.values()) == 1 and options.cameras == "auto":
        sharings = ("per-photo",)
    if all(image in structure.frame_of for image in own):
        sharings = ("shared",)
    kinds = []
    for sharing in sharings:
        places: Sequence[PrincipalPoint] = ("middle", "free")
        if options.principal_point != "auto":
            places = (options.principal_point,)
        elif (
            sharing == "per-photo"
            or min(sizes.values()) < FEWEST_SHARING
            or options.focal_px is not None
        ):
            # With a focal length that is held, an error of it would go into the middle. A drive
            # ahead cannot tell the one from the other.
            places = ("middle",)
        kinds += [CameraKind(lens, sharing, place) for place in places for lens in lenses]
    return kinds


def simplest_of(tried: Sequence[Candidate]) -> Candidate:
    """The first of candidates (simple ones first) that is as good as the best, but for chance."""
    return not_worse(tried, CHANCE)[0]


def not_worse(tried: Sequence[Candidate], chance: float) -> list[Candidate]:
    """The best of the candidates, and those worse by at most so many standard errors.

    Only those count that were tried on most parts; their observations are the same.
    """
    most = max(len(one.errors_px) for one in tried)
    left = [one for one in tried if len(one.errors_px) == most]
    half_px = HALF_COST * max(min(float(np.median(one.errors_px)) for one in left), 1e-9)
    costs = [one.costs(half_px) for one in left]
    best = min(costs, key=lambda cost: float(cost.mean()))
    found = []
    for one, cost in zip(left, costs, strict=True):
        worse = cost - best
        if float(worse.mean()) <= chance * _doubt(worse, one.photo_of):
            found.append(one)
    return found


def _doubt(worse: NDArray[np.float64], photo_of: NDArray[np.int64]) -> float:
    """Standard error of the mean of (h,) values that depend on each other within a photo."""
    rest = np.bincount(photo_of, weights=worse - worse.mean())
    photos = len(np.unique(photo_of))
    if photos < 2:
        return 0.0
    return float(np.sqrt((rest**2).sum() * photos / (photos - 1)) / len(worse))


def with_cameras(structure: Structure, kind: CameraKind, groups: Mapping[int, int]) -> Structure:
    """The same poses and points, seen by cameras of this kind, before they are adjusted.

    Each camera of a rig is one, whatever the others are, and views of panoramas keep theirs.
    """
    after = max(structure.image_ids)
    own = {}
    for image in structure.image_ids:
        fixed = image in structure.frame_of or image in structure.views
        alone = after + groups[image] if fixed else image
        own[image] = groups[image] if kind.sharing == "shared" else alone
    cameras: dict[int, pycolmap.Camera] = {}
    for number in sorted(set(own.values())):
        images = [image for image, camera in own.items() if camera == number]
        if images[0] in structure.views:
            cut = structure.cameras[structure.camera_of[images[0]]]
            cameras[number] = pycolmap.Camera({**cut.todict(), "camera_id": number})
            continue
        known = [structure.cameras[structure.camera_of[image]] for image in images]
        focal = float(np.median([camera.mean_focal_length() for camera in known]))
        camera = pycolmap.Camera.create_from_model_name(
            number, MODELS[kind.lens], focal, known[0].width, known[0].height
        )
        cameras[number] = camera
    return structure.with_cameras(cameras, own)


def held_out_parts(sample: Structure, rng: np.random.Generator) -> NDArray[np.int64]:
    """(o,) the part, of `PARTS`, that each observation is held out with; -1 in short tracks.

    The observations of a track are spread over the parts as evenly as can be, so that most of
    them are always left.
    """
    draws = rng.random(len(sample.point_of))
    order = np.lexsort((draws, sample.point_of))
    point_of = sample.point_of[order]
    starts = np.searchsorted(point_of, np.arange(len(sample.points) + 1))
    within_track = np.arange(len(order)) - starts[point_of]
    first = rng.integers(0, PARTS, len(sample.points))
    part_of = np.empty(len(order), dtype=np.int64)
    part_of[order] = (first[point_of] + within_track) % PARTS
    part_of[np.diff(starts)[sample.point_of] < SHORTEST_TRACK] = -1
    return part_of


def _race_on(
    sample: Structure, held_out: NDArray[np.bool_], starts: Mapping[CameraKind, Structure]
) -> tuple[list[Candidate], dict[CameraKind, Structure]]:
    """The candidates with their errors on what is held out, and what was fitted to the rest.

    starts: cameras, poses and points from which the fit of each kind starts.
    """
    tried, fitted = [], {}
    for kind, start in starts.items():
        free = kind.principal_point == "free"
        fit = adjusted(
            start.seeing(sample, ~held_out), free_principal_point=free, false_matches=True
        )
        judged = fit.seeing(sample, held_out)
        fixed = 0 if free else 2
        parameters = sum(len(camera.params) - fixed for camera in fit.cameras.values())
        tried.append(Candidate(kind, parameters, errors_px(judged), judged.image_of))
        fitted[kind] = fit
    return tried, fitted


def _joined(candidate: Candidate, more: Sequence[Candidate]) -> Candidate:
    """With the errors that its kind left on another part, if it was tried there."""
    for other in more:
        if other.kind == candidate.kind:
            return replace(
                candidate,
                errors_px=np.concatenate([candidate.errors_px, other.errors_px]),
                photo_of=np.concatenate([candidate.photo_of, other.photo_of]),
            )
    return candidate
