"""What structure from motion knows, as columns: cameras, poses, points and observations.

The engine keeps an object per point and per observation; the columns are what our own steps work
on. `adjusted` hands them to the engine's bundle adjustment and takes the result back.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
import pycolmap
from numpy.typing import NDArray

from veduta.photos.intake.source import View
from veduta.photos.mapping.engine import quiet_engine
from veduta.photos.rigged import (
    add_rig,
    fixed_to_each_other,
    frames_in,
    has_length,
    rigs_among,
)
from veduta.run.errors import NotFoundError

PARALLEL_RAD = np.deg2rad(0.1)
"""Lines of sight that meet at less tell a distance to no better than a quarter of it."""
FEWEST_KEPT, KEPT_SHARE = 100, 0.5
"""A structure of which fewer points, or a smaller share of them, were left, is that of a survey
from afar: its points stay.
"""
STRAY_SHARE = 0.02
"""Share of the points at each end of each axis that lie far off."""
CAUCHY_PX = 1.0
"""An error from which on it speaks for a false match."""
SETTLED = 1e-5
"""Share of the cost by which a step of the robust adjustment has to lower it, to be not the last.

Ten to fifteen steps; a hundred lower the cost by another 0.01 ‰, and models whose difference
matters are 10 ‰ apart.
"""
_REMEDY = "Choose the lens model and the sharing of cameras yourself (--lens, --cameras)."


@dataclass(frozen=True)
class Structure:
    """One connected model; its frame and its scale are its own.

    cameras: by camera id. camera_of: the camera id of each image id.
    image_ids, names: of the n photos that have a pose. cam_from_world: (n, 3, 4).
    keypoints_px: (k, 2) of each photo, x right and y down.
    points: (p, 3). colours: (p, 3) uint8.
    image_of, keypoint_of, point_of: (o,) the photo (row), its keypoint and the point (row) of each
    observation. frame_of: the frame of each photo that was taken with others by a rig, by image id;
    those of one frame keep their places to each other. rig_held: these are given, and stay.
    focal_held: focal lengths are given, and stay. views: by image id, of photos that were cut out
    of panoramas: their lenses stay, and so do the places of those of one body to each other.
    """

    cameras: Mapping[int, pycolmap.Camera]
    camera_of: Mapping[int, int]
    image_ids: tuple[int, ...]
    names: tuple[str, ...]
    cam_from_world: NDArray[np.float64]
    keypoints_px: tuple[NDArray[np.float64], ...]
    points: NDArray[np.float64]
    colours: NDArray[np.uint8]
    image_of: NDArray[np.int64]
    keypoint_of: NDArray[np.int64]
    point_of: NDArray[np.int64]
    frame_of: Mapping[int, int] = field(default_factory=dict)
    rig_held: bool = False
    focal_held: bool = False
    views: Mapping[int, View] = field(default_factory=dict)

    def camera(self, row: int) -> pycolmap.Camera:
        """The camera of a photo, by its row."""
        return self.cameras[self.camera_of[self.image_ids[row]]]

    def body_cameras(self) -> dict[int, str]:
        """The body of each camera (its id) that views of panoramas have."""
        there = self.camera_of
        return {there[image]: view.body for image, view in self.views.items() if image in there}

    def centres(self) -> NDArray[np.float64]:
        """(n, 3) where the photos were taken."""
        rotations, shifts = self.cam_from_world[:, :, :3], self.cam_from_world[:, :, 3]
        centres: NDArray[np.float64] = -np.einsum("nji,nj->ni", rotations, shifts)
        return centres

    def seen_box(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Lower and upper corner around the photos and nearly all points: a few lie far off."""
        low, high = np.quantile(self.points, [STRAY_SHARE, 1.0 - STRAY_SHARE], axis=0)
        centres = self.centres()
        return np.minimum(low, centres.min(axis=0)), np.maximum(high, centres.max(axis=0))

    def with_cameras(
        self, cameras: Mapping[int, pycolmap.Camera], camera_of: Mapping[int, int]
    ) -> Structure:
        """The same, seen by other cameras."""
        return replace(self, cameras=cameras, camera_of=camera_of)

    def by_frame(self) -> NDArray[np.int64]:
        """(n,) a number for each photo, which those of one frame of a rig share."""
        own = [self.frame_of.get(image, -image) for image in self.image_ids]
        numbers: NDArray[np.int64] = np.unique(own, return_inverse=True)[1]
        return numbers

    def observed(self, kept: NDArray[np.bool_]) -> Structure:
        """The same with some of the observations."""
        return replace(
            self,
            image_of=self.image_of[kept],
            keypoint_of=self.keypoint_of[kept],
            point_of=self.point_of[kept],
        )

    def seeing(self, other: Structure, kept: NDArray[np.bool_]) -> Structure:
        """This one's cameras and points with some of the observations of another of them."""
        return replace(
            self,
            image_of=other.image_of[kept],
            keypoint_of=other.keypoint_of[kept],
            point_of=other.point_of[kept],
        )

    def sampled(self, most: int, rng: np.random.Generator) -> Structure:
        """The same with at most so many of the points, drawn at random."""
        if len(self.points) <= most:
            return self
        kept = np.zeros(len(self.points), dtype=bool)
        kept[rng.choice(len(self.points), most, replace=False)] = True
        return self.with_points(kept)

    def without_photos(self, weak: NDArray[np.bool_]) -> Structure:
        """The same without some of the photos (by row), nor points that fewer than two see then."""
        row_of = np.cumsum(~weak) - 1
        kept = np.flatnonzero(~weak).tolist()
        ids = tuple(self.image_ids[row] for row in kept)
        seen = self.observed(~weak[self.image_of])
        found = replace(
            seen,
            cameras={self.camera_of[image]: self.cameras[self.camera_of[image]] for image in ids},
            camera_of={image: self.camera_of[image] for image in ids},
            image_ids=ids,
            names=tuple(self.names[row] for row in kept),
            cam_from_world=self.cam_from_world[kept],
            keypoints_px=tuple(self.keypoints_px[row] for row in kept),
            image_of=row_of[seen.image_of],
        )
        return found.with_points(np.bincount(found.point_of, minlength=len(self.points)) >= 2)

    def without_doubtful(self, doubtful: NDArray[np.bool_]) -> tuple[Structure, tuple[str, ...]]:
        """The same without doubtful photos (by row), and the names of those that stay all the same.

        Where fewer than two would be left, all stay.
        """
        if not doubtful.any():
            return self, ()
        if np.count_nonzero(~doubtful) < 2:
            return self, tuple(self.names[row] for row in np.flatnonzero(doubtful))
        return self.without_photos(doubtful), ()

    def with_points(self, kept: NDArray[np.bool_]) -> Structure:
        """The same with some of the points, and their observations."""
        number = np.cumsum(kept) - 1
        seen = kept[self.point_of]
        return replace(
            self.observed(seen),
            points=self.points[kept],
            colours=self.colours[kept],
            point_of=number[self.point_of[seen]],
        )


def observed_px(structure: Structure) -> NDArray[np.float64]:
    """(o, 2) where each observation was seen."""
    found = np.empty((len(structure.image_of), 2))
    for row, keypoints in enumerate(structure.keypoints_px):
        own = structure.image_of == row
        found[own] = keypoints[structure.keypoint_of[own]]
    return found


def projected_px(structure: Structure) -> NDArray[np.float64]:
    """(o, 2) where each observation's point comes to lie; NaN behind the camera."""
    found = np.full((len(structure.image_of), 2), np.nan)
    for row, pose in enumerate(structure.cam_from_world):
        own = np.flatnonzero(structure.image_of == row)
        points = structure.points[structure.point_of[own]] @ pose[:, :3].T + pose[:, 3]
        ahead = points[:, 2] > 0
        found[own[ahead]] = structure.camera(row).img_from_cam(points[ahead])
    return found


def errors_px(structure: Structure) -> NDArray[np.float64]:
    """(o,) distance of each observation from its point's projection; infinite behind the camera."""
    error = np.linalg.norm(projected_px(structure) - observed_px(structure), axis=1)
    found: NDArray[np.float64] = np.nan_to_num(error, nan=np.inf)
    return found


def structure_of(model: pycolmap.Reconstruction, names: Mapping[int, str]) -> Structure:
    """The columns of an engine's model; `names` are the photos' own, by image id."""
    image_ids = tuple(sorted(model.reg_image_ids()))
    row_of = {image: row for row, image in enumerate(image_ids)}
    images = [model.images[image] for image in image_ids]
    points = [model.points3D[number] for number in sorted(model.points3D)]
    seen = [
        (row_of[element.image_id], element.point2D_idx, number)
        for number, point in enumerate(points)
        for element in point.track.elements
    ]
    columns = np.array(seen, dtype=np.int64).reshape(-1, 3)
    used = {image.camera_id for image in images}
    return Structure(
        cameras={number: pycolmap.Camera(model.cameras[number].todict()) for number in used},
        camera_of={image.image_id: image.camera_id for image in images},
        image_ids=image_ids,
        names=tuple(names[image] for image in image_ids),
        cam_from_world=np.array([image.cam_from_world().matrix() for image in images]),
        keypoints_px=tuple(
            np.array([point.xy for point in image.points2D]).reshape(-1, 2) for image in images
        ),
        points=np.array([point.xyz for point in points]).reshape(-1, 3),
        colours=np.array([point.color for point in points], dtype=np.uint8).reshape(-1, 3),
        image_of=columns[:, 0],
        keypoint_of=columns[:, 1],
        point_of=columns[:, 2],
        frame_of=frames_in(model),
    )


def model_of(structure: Structure) -> pycolmap.Reconstruction:
    """The engine's model of the columns; points that fewer than two photos see are left out."""
    model = pycolmap.Reconstruction()
    poses = dict(zip(structure.image_ids, structure.cam_from_world, strict=True))
    first = structure.body_cameras()
    rigs = rigs_among(poses, structure.camera_of, structure.frame_of, first)
    of_rigs = {camera for rig in rigs for camera in rig.cam_from_rig}
    for number, camera in structure.cameras.items():
        own = pycolmap.Camera(camera.todict())
        own.camera_id = number
        add = model.add_camera if number in of_rigs else model.add_camera_with_trivial_rig
        add(own)
    images = {
        image_id: pycolmap.Image(
            name=structure.names[row],
            keypoints=structure.keypoints_px[row],
            camera_id=structure.camera_of[image_id],
            image_id=image_id,
        )
        for row, image_id in enumerate(structure.image_ids)
    }
    for count, rig in enumerate(rigs, 1):
        add_rig(model, rig, max(structure.cameras) + count, images, poses)
    held = {image for rig in rigs for members in rig.frames.values() for image in members}
    for image_id in poses.keys() - held:
        model.add_image_with_trivial_frame(images[image_id], pycolmap.Rigid3d(poses[image_id]))
    order = np.argsort(structure.point_of, kind="stable")
    ends = np.searchsorted(structure.point_of[order], np.arange(len(structure.points) + 1))
    rows_of, keypoints = structure.image_of[order].tolist(), structure.keypoint_of[order].tolist()
    for number, point in enumerate(structure.points):
        rows = range(int(ends[number]), int(ends[number + 1]))
        if len(rows) < 2:
            continue
        elements = [
            pycolmap.TrackElement(structure.image_ids[rows_of[row]], keypoints[row]) for row in rows
        ]
        track = pycolmap.Track(elements)
        model.add_point3D_with_id(
            number + 1, pycolmap.Point3D(xyz=point, track=track, color=structure.colours[number])
        )
    return model


def adjusted(
    structure: Structure,
    *,
    free_principal_point: bool,
    false_matches: bool = False,
    fixed: Sequence[int] = (),
    held: Sequence[int] = (),
) -> Structure:
    """Cameras, poses and points after bundle adjustment; the observations stay.

    false_matches: whether there may be some, so that errors of more than `CAUCHY_PX` count less
    (Cauchy's loss). With squares, the points of a few false matches run off to infinity, and the
    cameras follow them for as long as one lets them. fixed: image ids of photos whose camera and
    pose stay; they settle the frame, too. held: ids of cameras that stay.
    NotFoundError where it gives no solution.
    """
    quiet_engine()
    model = model_of(structure)
    options = pycolmap.BundleAdjustmentOptions()
    options.print_summary = False
    options.refine_principal_point = free_principal_point
    options.refine_focal_length = not structure.focal_held
    options.refine_sensor_from_rig = bool(structure.frame_of) and not structure.rig_held
    if false_matches:
        options.ceres.loss_function_type = pycolmap.LossFunctionType.CAUCHY
        options.ceres.loss_function_scale = CAUCHY_PX
        options.ceres.solver_options.function_tolerance = SETTLED
    config = pycolmap.BundleAdjustmentConfig()
    for image in structure.image_ids:
        config.add_image(image)
    for image in fixed:
        config.set_constant_cam_intrinsics(structure.camera_of[image])
        config.set_constant_rig_from_world_pose(model.images[image].frame_id)
    bodies = structure.body_cameras()
    for number in {*held, *bodies}:
        config.set_constant_cam_intrinsics(number)
    if options.refine_sensor_from_rig:
        for sensor in fixed_to_each_other(model, bodies):
            config.set_constant_sensor_from_rig_pose(sensor)
    if not fixed and structure.rig_held and has_length(model):  # which has the scale
        config.set_constant_rig_from_world_pose(model.images[structure.image_ids[0]].frame_id)
    elif not fixed:
        config.fix_gauge(pycolmap.BundleAdjustmentGauge.TWO_CAMS_FROM_WORLD)
    summary = pycolmap.create_default_bundle_adjuster(options, config, model).solve()
    if not summary.is_solution_usable():
        raise NotFoundError(
            "cameras", f"the adjustment of {len(structure.names)} photos did not converge", _REMEDY
        )
    images = [model.images[image] for image in structure.image_ids]
    points = structure.points.copy()
    for number, point in model.points3D.items():
        points[number - 1] = point.xyz
    return replace(
        structure,
        cameras={number: model.cameras[number] for number in structure.cameras},
        cam_from_world=np.array([image.cam_from_world().matrix() for image in images]),
        points=points,
    )


def without_outliers(structure: Structure, most_px: float) -> Structure:
    """The same without observations that are further off, nor points that fewer than two see."""
    seen = structure.observed(errors_px(structure) <= most_px)
    counts = np.bincount(seen.point_of, minlength=len(seen.points))
    return seen.with_points(counts >= 2)


def without_parallel(structure: Structure, least_rad: float = PARALLEL_RAD) -> Structure:
    """The same without points whose lines of sight are nearly parallel: how far off they lie,
    nobody knows. A structure of which hardly any would be left stays as it is.
    """
    along = structure.points[structure.point_of] - structure.centres()[structure.image_of]
    along /= np.maximum(np.linalg.norm(along, axis=1), 1e-300)[:, None]
    middle = np.zeros_like(structure.points)
    np.add.at(middle, structure.point_of, along)
    middle /= np.maximum(np.linalg.norm(middle, axis=1), 1e-300)[:, None]
    beside = np.linalg.norm(along - middle[structure.point_of], axis=1)
    most = np.zeros(len(structure.points))
    np.maximum.at(most, structure.point_of, beside)
    kept = most >= 0.5 * least_rad
    few = kept.sum() < max(FEWEST_KEPT, KEPT_SHARE * len(kept))
    return structure if few or kept.all() else structure.with_points(kept)
