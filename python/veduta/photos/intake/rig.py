"""Rigs: cameras that are fixed to each other and took photos at the same moments.

DIR then has a folder per camera; what was taken at the same moment has the same name in each. A
file `rig.json` beside the folders may say how the cameras are fixed to each other, as COLMAP has
it: a list with one rig, whose `cameras` have an `image_prefix`, and all but the reference a
rotation as w x y z and a translation. Without it the photos tell.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, Field, TypeAdapter, ValidationError

from veduta.formats.colmap_model import pose
from veduta.photos.intake.source import Mount, Source
from veduta.run.errors import InputError
from veduta.run.faults import first_fault

RIG_FILE = "rig.json"
LARGEST_FILE = 1 << 20
MOST_CAMERAS = 64
LEAST_SHARED = 0.5
"""Share of the frames of the camera with fewest that another camera must have, too: names that
agree by chance make no rig."""
MOST_NAMED = 3
_SAME = "Give what was taken at the same moment the same name in each camera's folder."
_LAYOUT = "Put the photos of each camera into a folder of its own: DIR/left, DIR/right."


class _RigCamera(BaseModel):
    model_config = ConfigDict(extra="ignore")

    image_prefix: str = Field(min_length=1, max_length=200)
    ref_sensor: bool = False
    cam_from_rig_rotation: tuple[float, float, float, float] | None = None
    cam_from_rig_translation: tuple[float, float, float] | None = None


class _RigConfig(BaseModel):
    model_config = ConfigDict(extra="ignore")

    cameras: tuple[_RigCamera, ...] = Field(min_length=2, max_length=MOST_CAMERAS)


@dataclass(frozen=True)
class RigFile:
    """What `rig.json` says: (3, 4) `cam_from_rig` of each camera, by the name of its folder."""

    sha256: str
    cam_from_rig: Mapping[str, NDArray[np.float64]]


def read_rig_file(path: Path, sha256: str, cameras: Sequence[str]) -> RigFile:
    """The poses of the cameras of a rig; InputError where the file does not say all of them."""
    try:
        rigs = TypeAdapter(tuple[_RigConfig, ...]).validate_json(path.read_bytes())
    except ValidationError as error:
        fault = f"is no rig: {first_fault(error)}"
        raise InputError(path, fault, "Write it as COLMAP's rig_config.json.") from error
    if len(rigs) != 1:
        fault = f"describes {len(rigs)} rigs, and one can be used"
        raise InputError(path, fault, "Leave the others out, and their photos.")
    found: dict[str, NDArray[np.float64]] = {}
    for camera in rigs[0].cameras:
        name = camera.image_prefix.replace("\\", "/").strip("/").rsplit("/", 1)[-1]
        found[name] = _pose(path, name, camera)
    missing = [name for name in cameras if name not in found]
    if missing:
        fault = f"does not say where the camera {missing[0]} is, whose folder is there"
        raise InputError(path, fault, f"Its image_prefix is {missing[0]}/, or remove the folder.")
    return RigFile(sha256, {name: found[name] for name in cameras})


def _pose(path: Path, name: str, camera: _RigCamera) -> NDArray[np.float64]:
    if camera.ref_sensor:
        return np.eye(3, 4)
    if camera.cam_from_rig_rotation is None or camera.cam_from_rig_translation is None:
        fault = f"says neither that {name} is the reference, nor its rotation and translation"
        remedy = "Give ref_sensor, or cam_from_rig_rotation and cam_from_rig_translation."
        raise InputError(path, fault, remedy)
    rotation = np.array(camera.cam_from_rig_rotation)
    length = float(np.linalg.norm(rotation))
    if not 0.9 < length < 1.1:
        fault = f"has a rotation of {name} that is no unit quaternion (length {length:.3g})"
        raise InputError(path, fault, "Write it as w x y z with length 1.")
    return pose(path, name, rotation, np.array(camera.cam_from_rig_translation))


def camera_folders(folder: Path, suffixes: frozenset[str]) -> list[Path]:
    """The folders of a rig's cameras, by name; InputError where there are not two."""
    try:
        inner = sorted(one for one in folder.iterdir() if one.is_dir() and one.name[0] != ".")
        found = [one for one in inner if any(_is_photo(file, suffixes) for file in one.iterdir())]
    except OSError as error:
        fault = f"cannot be read ({error.strerror})"
        raise InputError(folder, fault, "Check its permissions, and its folders'.") from error
    if len(found) < 2:
        told = f"photos in one folder alone, {found[0].name}" if found else "no folder with photos"
        fault = f"holds {told}: a rig has two cameras at least"
        raise InputError(folder, fault, _LAYOUT)
    if len(found) > MOST_CAMERAS:
        fault = f"holds {len(found)} folders with photos, and a rig has {MOST_CAMERAS} cameras"
        raise InputError(folder, fault + " at most", "Give the photos of one rig.")
    return found


def _is_photo(path: Path, suffixes: frozenset[str]) -> bool:
    return path.suffix.lower() in suffixes and not path.name.startswith(".")


def mounted(folder: Path, sources: Sequence[Source]) -> tuple[tuple[Source, ...], tuple[str, ...]]:
    """The photos, which are called FOLDER/NAME, with camera and frame; and what is to be noted.

    InputError where the frames of a camera do not match those of any other.
    """
    found = [replace(source, mount=_mount_of(source.name)) for source in sources]
    frames: dict[str, set[str]] = {}
    for source in found:
        if source.mount is None:
            continue
        own = frames.setdefault(source.mount.camera, set())
        if source.mount.frame in own:
            fault = f"is a second photo of one frame of the camera {source.mount.camera}"
            raise InputError(source.path, fault, "Rename or remove one of the two.")
        own.add(source.mount.frame)
    _require_matching(folder, frames)
    times = Counter(frame for own in frames.values() for frame in own)
    whole = sum(count == len(frames) for count in times.values())
    notes = [f"a rig of {len(frames)} cameras ({', '.join(frames)}): {whole} frames have all"]
    for camera, own in sorted(frames.items()):
        lacking = sorted(set(times) - own)
        if lacking:
            named = ", ".join(lacking[:MOST_NAMED]) + (", …" if len(lacking) > MOST_NAMED else "")
            notes[0] += f"; {camera} lacks {len(lacking)} ({named})"
    return tuple(found), tuple(notes)


def _mount_of(name: str) -> Mount:
    camera, _, file = name.partition("/")
    return Mount(camera, Path(file).stem.casefold())


def _require_matching(folder: Path, frames: Mapping[str, set[str]]) -> None:
    for camera, own in frames.items() if len(frames) > 1 else ():
        others = {name: theirs for name, theirs in frames.items() if name != camera}
        shared = {name: len(own & theirs) for name, theirs in others.items()}
        nearest = max(shared, key=lambda name: (shared[name], name))
        wanted = LEAST_SHARED * min(len(own), len(others[nearest]))
        if shared[nearest] >= max(1.0, wanted):
            continue
        alone = sorted(own - others[nearest]) or sorted(own)
        theirs = sorted(others[nearest] - own) or sorted(others[nearest])
        fault = (
            f"has frames that do not match: of {len(own)} in {camera} {shared[nearest]} are also"
            f" in {nearest}, which has {len(others[nearest])}"
            f" ({camera}/{alone[0]} there, {nearest}/{theirs[0]} here)"
        )
        raise InputError(folder, fault, _SAME)
