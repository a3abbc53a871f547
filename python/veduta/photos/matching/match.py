"""Matches: features of two photos that show the same point, kept where two views explain them.

The engine compares the descriptors and verifies the pairs; its database, in the format of COLMAP,
holds both. Pairs are done in batches: what a killed run has compared is not compared again.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import pycolmap

from veduta.photos.intake.read import UNKNOWN_FOCAL, PhotoRecord
from veduta.photos.mapping.engine import quiet_engine
from veduta.photos.matching.features import read_features
from veduta.photos.matching.pairs import Pairs
from veduta.photos.matching.verify import verify_pairs
from veduta.photos.options import MatchOptions
from veduta.run.atomic import atomic_write
from veduta.run.progress import StepProgress, no_progress

BATCH = 40
"""Pairs between two looks at Ctrl-C."""
START_MODEL = "SIMPLE_RADIAL"
"""The lens model that mapping begins with; `lens` chooses the one that stays."""
FISHEYE_MODEL, FISHEYE_FOCAL = "OPENCV_FISHEYE", 0.32
"""And its focal length over the longer side where EXIF is silent: half around, equal angles."""
KNOWN_MODEL = "PINHOLE"
"""That of views which were cut out of panoramas: nothing of them is found by mapping."""


@dataclass(frozen=True)
class PairRecord:
    """Two photos (image ids), and how many features agree before and after verification."""

    first: int
    second: int
    matches: int
    verified: int
    planar: bool
    """The pair is explained by a homography: a plane, or a camera that only turned."""


def write_database(
    path: Path,
    photos: Sequence[PhotoRecord],
    features: Sequence[Path],
    *,
    per_photo: bool,
    shared: bool = False,
    fisheye: bool = False,
) -> None:
    """Write a new database with cameras, photos and features; whole or not at all.

    per_photo: each photo has its own camera; else those of a group whose focal length EXIF tells,
    and the frames of a film, share one. Where EXIF tells nothing, two photos of one size may still
    come from two cameras; shared: those of a group are said to be of one all the same. fisheye: all
    photos are of such lenses.
    """
    with atomic_write(path) as temporary, pycolmap.Database.open(temporary) as database:
        database.clear_all_tables()
        rigs: dict[int, int] = {}
        for photo, file in zip(photos, features, strict=True):
            own = photo.view is None and (per_photo or not (shared or photo.one_camera))
            # Groups and photos are numbered from 1 on; a camera is one or the other.
            number = photo.image_id if own else len(photos) + photo.group
            if number not in rigs:
                rigs[number] = _write_camera(database, number, photo, fisheye)
            _write_photo(database, photo, number, rigs[number])
            found = read_features(file)
            database.write_keypoints(photo.image_id, found.keypoints)
            descriptors = pycolmap.FeatureDescriptors(
                data=found.descriptors, type=pycolmap.FeatureExtractorType.SIFT
            )
            database.write_descriptors(photo.image_id, descriptors)


def _write_camera(
    database: pycolmap.Database, number: int, photo: PhotoRecord, fisheye: bool
) -> int:
    """A camera and the rig that holds nothing else; the rig's number.

    Of a fisheye the focal length counts as known: only with it are lines of sight what they are.
    """
    unknown = FISHEYE_FOCAL if fisheye else UNKNOWN_FOCAL
    focal = photo.focal_px or unknown * max(photo.width_px, photo.height_px)
    model = FISHEYE_MODEL if fisheye else START_MODEL
    model = model if photo.view is None else KNOWN_MODEL
    camera = pycolmap.Camera.create_from_model_name(
        number, model, focal, photo.width_px, photo.height_px
    )
    camera.has_prior_focal_length = fisheye or photo.focal_px is not None
    database.write_camera(camera, use_camera_id=True)
    rig = pycolmap.Rig(rig_id=number)
    rig.add_ref_sensor(camera.sensor_id)
    return int(database.write_rig(rig, use_rig_id=True))


def _write_photo(database: pycolmap.Database, photo: PhotoRecord, camera: int, rig: int) -> None:
    image = pycolmap.Image(
        name=database_name(photo.image_id), camera_id=camera, image_id=photo.image_id
    )
    database.write_image(image, use_image_id=True)
    frame = pycolmap.Frame(frame_id=photo.image_id, rig_id=rig)
    frame.add_data_id(image.data_id)
    database.write_frame(frame, use_frame_id=True)


def database_name(image_id: int) -> str:
    """What the database calls a photo: files may have names that break the engine's lists."""
    return f"{image_id:06d}"


def match_pairs(
    path: Path,
    pairs: Pairs,
    options: MatchOptions,
    seed: int,
    progress: StepProgress = no_progress,
) -> None:
    """Compare and verify the pairs that the database does not have yet."""
    quiet_engine()
    with pycolmap.Database.open(path) as database:
        waiting = [pair for pair in pairs.pairs if not database.exists_two_view_geometry(*pair)]
    done = len(pairs.pairs) - len(waiting)
    matching = pycolmap.FeatureMatchingOptions()
    matching.use_gpu = False
    matching.skip_geometric_verification = options.epipolar != "colmap"
    verification = pycolmap.TwoViewGeometryOptions()
    verification.ransac.random_seed = seed
    for start in range(0, len(waiting), BATCH):
        progress("match", (done + start) / len(pairs.pairs))
        batch = waiting[start : start + BATCH]
        listed = path.with_suffix(".pairs")
        listed.write_text(
            "".join(f"{database_name(a)} {database_name(b)}\n" for a, b in batch), encoding="utf-8"
        )
        pairing = pycolmap.ImportedPairingOptions()
        pairing.match_list_path = listed
        pycolmap.match_image_pairs(
            path, matching, pairing, verification, device=pycolmap.Device.cpu
        )
        if options.epipolar != "colmap":
            verify_pairs(path, batch, options, seed)


def count_keypoints(path: Path, photos: Sequence[PhotoRecord]) -> list[int]:
    """How many keypoints the database has of each photo."""
    with pycolmap.Database.open(path) as database:
        return [int(database.num_keypoints_for_image(photo.image_id)) for photo in photos]


def read_pairs(path: Path, pairs: Pairs) -> list[PairRecord]:
    """What the database says of each pair."""
    planar = {
        pycolmap.TwoViewGeometryConfiguration.PLANAR,
        pycolmap.TwoViewGeometryConfiguration.PANORAMIC,
        pycolmap.TwoViewGeometryConfiguration.PLANAR_OR_PANORAMIC,
    }
    found = []
    with pycolmap.Database.open(path) as database:
        for first, second in pairs.pairs:
            if not database.exists_two_view_geometry(first, second):
                found.append(PairRecord(first, second, 0, 0, planar=False))
                continue
            matches = len(database.read_matches(first, second))
            geometry = database.read_two_view_geometry(first, second)
            inliers = len(geometry.inlier_matches)
            found.append(
                PairRecord(first, second, matches, inliers, planar=geometry.config in planar)
            )
    return found
