"""Which source of cameras a path is, told by what it holds."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from veduta.cameras.camera import CameraSet
from veduta.cameras.files import read_json
from veduta.cameras.readers import (
    colmap,
    kitti,
    matrices,
    middlebury,
    opencv_yaml,
    openmvg,
    opensfm,
    photos_result,
    strecha,
)
from veduta.run.errors import InputError
from veduta.run.inputs import require_file

Reader = Callable[[Path, Path | None], CameraSet]
Finder = Callable[[Path], Path | None]
_GIVE = (
    "Name a result of `veduta photos`, a COLMAP model, a folder of .camera files, a *_par.txt, "
    "projection matrices (.mat or text), a KITTI sequence, OpenCV's YAML, or JSON of OpenMVG or "
    "OpenSfM."
)
MOST_JSON = 20
"""JSON files of a folder that are looked into."""


def _json_in(is_one: Callable[[object], bool]) -> Finder:
    def find(folder: Path) -> Path | None:
        for path in sorted(folder.glob("*.json"))[:MOST_JSON]:
            if path.is_file() and is_one(read_json(path)):
                return path
        return None

    return find


_FOLDERS: tuple[tuple[str, Finder, Reader], ...] = (
    ("a result of veduta photos", photos_result.find, photos_result.read),
    ("a COLMAP model", colmap.find, colmap.read),
    ("a KITTI sequence", kitti.find, kitti.read),
    (".camera files", strecha.find, strecha.read),
    ("a *_par.txt", middlebury.find, middlebury.read),
    ("projection matrices", matrices.find, matrices.read),
    ("OpenCV's YAML", opencv_yaml.find, opencv_yaml.read),
    ("OpenMVG's JSON", _json_in(openmvg.is_one), openmvg.read),
    ("OpenSfM's JSON", _json_in(opensfm.is_one), opensfm.read),
)
_WHOLE = 3
"""So many of the first sources have files that others would take for theirs, too."""


def read_cameras(path: Path, images: Path | None = None) -> CameraSet:
    """The cameras of a file or folder, of any source that is known, with their pictures.

    images: the folder of the photos, where they do not lie beside the cameras. Pictures that are
    not there are None; a camera whose picture has another size is that size's.
    InputError where there is none, where two are, or where what is there is damaged, or contradicts
    the points that lie with it (`convention`).
    """
    if not path.exists():
        raise InputError(path, "does not exist", _GIVE)
    if path.is_dir():
        found, read = _in_folder(path)
        return read(found, images)
    require_file(path)
    return _of_file(path)(path, images)


def _in_folder(folder: Path) -> tuple[Path, Reader]:
    for place in (folder, *sorted(inner for inner in folder.iterdir() if inner.is_dir())):
        kinds = []
        for number, (kind, find, read) in enumerate(_FOLDERS):
            found = find(place)
            if found is None:
                continue
            if number < _WHOLE:
                return found, read
            kinds.append((kind, found, read))
        if len(kinds) > 1:
            fault = "holds cameras of two kinds: " + " and ".join(
                f"{kind} ({found.name})" for kind, found, _ in kinds[:2]
            )
            raise InputError(place, fault, "Name the one that you mean.")
        if kinds:
            return kinds[0][1], kinds[0][2]
    raise InputError(folder, "holds no cameras", _GIVE)


def _of_file(path: Path) -> Reader:
    suffix = path.suffix.lower()
    whole: dict[str, Reader] = {
        "cameras.bin": _beside(colmap.read),
        "images.bin": _beside(colmap.read),
        "cameras.txt": _beside(colmap.read),
        "images.txt": _beside(colmap.read),
        "place.json": _beside(photos_result.read),
        kitti.CALIB: _beside(kitti.read),
    }
    if path.name in whole:
        return whole[path.name]
    if suffix == strecha.SUFFIX:
        return _beside(strecha.read)
    if suffix == ".json":
        record = read_json(path)
        if openmvg.is_one(record):
            return openmvg.read
        if opensfm.is_one(record):
            return opensfm.read
    if suffix == ".txt" and middlebury.is_one(path):
        return middlebury.read
    if matrices.is_one(path):
        return matrices.read
    if opencv_yaml.is_one(path):
        return opencv_yaml.read
    raise InputError(path, "holds no cameras", _GIVE)


def _beside(read: Reader) -> Reader:
    """The reader of the folder in which a file lies."""
    return lambda path, images: read(path.parent, images)
