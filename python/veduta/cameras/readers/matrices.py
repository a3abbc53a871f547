"""Cameras as projection matrices: a MATLAB file with `P`, or text of 3 x 4 numbers.

Oxford's and Olsson's data sets have a cell array `P`; others one text file for each photo (`*.P`,
`*.txt`, with the head `CONTOUR` or without), or one with a line or three for each.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.cameras.camera import Camera, CameraSet
from veduta.cameras.convention import Seen, require_convention
from veduta.cameras.files import (
    COPY_AGAIN,
    LARGEST_LIST_BYTES,
    lines_of,
    numbers,
    read_head,
    read_mat,
    read_text,
)
from veduta.cameras.pictures import Pictures, natural_order, near, require_one_size
from veduta.cameras.projection import part_projection
from veduta.imaging.read import image_size
from veduta.run.errors import InputError

Floats = NDArray[np.float64]
NAMES = ("P", "Ps", "cameras", "projections")
MOST_HEAD = 65_536
_HEADED = "CONTOUR"
_PHOTOS = "Name the folder of the photos; it must hold one for each matrix, in the order of names."
_TURNED = np.diag([1.0, 1.0, -1.0, 1.0])


@dataclass(frozen=True, eq=False)
class _Given:
    """Matrices (c, 3, 4), the photos' names if any, points (n, 3) and what each camera saw."""

    matrices: Floats
    names: tuple[str, ...] = ()
    points: Floats | None = None
    seen: tuple[Seen, ...] = ()
    visible: tuple[NDArray[np.intp], ...] | None = None


def find(folder: Path) -> Path | None:
    """A MATLAB file with matrices, a text of them, or the folder itself with a text for each."""
    for path in sorted(folder.glob("*.mat")):
        if _cells(read_mat(path)) is not None:
            return path
    single = [path for path in _texts(folder) if _is_text(path)]
    if len(single) == 1:
        return single[0]
    return folder if len(single) > 1 else None


def is_one(path: Path) -> bool:
    """Whether a file has matrices."""
    return path.suffix.lower() == ".mat" or _is_text(path)


def read(found: Path, images: Path | None) -> CameraSet:
    """The cameras of a file, or of all texts of a folder; the photos say their sizes."""
    given = _from_mat(found) if found.suffix.lower() == ".mat" else _from_text(found)
    pictures = near(found, images)
    paths = _pictures(found, given, pictures)
    notes: list[str] = []
    matrices, points = given.matrices, given.points
    if _is_left_handed(given):
        matrices = matrices @ _TURNED
        points = None if points is None else points * np.array([1.0, 1.0, -1.0])
        notes.append("the world of the matrices is left-handed: its third axis was turned round")
    cameras = tuple(
        _camera(found, index, matrix, path)
        for index, (matrix, path) in enumerate(zip(matrices, paths, strict=True))
    )
    require_one_size(cameras)
    turned = np.array([1.0, 1.0, -1.0]) if notes else np.ones(3)
    seen = {index: Seen(one.points * turned, one.places_px) for index, one in enumerate(given.seen)}
    require_convention(found, cameras, seen)
    if len(pictures.paths) > len(paths):
        notes.append(f"{len(pictures.paths)} photos for {len(paths)} matrices: the first are used")
    return CameraSet(
        cameras=cameras,
        points=points,
        visible=given.visible,
        source=str(found),
        notes=tuple(notes),
    )


def _from_mat(path: Path) -> _Given:
    values = read_mat(path)
    cells = _cells(values)
    if cells is None:
        remedy = "Save the matrices as a cell array P of 3 x 4 matrices."
        raise InputError(path, f"has no projection matrices ({', '.join(values)})", remedy)
    points = values.get("U")
    if points is None or points.ndim != 2 or len(points) not in (3, 4):
        return _Given(cells, _image_names(values))
    world = np.asarray(points, dtype=np.float64)
    world = (world[:3] / (world[3] if len(world) == 4 else 1.0)).T
    seen, visible = _observed(values, world, len(cells))
    return _Given(cells, _image_names(values), world, seen, visible)


def _cells(values: dict[str, Any]) -> Floats | None:
    """(c, 3, 4) of the variable that has matrices."""
    for name in NAMES:
        value = values.get(name)
        if value is None:
            continue
        if value.dtype == object:
            cells = [np.asarray(cell) for cell in value.ravel()]
            if cells and all(cell.shape == (3, 4) and cell.dtype.kind in "fiu" for cell in cells):
                return np.array(cells, dtype=np.float64)
        elif value.ndim == 3 and value.shape[:2] == (3, 4):
            return np.asarray(np.moveaxis(value, 2, 0), dtype=np.float64)
        elif value.shape == (3, 4):
            return np.asarray(value[None], dtype=np.float64)
    return None


def _image_names(values: dict[str, Any]) -> tuple[str, ...]:
    """Of a listing of a folder by MATLAB's `dir`."""
    listing = values.get("imnames")
    if listing is None or listing.dtype.names is None or "name" not in listing.dtype.names:
        return ()
    return tuple(str(cell.ravel()[0]) for cell in listing["name"].ravel() if cell.size)


def _observed(
    values: dict[str, Any], world: Floats, count: int
) -> tuple[tuple[Seen, ...], tuple[NDArray[np.intp], ...] | None]:
    """What each camera saw, as Olsson's data sets have it; nothing where they have not."""
    record = values.get("u_uncalib")
    if record is None or record.dtype.names is None or record.size != 1:
        return (), None
    if not {"points", "index"} <= set(record.dtype.names):
        return (), None
    places, indices = record["points"].ravel()[0].ravel(), record["index"].ravel()[0].ravel()
    if len(places) != count or len(indices) != count:
        return (), None
    seen, visible = [], []
    for place, index in zip(places, indices, strict=True):
        rows = np.asarray(index).ravel().astype(np.int64) - 1
        px = np.asarray(place, dtype=np.float64)
        if px.ndim != 2 or px.shape[1] != len(rows) or len(px) < 2:
            return (), None
        if len(rows) and not 0 <= rows.min() <= rows.max() < len(world):
            return (), None
        good = np.isfinite(px[:2]).all(axis=0)
        seen.append(Seen(world[rows[good]], px[:2, good].T + 0.5))
        visible.append(np.unique(rows[good]).astype(np.intp))
    return tuple(seen), tuple(visible)


def _texts(folder: Path) -> list[Path]:
    found = [path for suffix in ("*.P", "*.txt") for path in folder.glob(suffix)]
    return sorted(found, key=lambda path: natural_order(path.name))


def _is_text(path: Path) -> bool:
    """Whether it is a file with rows of matrices; a folder or a link to nothing is none."""
    if path.suffix.lower() not in (".txt", ".p") or not path.is_file():
        return False
    if path.stat().st_size > LARGEST_LIST_BYTES:
        return False
    lines = [words for _, words in lines_of(read_head(path, MOST_HEAD))]
    if lines and lines[0] == [_HEADED]:
        lines = lines[1:]
    try:
        rows = [[float(word) for word in words] for words in lines[:3]]
    except ValueError:
        return False
    return bool(rows) and (
        all(len(row) == 12 for row in rows) or (len(rows) == 3 and all(len(r) == 4 for r in rows))
    )


def _from_text(found: Path) -> _Given:
    paths = [path for path in _texts(found) if _is_text(path)] if found.is_dir() else [found]
    matrices = [_matrices(path) for path in paths]
    if found.is_dir() and any(len(one) != 1 for one in matrices):
        raise InputError(found, "has several texts of several matrices", "Name the one to read.")
    names = tuple(path.stem for path in paths) if found.is_dir() else ()
    return _Given(np.concatenate(matrices), names)


def _matrices(path: Path) -> Floats:
    lines = lines_of(read_text(path))
    if lines and lines[0][1] == [_HEADED]:
        lines = lines[1:]
    width = len(lines[0][1]) if lines else 0
    if width not in (4, 12):
        fault = f"has lines of {width} numbers"
        raise InputError(path, fault, "Give three lines of 4 numbers for a matrix, or one of 12.")
    rows = [numbers(path, f"line {number}", words, width) for number, words in lines]
    if len(rows) * width % 12:
        raise InputError(path, f"has {len(rows)} rows of matrices of three", COPY_AGAIN)
    return np.array(rows).reshape(-1, 3, 4)


def _pictures(found: Path, given: _Given, pictures: Pictures) -> list[Path]:
    """A photo for each matrix: by the names that are given, else in the order of names."""
    count = len(given.matrices)
    if len(given.names) == count:
        named = [pictures.find(name) for name in given.names]
        paths = [path for path in named if path is not None]
        if len(paths) == count:
            return paths
    if len(pictures.paths) < count:
        fault = f"has {count} matrices, but there are {len(pictures.paths)} photos"
        raise InputError(found, fault, _PHOTOS)
    return list(pictures.paths[:count])


def _is_left_handed(given: _Given) -> bool:
    """Whether what the cameras look at lies behind all of them, once they are turns.

    What they look at: the points, else where their axes come nearest to each other.
    """
    parted = [part_projection(matrix) for matrix in given.matrices]
    poses = [one.cam_from_world for one in parted if one is not None]
    if given.points is not None and len(given.points):
        target = np.median(given.points, axis=0)
    elif len(poses) > 1:
        target = _meeting_point(poses)
    else:
        return False
    depths = np.array([pose[2, :3] @ target + pose[2, 3] for pose in poses])
    return len(poses) > 0 and bool((depths < 0.0).mean() > 0.9)


def _meeting_point(poses: list[Floats]) -> Floats:
    """(3,) the point that is nearest to all axes, in the mean of squares."""
    system, right = np.zeros((3, 3)), np.zeros(3)
    for pose in poses:
        axis, centre = pose[2, :3], -pose[:, :3].T @ pose[:, 3]
        across = np.eye(3) - np.outer(axis, axis)
        system += across
        right += across @ centre
    return np.asarray(np.linalg.lstsq(system, right, rcond=None)[0])


def _camera(found: Path, index: int, matrix: Floats, picture: Path) -> Camera:
    parted = part_projection(matrix)
    if parted is None:
        fault = f"matrix {index + 1} is no camera's (its left part has no inverse)"
        raise InputError(found, fault, COPY_AGAIN)
    width, height = image_size(picture)
    k = parted.matrix
    return Camera(
        name=picture.name,
        width_px=width,
        height_px=height,
        focal_px=(float(k[0, 0]), float(k[1, 1])),
        centre_px=(float(k[0, 2]) + 0.5, float(k[1, 2]) + 0.5),
        cam_from_world=parted.cam_from_world,
        picture=picture,
        skew_px=float(k[0, 1]),
    )
