"""The two photos that a map begins with, by the conditions of the thesis.

Algorithm 6, 2 (a), and section 2.5.2 of the thesis: the two views have known intrinsic parameters,
and the most matches of all that a homography does not model well; they are far enough apart for
points to be well placed. Where the thesis gives no number the one that is taken stands here.

Matches of a plane tell two poses, of which one is false (Faugeras and Lustman, Motion and structure
from motion in a piecewise planar environment, 1988), and a map that begins falsely may stay whole
and false. So what counts are the matches that a homography does not explain.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import cv2
import numpy as np
import pycolmap
from numpy.typing import NDArray

FEWEST = 20
"""Matches of a pair (n_min of algorithm 6)."""
SURE = 30
"""From so many matches off a plane on a pair with known focal lengths goes before one with more."""
MOST_PLANAR = 0.8
"""Share of the matches that a homography may explain. That by which the engine calls a pair
planar, too; true scenes with relief have 0.2 to 0.7."""
NEAR_SHARE = 0.002
"""Share of a photo's longer side up to which a homography explains a match."""
LEAST_ANGLE_DEG = 8.0
"""Median angle between the rays to the points of a pair."""
AHEAD = 0.9
"""Share of the way between two photos, along the view of the second, from which one moved ahead."""
LEAST_ANGLE_AHEAD_DEG = 0.5
"""That angle where one moved ahead: what one drives towards hardly moves. Photos taken on the spot,
half a pixel off, come to 0.05 degrees; a metre ahead in a street is 0.6 to 1.4, ten are 2 to 3."""
HOMOGRAPHY_DRAWS = 500
MOST_DRAWN = 1000
"""Matches of a pair that are looked at, drawn at random: thousands tell no more."""
MOST_WEIGHED = 150
"""Pairs that are weighed at most: those with most matches."""


@dataclass(frozen=True)
class WeighedPair:
    """Two photos (image ids), and what the conditions ask of them.

    matches: that are verified. planar: share of them that a homography explains. angle_deg: median
    angle between the rays to their points; None where no pose was found. known: whether the focal
    lengths of both are. ahead: share of the way between them that is along the second one's view.
    tied: whether one camera took both.
    """

    first: int
    second: int
    matches: int
    known: bool
    planar: float
    angle_deg: float | None
    ahead: float = 0.0
    tied: bool = False

    @property
    def telling(self) -> int:
        """Matches that no homography explains."""
        return round(self.matches * (1.0 - self.planar))

    @property
    def fault(self) -> str | None:
        """Which condition it does not meet; None where it meets all."""
        if self.planar > MOST_PLANAR:
            return f"a homography explains {self.planar:.0%} of the matches"
        if self.angle_deg is None:
            return "no pose was found"
        if self.angle_deg < LEAST_ANGLE_DEG:
            return f"the rays to their points are {self.angle_deg:.1f}° apart"
        return None

    @property
    def begins_ahead(self) -> bool:
        """Whether a map may begin with it where a camera that moves ahead has no better pair.

        Angles are small there, and a focal length of each photo's own would follow the noise.
        """
        return (
            self.telling >= SURE
            and self.planar <= MOST_PLANAR
            and self.ahead >= AHEAD
            and (self.known or self.tied)
            and self.angle_deg is not None
            and self.angle_deg >= LEAST_ANGLE_AHEAD_DEG
        )


@dataclass(frozen=True)
class Start:
    """The pair that a component was grown from.

    chosen_by: the conditions above, or the engine where they gave nothing to grow from, or that the
    camera moved ahead (`begins_ahead`), where neither did.
    passed_over: pairs that come before it and do not meet the conditions. refused: pairs that meet
    them and from which the engine could grow nothing.
    """

    pair: WeighedPair
    chosen_by: Literal["conditions", "engine", "ahead"]
    passed_over: int
    refused: int


def weighed_pairs(database: Path, image_ids: Sequence[int], seed: int) -> list[WeighedPair]:
    """The verified pairs of some photos, best first; none of photos of one frame of a rig.

    Known focal lengths first where there are enough matches off a plane, then by their number.
    """
    with pycolmap.Database.open(database) as opened:
        cameras = {image: _camera_of(opened, image) for image in image_ids}
        frame_of = _frame_of(opened)
        counted = [
            (first, second, count)
            for first, second, count in _counted(opened, set(image_ids))
            if frame_of.get(first, first) != frame_of.get(second, second)
        ]
        counted.sort(key=lambda one: _place(one[2], _are_known(one[:2], cameras), one[:2]))
        weighed = [
            _read_and_weigh(opened, (first, second), cameras, seed)
            for first, second, _ in counted[:MOST_WEIGHED]
        ]
    return sorted(weighed, key=lambda one: _place(one.telling, one.known, (one.first, one.second)))


def weighed_pair(database: Path, pair: tuple[int, int], seed: int) -> WeighedPair:
    """One pair of the database, weighed."""
    with pycolmap.Database.open(database) as opened:
        cameras = {image: _camera_of(opened, image) for image in pair}
        return _read_and_weigh(opened, pair, cameras, seed)


def _read_and_weigh(
    opened: pycolmap.Database,
    pair: tuple[int, int],
    cameras: Mapping[int, pycolmap.Camera],
    seed: int,
) -> WeighedPair:
    points = [opened.read_keypoints(image)[:, :2] for image in pair]
    matches = opened.read_two_view_geometry(*pair).inlier_matches
    return weigh(pair, [cameras[image] for image in pair], points, matches, seed)


def weigh(
    pair: tuple[int, int],
    cameras: Sequence[pycolmap.Camera],
    points: Sequence[NDArray[np.floating]],
    matches: NDArray[np.integer],
    seed: int,
) -> WeighedPair:
    """What the conditions ask of two photos.

    points: (k, 2) the features of each (px). matches: (m, 2) rows of them that agree.
    """
    drawn = matches[np.random.default_rng(seed).permutation(len(matches))[:MOST_DRAWN]]
    own = [
        np.ascontiguousarray(places[drawn[:, side]], dtype=np.float64)
        for side, places in enumerate(points)
    ]
    known = all(camera.has_prior_focal_length for camera in cameras)
    planar = _planar_share(own, cameras[1], seed)
    angle, ahead = _angle_and_way(cameras, own, seed)
    tied = cameras[0].camera_id == cameras[1].camera_id
    return WeighedPair(*pair, len(matches), known, planar, angle, ahead, tied)


def _camera_of(opened: pycolmap.Database, image: int) -> pycolmap.Camera:
    return opened.read_camera(opened.read_image(image).camera_id)


def _frame_of(opened: pycolmap.Database) -> dict[int, int]:
    """The frame of each photo, by image id: those of one frame of a rig begin no map."""
    return {
        int(data.id): int(frame.frame_id)
        for frame in opened.read_all_frames()
        for data in frame.data_ids
    }


def _counted(opened: pycolmap.Database, images: set[int]) -> list[tuple[int, int, int]]:
    """Pairs with enough verified matches, and how many."""
    found = []
    for pair_id, count in zip(*opened.read_two_view_geometry_num_inliers(), strict=True):
        first, second = sorted(pycolmap.pair_id_to_image_pair(pair_id))
        if count >= FEWEST and {first, second} <= images:
            found.append((first, second, int(count)))
    return found


def _are_known(pair: tuple[int, int], cameras: Mapping[int, pycolmap.Camera]) -> bool:
    """Whether the focal lengths of both photos are known beforehand."""
    return all(cameras[image].has_prior_focal_length for image in pair)


def _place(matches: int, known: bool, pair: tuple[int, int]) -> tuple[bool, bool, int, int, int]:
    """Where a pair with so many matches stands in the order."""
    return (matches < SURE, not known, -matches, *pair)


def _planar_share(
    points: Sequence[NDArray[np.float64]], camera: pycolmap.Camera, seed: int
) -> float:
    """Share of the matches that the best homography explains."""
    near_px = NEAR_SHARE * max(camera.width, camera.height)
    cv2.setRNGSeed(seed)
    _, explained = cv2.findHomography(
        points[0], points[1], cv2.USAC_DEFAULT, near_px, None, HOMOGRAPHY_DRAWS
    )
    return 0.0 if explained is None else float(np.mean(explained))


def _angle_and_way(
    cameras: Sequence[pycolmap.Camera], points: Sequence[NDArray[np.float64]], seed: int
) -> tuple[float | None, float]:
    """Of the pose that the essential matrix gives (2.26, 2.27): the median angle between the rays,
    and the share of the way that is along the second one's view.
    """
    options = pycolmap.TwoViewGeometryOptions()
    options.ransac.random_seed = seed
    options.compute_relative_pose = True
    rows = np.repeat(np.arange(len(points[0]), dtype=np.uint32)[:, None], 2, axis=1)
    found = pycolmap.estimate_calibrated_two_view_geometry(
        cameras[0], points[0], cameras[1], points[1], rows, options
    )
    if found.cam2_from_cam1 is None or found.tri_angle <= 0.0:
        return None, 0.0
    way = np.asarray(found.cam2_from_cam1.translation)
    ahead = abs(float(way[2])) / max(float(np.linalg.norm(way)), 1e-12)
    return float(np.rad2deg(found.tri_angle)), ahead
