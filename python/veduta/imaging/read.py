"""Reading a photo: any usual file in, upright 8-bit sRGB pixels and the focal length out."""

from __future__ import annotations

import hashlib
import io
import struct
import warnings
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image, UnidentifiedImageError

from veduta.imaging.colour import OTHER_MODES, READABLE_MODES, srgb_on_white
from veduta.imaging.deep import stretched
from veduta.imaging.exif import CameraTags, FocalSource, focal_px_from_mm35, read_camera_tags
from veduta.imaging.heic import heic_formats
from veduta.imaging.shot import Shot, read_shot
from veduta.run.errors import InputError
from veduta.run.inputs import require_file

MAX_PIXELS = 100_000_000
MAX_SIDE_PX = 30_000
MAX_FILE_BYTES = 1_000_000_000
FORMATS = ("JPEG", "PNG", "TIFF", "WEBP")
OTHER_FORMAT = "Give a JPEG, PNG, TIFF or WebP file."
MODEL_FORMATS = ("BMP", "TGA")
"""What the pictures of models may be besides."""
SUFFIXES = (".jpg", ".jpeg", ".jpe", ".jfif", ".mpo", ".png", ".tif", ".tiff", ".webp")

_HEIC_BRANDS = (b"heic", b"heix", b"mif1", b"msf1", b"hevc")

# What Pillow raises on damaged files, found by cutting and flipping bytes of each format.
DAMAGE = (
    OSError,
    ValueError,
    SyntaxError,
    EOFError,
    KeyError,
    IndexError,
    TypeError,
    AttributeError,
    OverflowError,
    RuntimeError,
    struct.error,
    zlib.error,
)

_TRANSPOSE = {
    2: Image.Transpose.FLIP_LEFT_RIGHT,
    3: Image.Transpose.ROTATE_180,
    4: Image.Transpose.FLIP_TOP_BOTTOM,
    5: Image.Transpose.TRANSPOSE,
    6: Image.Transpose.ROTATE_270,
    7: Image.Transpose.TRANSVERSE,
    8: Image.Transpose.ROTATE_90,
}


@dataclass(frozen=True)
class Photo:
    """An upright photo.

    `pixels` is (h, w, 3) uint8 sRGB with EXIF orientation applied and alpha laid on white;
    `sha256` is that of the file's bytes; the focal length is None where EXIF has none, and
    `focal_source` says how EXIF gives it. `orientation` is that of the stored pixels. `shot` says
    with which camera, when and where it was taken, as far as EXIF does.
    """

    pixels: NDArray[np.uint8]
    sha256: str
    focal_mm35: float | None
    focal_px: float | None
    path: Path
    notes: tuple[str, ...] = ()
    shot: Shot = field(default_factory=Shot)
    focal_source: FocalSource | None = None
    orientation: int = 1


def read_image(path: Path, other_format: str = OTHER_FORMAT) -> Photo:
    """Read a JPEG, PNG, TIFF or WebP file; raise InputError when it cannot be read whole.

    other_format: the remedy where it is of none of these, for who takes more than pictures.
    """
    data = _read_bytes(path)
    with _damage_is_input_error(path), _open_bounded(path, data, other_format) as image:
        notes = _frame_notes(image)
        image.load()
        # After loading: Pillow turns a TIFF by its orientation then, and takes the tag away.
        tags, shot = _camera_tags(image), _shot(image)
        if image.mode not in READABLE_MODES:
            raise InputError(
                path,
                f"its pixels are not 8 or 16 bit colours (stored as {image.mode!r})",
                "Save it as an 8-bit or 16-bit RGB image.",
            )
        shown, deep_notes = stretched(image, data)
        upright = _upright(shown, tags.orientation)
        pixels, colour_notes = srgb_on_white(upright)
    height_px, width_px = pixels.shape[:2]
    focal_px = None
    if tags.focal_mm35 is not None:
        focal_px = focal_px_from_mm35(tags.focal_mm35, width_px, height_px)
    return Photo(
        pixels=pixels,
        sha256=hashlib.sha256(data).hexdigest(),
        focal_mm35=tags.focal_mm35,
        focal_px=focal_px,
        path=path,
        notes=notes + tags.notes + shot.notes + deep_notes + colour_notes,
        shot=shot,
        focal_source=tags.focal_source,
        orientation=tags.orientation,
    )


def read_picture(path: Path, data: bytes) -> tuple[NDArray[np.uint8], NDArray[np.uint8] | None]:
    """The picture of a model, as it is stored: (h, w, 3) uint8 sRGB, and its alpha (h, w) uint8.

    data: its bytes; `path` is what faults name. No alpha (None) where it has none. InputError
    where it cannot be read whole.
    """
    formats = (*FORMATS, *MODEL_FORMATS)
    with _damage_is_input_error(path), _open_bounded(path, data, formats=formats) as image:
        image.load()
        if image.mode not in READABLE_MODES:
            fault = f"its pixels are not 8 or 16 bit colours (stored as {image.mode!r})"
            raise InputError(path, fault, "Save it as an 8-bit RGB image.")
        shown, _ = stretched(image, data)
        alpha = None
        if shown.mode not in OTHER_MODES and shown.has_transparency_data:
            shown = shown.convert("RGBA")
            alpha = np.array(shown.getchannel("A"), dtype=np.uint8)
            shown = shown.convert("RGB")
        return srgb_on_white(shown)[0], alpha


def image_size(path: Path) -> tuple[int, int]:
    """Width and height (px) of an image, upright, by its header; InputError as `read_image`."""
    try:
        require_file(path, MAX_FILE_BYTES)
        formats = (*FORMATS, *heic_formats())
        with _damage_is_input_error(path), Image.open(path, formats=formats) as image:
            width_px, height_px = image.size
            turned = _camera_tags(image).orientation >= 5
    except InputError:
        # Whatever is wrong, reading it whole says it best.
        read = read_image(path).pixels
        return read.shape[1], read.shape[0]
    except OSError as error:
        raise InputError(path, f"cannot be read ({error.strerror})", "Check its name.") from error
    if width_px * height_px > MAX_PIXELS or max(width_px, height_px) > MAX_SIDE_PX:
        raise _too_large(path, f"is {width_px} x {height_px} px")
    return (height_px, width_px) if turned else (width_px, height_px)


def has_few_colours(path: Path, most: int) -> bool:
    """Whether an image has at most so many colours; False where it cannot be read."""
    try:
        data = _read_bytes(path)
        with _damage_is_input_error(path), _open_bounded(path, data) as image:
            return image.getcolors(most) is not None
    except InputError:
        return False


def _read_bytes(path: Path) -> bytes:
    if path.is_dir():
        raise InputError(path, "is a folder, not an image", f"Name its images: {path}/*.jpg")
    try:
        require_file(path, MAX_FILE_BYTES)
        data = path.read_bytes()
    except FileNotFoundError:
        raise InputError(path, "does not exist", "Check the name of the image.") from None
    except OSError as error:
        fault = f"cannot be read ({error.strerror})"
        raise InputError(path, fault, "Check its permissions.") from error
    if not data:
        raise InputError(path, "is empty", "Copy the image again.")
    return data


@contextmanager
def _damage_is_input_error(path: Path) -> Iterator[None]:
    """Turn what Pillow raises on damaged or oversized files into an InputError."""
    try:
        with warnings.catch_warnings():
            # Sizes are checked here; a damaged EXIF block is no reason to speak.
            warnings.simplefilter("ignore")
            yield
    except Image.DecompressionBombError:
        raise _too_large(path, f"has more than {MAX_PIXELS // 10**6} megapixels") from None
    except MemoryError:
        raise _too_large(path, "needs more memory than there is") from None
    except DAMAGE as error:
        reason = str(error) or type(error).__name__
        fault = f"is truncated or damaged ({reason})"
        raise InputError(path, fault, "Copy or export the image again.") from error


def _open_bounded(
    path: Path,
    data: bytes,
    other_format: str = OTHER_FORMAT,
    formats: tuple[str, ...] | None = None,
) -> Image.Image:
    """Read the header; refuse other formats and images over the size bounds."""
    allowed = formats or (*FORMATS, *heic_formats())
    try:
        image = Image.open(io.BytesIO(data), formats=allowed)
    except UnidentifiedImageError:
        raise InputError(path, _why_unidentified(data), other_format) from None
    width_px, height_px = image.size
    if width_px * height_px > MAX_PIXELS or max(image.size) > MAX_SIDE_PX:
        raise _too_large(path, f"is {width_px} x {height_px} px")
    return image


def _why_unidentified(data: bytes) -> str:
    magic = {
        b"\xff\xd8\xff": "JPEG",
        b"\x89PNG\r\n\x1a\n": "PNG",
        b"II*\0": "TIFF",
        b"MM\0*": "TIFF",
    }
    for start, name in magic.items():
        if data.startswith(start):
            return (
                f"starts like a {name} file, but its header is truncated or damaged, or its"
                " pixels are of a kind that is not read (floating-point numbers, more than 16 bits)"
            )
    if data.startswith(b"RIFF") and data[8:12] == b"WEBP":
        return "starts like a WEBP file, but is truncated or damaged"
    if data[4:8] == b"ftyp" and data[8:12] in _HEIC_BRANDS:
        return "starts like a HEIC file, but is truncated or damaged"
    if data[4:8] == b"ftyp":
        return "is a HEIC, AVIF or video file"
    return "is not an image that can be read"


def _too_large(path: Path, fault: str) -> InputError:
    remedy = (
        f"Resize it to at most {MAX_PIXELS // 10**6} megapixels and {MAX_SIDE_PX} px a side; "
        "2000 px a side is enough."
    )
    return InputError(path, fault, remedy)


def _camera_tags(image: Image.Image) -> CameraTags:
    """EXIF, or nothing with a note where the block is damaged: the pixels are still good."""
    try:
        return read_camera_tags(image)
    except DAMAGE:
        return CameraTags(notes=("the EXIF block is damaged: orientation and lens unknown",))


def _shot(image: Image.Image) -> Shot:
    try:
        return read_shot(image)
    except DAMAGE:
        return Shot()


def _upright(image: Image.Image, orientation: int) -> Image.Image:
    if orientation == 1:
        return image
    info = image.info
    turned = image.transpose(_TRANSPOSE[orientation])
    turned.info = info
    return turned


def _frame_notes(image: Image.Image) -> tuple[str, ...]:
    frames = getattr(image, "n_frames", 1)
    if image.format != "MPO" and frames > 1:
        return (f"the file has {frames} images: the first is used",)
    return ()
