"""The frames of a film that are worth being photos: the sharpest one of each stretch.

A film is cut into stretches, and of each the sharpest frame is kept, by the variance of the
Laplacian (Pech-Pacheco et al., Diatom autofocusing in brightfield microscopy, ICPR 2000). Stretches
are of equal time where an interval is given. Else they are of equal motion: a stretch ends when the
picture has moved by a twentieth of its width since it began, as tracked corners tell, so that
standing still gives one frame and a fast pan several.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.imaging.read import MAX_PIXELS
from veduta.photos.options import VideoOptions
from veduta.run.digests import input_digest
from veduta.run.errors import InputError
from veduta.run.limits import Limits, limited
from veduta.run.progress import StepProgress, no_progress
from veduta.run.worker import tell

LARGEST_BYTES = 64_000_000_000
MOST_FRAMES = 400_000
"""Frames of a film: more are not read. Two hours of 50 in a second."""
LOOKS_PER_S = 12.0
"""Frames in a second that are looked at: neighbours in time hardly differ."""
SMALL_PX = 320
"""Width at which frames are compared."""
SHARP_PX = 960
"""Width at which sharpness is measured: grain and compression are not sharpness."""
MOTION = 0.05
"""How far the picture moves within a stretch, as a share of its width."""
FEW = 20
"""Stretches of equal time where motion makes fewer: whoever walks around something keeps it in the
picture, which hardly moves."""
JPEG_QUALITY = 95
_MOST_MB = 4000
"""Memory that decoding may take: some frames at once, of at most `MAX_PIXELS`."""
FEWEST_TRACKED = 0.5
_CORNERS = 150
_STARTS = (
    (4, b"ftyp"),  # MP4, MOV
    (4, b"moov"),
    (4, b"mdat"),
    (4, b"wide"),
    (0, b"RIFF"),  # AVI
    (0, b"\x1a\x45\xdf\xa3"),  # Matroska, WebM
    (0, b"\x00\x00\x01"),  # MPEG
    (0, b"\x47"),  # MPEG transport stream
    (0, b"OggS"),
)
"""How films begin: a playlist, which would make the decoder open other files, does not."""
_REMEDY = "Convert it to MP4 (H.264), or give single photos."


@dataclass(frozen=True)
class Video:
    """A film that has a first frame, at least. size_px: width and height of that, upright."""

    path: Path
    name: str
    sha256: str
    size_px: tuple[int, int]

    def frame_name(self, number: int) -> str:
        """What the file of a frame is called."""
        return f"{self._stem}-{number:06d}.jpg"

    def is_frame_name(self, name: str) -> bool:
        """Whether a file may be a frame of it, by its name; small letters or not."""
        return re.fullmatch(rf"{self._stem}-\d{{6}}\.jpg", name, re.IGNORECASE) is not None

    @property
    def _stem(self) -> str:
        return "".join(letter if letter.isalnum() else "-" for letter in self.path.stem)[:60]


@dataclass(frozen=True)
class Look:
    """What a first look at a film found, frame by frame.

    numbers: (n,) of the frames that were looked at, from 0 on. times_s: (n,). sharpness: (n,).
    stretches: (n,) number of the stretch of motion, from 0 on.
    read, expected: how many frames the film has, and says that it has.
    """

    numbers: NDArray[np.int64]
    times_s: NDArray[np.float64]
    sharpness: NDArray[np.float64]
    stretches: NDArray[np.int64]
    read: int
    expected: int


@dataclass(frozen=True)
class Frames:
    """The files of the kept frames, in their order, and what is to be told of the film."""

    paths: tuple[Path, ...]
    notes: tuple[str, ...]


def video_of(path: Path) -> Video:
    """A file that may be a film; InputError where it is none."""
    digest = input_digest(path, LARGEST_BYTES, "Check the name of the film.")
    with path.open("rb") as file:
        start = file.read(16)
    if not any(start[at:].startswith(magic) for at, magic in _STARTS):
        raise InputError(path, "is not a film that can be read", _REMEDY)
    return Video(path, path.name, digest, limited(_first_size, path, path, _REMEDY))


def _first_size(path: Path) -> tuple[int, int]:
    """Width and height (px) of the first frame; in a process of its own, for it may claim any."""
    with _opened(path) as film:
        if not film.grab():
            raise InputError(path, "has no frame that can be read", _REMEDY)
        height, width = _frame(path, film).shape[:2]
    return width, height


def write_frames(
    video: Video, options: VideoOptions, folder: Path, progress: StepProgress = no_progress
) -> Frames:
    """Write the sharpest frame of each stretch into a folder, as JPEG; InputError where none."""
    look = look_through(video, progress)
    chosen = choose_frames(look, options)
    paths = tuple(folder / video.frame_name(int(number)) for number in chosen)
    taken = _Taken(video.path, chosen, paths)
    limits = Limits(_MOST_MB, _longest_s(video.path, look.read))
    written = limited(
        _write_chosen, taken, video.path, _REMEDY, limits,
        lambda share: progress("video", 0.5 + 0.5 * share),
    )  # fmt: skip
    if written != len(chosen):
        raise InputError(video.path, "reads differently a second time", _REMEDY)
    return Frames(paths, _notes(video, look, chosen, options))


def look_through(video: Video, progress: StepProgress = no_progress) -> Look:
    """Sharpness and motion along a film, which is read in a process of its own."""
    frames = limited(_frames_told, video.path, video.path, _REMEDY)
    limits = Limits(_MOST_MB, _longest_s(video.path, frames))
    return limited(
        _looked_through, video.path, video.path, _REMEDY, limits,
        lambda share: progress("video", 0.5 * share),
    )  # fmt: skip


def _longest_s(path: Path, frames: int) -> int:
    """Seconds of one core that a film may take: more than a slow one does, by its size."""
    size_mb = path.stat().st_size / 1e6
    return int(120 + 10 * size_mb + 0.1 * min(frames, MOST_FRAMES))


def _frames_told(path: Path) -> int:
    """How many frames a film says that it has; 0 where it says nothing."""
    with _opened(path) as film:
        return max(0, int(film.get(cv2.CAP_PROP_FRAME_COUNT)))


@dataclass(frozen=True)
class _Taken:
    """The frames of a film that are to be written, by number (n,), and the file of each."""

    film: Path
    numbers: NDArray[np.int64]
    files: tuple[Path, ...]


def _write_chosen(taken: _Taken) -> int:
    """Write the frames that were chosen; how many there were. Called within limits."""
    files = dict(zip(taken.numbers.tolist(), taken.files, strict=True))
    last, written = int(taken.numbers.max()), 0
    with _opened(taken.film) as film:
        for number in range(last + 1):
            if not film.grab():
                break
            if number in files:
                tell(number / (last + 1))
                _write(_frame(taken.film, film), files[number])
                written += 1
    return written


def _looked_through(path: Path) -> Look:
    """Called within limits."""
    numbers: list[int] = []
    times: list[float] = []
    sharpness: list[float] = []
    stretches: list[int] = []
    begun: NDArray[np.uint8] | None = None
    with _opened(path) as film:
        expected = max(0, int(film.get(cv2.CAP_PROP_FRAME_COUNT)))
        rate = film.get(cv2.CAP_PROP_FPS) or 25.0
        read = 0
        while read < MOST_FRAMES and film.grab():
            time_s = film.get(cv2.CAP_PROP_POS_MSEC) / 1000.0 or read / rate
            read += 1
            if times and time_s < times[-1] + 1.0 / LOOKS_PER_S - 1e-3:
                continue
            tell(min(1.0, read / max(1, expected)))
            grey = cv2.cvtColor(_frame(path, film), cv2.COLOR_BGR2GRAY).astype(np.uint8)
            small = _shrunk(grey, SMALL_PX)
            ended = begun is not None and motion_between(begun, small) >= MOTION
            if begun is None or ended:
                begun = small
            numbers.append(read - 1)
            times.append(time_s)
            sharpness.append(float(cv2.Laplacian(_shrunk(grey, SHARP_PX), cv2.CV_32F).var()))
            stretches.append((stretches[-1] if stretches else 0) + ended)
    return Look(
        np.array(numbers),
        np.array(times),
        np.array(sharpness),
        np.array(stretches),
        read,
        expected,
    )


def motion_between(before: NDArray[np.uint8], after: NDArray[np.uint8]) -> float:
    """By what share of its width the picture moved, by tracked corners.

    A quarter of them moved further. Where most are lost, all of it has moved.
    """
    corners: NDArray[np.float32] | None = cv2.goodFeaturesToTrack(before, _CORNERS, 0.01, 7)  # type: ignore[assignment]
    if corners is None:
        return 0.0
    found, there, _ = cv2.calcOpticalFlowPyrLK(before, after, corners, np.zeros_like(corners))
    again, back, _ = cv2.calcOpticalFlowPyrLK(after, before, found, np.zeros_like(corners))
    astray = np.linalg.norm((np.asarray(again) - corners).reshape(-1, 2), axis=1)
    # A corner that is tracked wrongly seldom finds its way back.
    kept = (np.asarray(there).ravel() == 1) & (np.asarray(back).ravel() == 1) & (astray < 1.0)
    if float(kept.mean()) < FEWEST_TRACKED:
        return 1.0
    apart = np.linalg.norm((np.asarray(found) - corners).reshape(-1, 2)[kept], axis=1)
    return float(np.quantile(apart, 0.75)) / int(before.shape[1])


def choose_frames(look: Look, options: VideoOptions) -> NDArray[np.int64]:
    """The numbers of the frames to keep, in their order."""
    count = len(look.times_s)
    if options.video_interval_s is not None:
        seconds = look.times_s - look.times_s[0]
        stretch = (seconds / options.video_interval_s).astype(np.int64)
    elif look.stretches[-1] >= FEW:
        stretch = look.stretches
    else:
        stretch = np.arange(count) * min(FEW, count) // count
    stretch = stretch // -(-(int(stretch[-1]) + 1) // options.video_frames)
    # The sharpest frame comes first within its stretch, the earlier of two that are as sharp.
    order = np.lexsort((np.arange(count), -look.sharpness, stretch))
    first = np.ones(count, dtype=bool)
    first[1:] = stretch[order][1:] != stretch[order][:-1]
    return look.numbers[np.sort(order[first])]


def _notes(
    video: Video, look: Look, chosen: NDArray[np.int64], options: VideoOptions
) -> tuple[str, ...]:
    length = float(look.times_s[-1] - look.times_s[0])
    if options.video_interval_s is not None:
        by = f"one for {options.video_interval_s:g} s"
    elif look.stretches[-1] >= FEW:
        by = f"one each time that the picture has moved by {MOTION:.0%} of its width"
    else:
        by = "at equal times, for the picture hardly moves"
    notes = [
        f"{video.name}: {len(chosen)} of {look.read} frames in {length:.1f} s are photos: {by},"
        f" the sharpest of each stretch, at most {options.video_frames}"
    ]
    if look.read < look.expected:
        notes.append(
            f"{video.name}: says that it has {look.expected} frames, and {look.read} could be read"
        )
    return tuple(notes)


@contextmanager
def _opened(path: Path) -> Iterator[cv2.VideoCapture]:
    # What is wrong with a film is said in our words.
    os.environ.setdefault("OPENCV_FFMPEG_LOGLEVEL", "-8")
    cv2.utils.logging.setLogLevel(cv2.utils.logging.LOG_LEVEL_SILENT)
    film = cv2.VideoCapture(str(path), cv2.CAP_FFMPEG)
    try:
        if not film.isOpened():
            raise InputError(path, "is truncated, damaged, or of an unknown codec", _REMEDY)
        yield film
    finally:
        film.release()


def _frame(path: Path, film: cv2.VideoCapture) -> NDArray[np.uint8]:
    """(h, w, 3) the frame that was grabbed, BGR, turned upright as the film says."""
    good, frame = film.retrieve()
    if not good:
        raise InputError(path, "has a frame that cannot be decoded", _REMEDY)
    height, width = frame.shape[:2]
    if width * height > MAX_PIXELS:
        raise InputError(path, f"has frames of {width} x {height} px", _REMEDY)
    return np.asarray(frame, dtype=np.uint8)


def _shrunk(grey: NDArray[np.uint8], width_px: int) -> NDArray[np.uint8]:
    height, width = grey.shape
    if width <= width_px:
        return grey
    size = width_px, max(1, round(height * width_px / width))
    return cv2.resize(grey, size, interpolation=cv2.INTER_AREA).astype(np.uint8)


def _write(frame: NDArray[np.uint8], path: Path) -> None:
    _, data = cv2.imencode(".jpg", frame, [cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY])
    path.write_bytes(data.tobytes())
