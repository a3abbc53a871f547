"""A workspace of COLMAP's dense reconstruction: photos without distortion, a model, and maps.

https://colmap.github.io/format.html, "Dense Reconstruction". A map is `width&height&channels&` and
its numbers after that (float32, little-endian, each channel whole, row by row); 0 is unknown.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.formats.colmap_model import ColmapCamera, ColmapImage, ColmapPoints
from veduta.geometry.quaternions import quaternions_of

SPARSE, IMAGES, STEREO = "sparse", "images", "stereo"
KIND = "geometric"
"""COLMAP's word for maps that several photos have confirmed."""
_MOST_SOURCES = 20


def write_map(path: Path, values: NDArray[np.floating]) -> None:
    """(h, w) depths or (h, w, 3) normals in the camera's frame, NaN where unknown."""
    rows = np.nan_to_num(np.asarray(values, dtype="<f4"), nan=0.0)
    channels = np.moveaxis(np.atleast_3d(rows), 2, 0)
    head = f"{rows.shape[1]}&{rows.shape[0]}&{channels.shape[0]}&"
    path.write_bytes(head.encode("ascii") + np.ascontiguousarray(channels).tobytes())


def write_workspace(
    folder: Path,
    cameras: dict[int, ColmapCamera],
    images: Iterable[ColmapImage],
    points: ColmapPoints,
) -> None:
    """The folders of a workspace, its model as text, and what COLMAP's stereo takes from it."""
    maps = (f"{STEREO}/depth_maps", f"{STEREO}/normal_maps", f"{STEREO}/consistency_graphs")
    for name in (SPARSE, IMAGES, *maps):
        (folder / name).mkdir(parents=True, exist_ok=True)
    shown = list(images)
    lines = [
        f"{number} {one.model} {one.width_px} {one.height_px} {_row(one.params)}"
        for number, one in cameras.items()
    ]
    _write(folder / SPARSE / "cameras.txt", lines)
    _write(folder / SPARSE / "images.txt", [line for one in shown for line in _image(one)])
    _write(folder / SPARSE / "points3D.txt", _points(points, shown))
    _write(folder / STEREO / "fusion.cfg", [one.name for one in shown])
    sources = f"__auto__, {_MOST_SOURCES}"
    _write(folder / STEREO / "patch-match.cfg", [x for one in shown for x in (one.name, sources)])


def quaternion(rotation: NDArray[np.float64]) -> NDArray[np.float64]:
    """(4,) w, x, y, z of a (3, 3) rotation, as COLMAP orders them."""
    return np.asarray(quaternions_of(rotation[None])[0][[3, 0, 1, 2]])


def _image(one: ColmapImage) -> tuple[str, str]:
    turn, shift = quaternion(one.cam_from_world[:, :3]), one.cam_from_world[:, 3]
    seen = " ".join(
        f"{x:.3f} {y:.3f} {number}"
        for (x, y), number in zip(one.places_px.tolist(), one.points.tolist(), strict=True)
    )
    return f"{one.number} {_row([*turn, *shift])} {one.camera} {one.name}", seen


def _points(points: ColmapPoints, images: list[ColmapImage]) -> list[str]:
    tracks: dict[int, list[str]] = {number: [] for number in points.numbers.tolist()}
    for one in images:
        for place, number in enumerate(one.points.tolist()):
            tracks[number].append(f"{one.number} {place}")
    rows = zip(points.numbers.tolist(), points.places, points.colours.tolist(), strict=True)
    return [
        f"{number} {_row(place)} {' '.join(map(str, colour))} 0 {' '.join(tracks[number])}"
        for number, place, colour in rows
    ]


def _row(numbers: Iterable[float]) -> str:
    return " ".join(repr(float(one)) for one in numbers)


def _write(path: Path, lines: list[str]) -> None:
    path.write_text("".join(f"{line}\n" for line in lines), encoding="utf-8")
