"""The frames of footage: a video, or a folder of pictures in the order of their names."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.imaging.read import SUFFIXES, read_image
from veduta.run.errors import InputError
from veduta.run.inputs import require_file
from veduta.run.limits import Limits, limited

VIDEOS = (".avi", ".mp4", ".mov", ".mkv", ".m4v", ".webm", ".mpg", ".mpeg")
_MOST_FRAMES = 600
"""Of longer footage every second, third, ... frame is read."""
_MOST_BYTES = 3_000_000_000
_MOST_FILE_BYTES = 20_000_000_000
_LIMITS = Limits(memory_mb=2 * _MOST_BYTES // 1_000_000 + 1000, seconds=900)
"""Frames are held twice while they are joined."""
_ASSUMED_FPS = 25.0
_FEWEST = 5
_REMEDY = "Give a video, or a folder of frames (JPEG, PNG, TIFF, WebP) named in their order."


@dataclass(frozen=True, eq=False)
class Footage:
    """frames: (t, h, w, 3) uint8 sRGB. number: (t,) of each frame in the record. frame_s: between
    two that follow in the record. assumed: whether that time was assumed. whole: height and width
    of the record's pictures, where the frames are a piece of them, and corner: its left and top.
    """

    frames: NDArray[np.uint8]
    number: NDArray[np.int64]
    frame_s: float
    assumed: bool
    whole: tuple[int, int] | None = None
    corner: tuple[int, int] = (0, 0)
    onto: NDArray[np.float64] | None = None
    framed: tuple[int, int] | None = None

    @property
    def size(self) -> tuple[int, int]:
        """Height and width (px)."""
        return int(self.frames.shape[1]), int(self.frames.shape[2])

    def piece(self, pixels: NDArray[np.uint8]) -> NDArray[np.uint8]:
        """The piece of a picture of the record that the frames are; one of their size stays."""
        size = self.framed or self.size
        if self.whole is None or pixels.shape[:2] != self.whole or self.whole == size:
            return pixels
        (left, top), (height, width) = self.corner, size
        return pixels[top : top + height, left : left + width]

    def on_canvas(self, masks: NDArray[np.bool_]) -> NDArray[np.bool_]:
        """Masks of the frames (t, h, w) where the frames are."""
        if self.onto is None:
            return masks
        size = (self.size[1], self.size[0])
        found = np.empty((len(masks), *self.size), dtype=np.bool_)
        for row, (mask, matrix) in enumerate(zip(masks, self.onto, strict=True)):
            whole = mask.astype(np.uint8) * 255
            found[row] = cv2.warpPerspective(whole, matrix, size, flags=cv2.INTER_LINEAR) > 127
        return found

    def at_canvas(self, places: NDArray[np.float64]) -> NDArray[np.float64]:
        """Places (t, n, 2) px in the frames where the frames are; gaps stay."""
        if self.onto is None:
            return places
        flat = np.concatenate([places, np.ones((*places.shape[:2], 1))], axis=2)
        moved = np.einsum("tij,tnj->tni", self.onto, flat)
        return np.asarray(moved[..., :2] / moved[..., 2:])

    def from_canvas(self, places: NDArray[np.float64]) -> NDArray[np.float64]:
        """Places (t, n, 2) px on the canvas as the frames had them before they were laid there."""
        if self.onto is None:
            return places
        return replace(self, onto=np.asarray(np.linalg.inv(self.onto), np.float64)).at_canvas(
            places
        )

    def corners(self) -> NDArray[np.float64] | None:
        """(t, 4, 2) px of each frame's corners on the canvas; None where the camera stood still."""
        if self.onto is None or self.framed is None:
            return None
        height, width = self.framed
        rim = [[0.5, 0.5], [width - 0.5, 0.5], [width - 0.5, height - 0.5], [0.5, height - 0.5]]
        return self.at_canvas(np.tile(np.array(rim), (len(self.onto), 1, 1)))


def read_footage(path: Path, fps: float | None) -> Footage:
    """All frames; InputError where there are none, or they cannot be read."""
    if path.is_dir():
        frames, number = _folder(path)
        rate: float | None = None
    else:
        frames, number, rate = _film(path)
    if len(frames) < _FEWEST:
        fault = f"has {len(frames)} frames: motion is not seen in fewer than {_FEWEST}"
        raise InputError(path, fault, _REMEDY)
    assumed = fps is None and rate is None
    return Footage(frames, number, 1.0 / (fps or rate or _ASSUMED_FPS), assumed)


def cropped(footage: Footage, crop: tuple[int, int, int, int] | None, name: str) -> Footage:
    """A piece of all frames: left, top, width, height (px); InputError where it is none of them."""
    if crop is None:
        return footage
    left, top, width, height = crop
    high, wide = footage.size
    if min(left, top) < 0 or min(width, height) < 8 or left + width > wide or top + height > high:
        fault = (
            f"is {wide} x {high} px, and --crop {left} {top} {width} {height} is no piece of that"
        )
        raise InputError(name, fault, "Give left, top, width and height in pixels.")
    piece = np.ascontiguousarray(footage.frames[:, top : top + height, left : left + width])
    return replace(footage, frames=piece, whole=(high, wide), corner=(left, top))


def read_masks(folder: Path, footage: Footage) -> NDArray[np.bool_]:
    """(t, h, w) the silhouettes in a folder of masks, white on black, one for each frame, as the
    record has them: not on a canvas.
    """
    remedy = "Give a mask of the frame's size for each frame, white where the animal is."
    files = pictures_in(folder)
    if not files:
        raise InputError(folder, "holds no masks", remedy)
    if len(files) <= int(footage.number[-1]):
        fault = f"holds {len(files)} masks for {int(footage.number[-1]) + 1} frames"
        raise InputError(folder, fault, remedy)
    masks = []
    for number in footage.number:
        file = files[int(number)]
        pixels = footage.piece(read_image(file).pixels)
        if pixels.shape[:2] != (footage.framed or footage.size):
            sizes = f"is {pixels.shape[1]} x {pixels.shape[0]} px, and its frame is not"
            raise InputError(file, sizes, remedy)
        masks.append(pixels.max(axis=2) > 127)
    return np.stack(masks)


def pictures_in(folder: Path) -> list[Path]:
    """The pictures in a folder by their names; InputError where there is no such folder."""
    if not folder.is_dir():
        raise InputError(folder, "there is no such folder", _REMEDY)
    files = [path for path in folder.iterdir() if path.suffix.lower() in SUFFIXES]
    return sorted(files, key=lambda path: path.name)


def _step(count: int) -> int:
    return max(1, -(-count // _MOST_FRAMES))


def _folder(path: Path) -> tuple[NDArray[np.uint8], NDArray[np.int64]]:
    files = pictures_in(path)
    if not files:
        raise InputError(path, "holds no pictures", _REMEDY)
    number = np.arange(0, len(files), _step(len(files)))
    first = read_image(files[0]).pixels
    _require_room(path, first.nbytes * len(number))
    frames = np.empty((len(number), *first.shape), dtype=np.uint8)
    for row, place in enumerate(number):
        pixels = read_image(files[int(place)]).pixels
        if pixels.shape != first.shape:
            fault = f"is {pixels.shape[1]} x {pixels.shape[0]} px, and the first frame is not"
            raise InputError(files[int(place)], fault, "Give frames of one size.")
        frames[row] = pixels
    return frames, number.astype(np.int64)


def _film(path: Path) -> tuple[NDArray[np.uint8], NDArray[np.int64], float | None]:
    """As `_video`, in a process of its own: what decodes films trusts what they say."""
    return limited(_video, path, path, _REMEDY, _LIMITS)


def _video(path: Path) -> tuple[NDArray[np.uint8], NDArray[np.int64], float | None]:
    try:
        require_file(path, _MOST_FILE_BYTES)
    except OSError as error:
        raise InputError(path, f"cannot be read ({error.strerror})", _REMEDY) from error
    video = cv2.VideoCapture(str(path))
    try:
        if not video.isOpened():
            raise InputError(path, "is no video that can be read", _REMEDY)
        told = int(video.get(cv2.CAP_PROP_FRAME_COUNT))
        rate = float(video.get(cv2.CAP_PROP_FPS))
        step = _step(max(told, 1))
        frames: list[NDArray[np.uint8]] = []
        number: list[int] = []
        place = 0
        while len(frames) < _MOST_FRAMES and video.grab():
            if place % step == 0:
                read, pixels = video.retrieve()
                if read:
                    if not frames:
                        _require_room(path, pixels.nbytes * min(max(told, 1), _MOST_FRAMES))
                    frames.append(np.ascontiguousarray(pixels[..., ::-1], dtype=np.uint8))
                    number.append(place)
            place += 1
    finally:
        video.release()
    if not frames:
        raise InputError(path, "is no video that can be read", _REMEDY)
    known = rate if 0.1 < rate < 10_000.0 else None
    return np.stack(frames), np.array(number, dtype=np.int64), known


def _require_room(path: Path, size: int) -> None:
    if size > _MOST_BYTES:
        fault = f"takes {size / 1e9:.1f} GB of memory"
        raise InputError(path, fault, "Give smaller frames, or fewer of them.")
