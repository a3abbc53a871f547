"""Reading photos: each kind of file against pixels that the test made itself."""

from __future__ import annotations

import hashlib
import struct
import zlib
from pathlib import Path

import cv2
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from PIL import Image, ImageCms

from veduta.imaging import colour
from veduta.imaging.read import read_image
from veduta.run.errors import InputError

FORMATS = ("JPEG", "PNG", "TIFF", "WEBP")


@pytest.fixture
def pattern() -> NDArray[np.uint8]:
    """(60, 80, 3): four flat colours, no two quadrants alike."""
    pixels = np.zeros((60, 80, 3), dtype=np.uint8)
    pixels[:30, :40], pixels[:30, 40:] = (200, 40, 30), (20, 180, 60)
    pixels[30:, :40], pixels[30:, 40:] = (30, 60, 190), (240, 230, 220)
    return pixels


def quadrants(pixels: NDArray[np.uint8]) -> NDArray[np.int64]:
    """(4, 3) colours of the quadrants' centres."""
    h, w = pixels.shape[:2]
    places = [
        (h // 4, w // 4),
        (h // 4, 3 * w // 4),
        (3 * h // 4, w // 4),
        (3 * h // 4, 3 * w // 4),
    ]
    return np.array([pixels[place] for place in places]).astype(np.int64)


def close(a: NDArray[np.uint8], b: NDArray[np.uint8], tolerance: int) -> bool:
    return a.shape == b.shape and bool(np.abs(quadrants(a) - quadrants(b)).max() <= tolerance)


@pytest.mark.parametrize("kind", FORMATS)
def test_reads_each_format_with_its_digest(
    kind: str, pattern: NDArray[np.uint8], tmp_path: Path
) -> None:
    path = tmp_path / "photo.any"
    Image.fromarray(pattern).save(path, format=kind)
    photo = read_image(path)
    assert photo.pixels.dtype == np.uint8
    assert photo.pixels.flags.writeable
    assert close(photo.pixels, pattern, 6)
    assert photo.sha256 == hashlib.sha256(path.read_bytes()).hexdigest()
    assert photo.focal_mm35 is None


@pytest.mark.parametrize("orientation", range(1, 9))
@pytest.mark.parametrize(
    ("kind", "compression"), [("PNG", None), ("TIFF", None), ("TIFF", "tiff_lzw"), ("WEBP", None)]
)
def test_applies_each_exif_orientation(
    kind: str, compression: str | None, orientation: int, pattern: NDArray[np.uint8], tmp_path: Path
) -> None:
    # What the camera stores so that the viewer's operation gives the upright picture back
    # (Exif 2.32, table 6: where row 0 and column 0 are).
    stored = {
        1: pattern,
        2: pattern[:, ::-1],
        3: pattern[::-1, ::-1],
        4: pattern[::-1],
        5: pattern.transpose(1, 0, 2),
        6: np.rot90(pattern, 1),
        7: pattern[::-1, ::-1].transpose(1, 0, 2),
        8: np.rot90(pattern, -1),
    }[orientation]
    exif = Image.Exif()
    exif[0x0112] = orientation
    path = tmp_path / "turned.any"
    how = {"compression": compression} if compression else {"lossless": True}
    Image.fromarray(np.ascontiguousarray(stored)).save(path, format=kind, exif=exif, **how)
    assert np.array_equal(read_image(path).pixels, pattern)


@pytest.mark.parametrize("suffix", ["png", "tif"])
def test_reads_sixteen_bits(suffix: str, pattern: NDArray[np.uint8], tmp_path: Path) -> None:
    deep = pattern.astype(np.uint16) * 257
    path = tmp_path / f"deep.{suffix}"
    cv2.imwrite(str(path), deep[..., ::-1])
    assert np.array_equal(read_image(path).pixels, pattern)
    cv2.imwrite(str(path), deep[..., 0])
    assert np.array_equal(read_image(path).pixels, np.repeat(pattern[..., :1], 3, axis=2))


def test_reads_sixteen_bit_alpha(pattern: NDArray[np.uint8], tmp_path: Path) -> None:
    alpha = np.full((60, 80, 1), 65535, dtype=np.uint16)
    alpha[:30] = 0
    path = tmp_path / "deep.png"
    cv2.imwrite(str(path), np.dstack([pattern[..., ::-1].astype(np.uint16) * 257, alpha]))
    pixels = read_image(path).pixels
    assert (pixels[:30] == 255).all()
    assert np.array_equal(pixels[30:], pattern[30:])


@pytest.mark.parametrize("mode", ["L", "LA", "P", "RGBA", "1"])
def test_reads_each_mode(mode: str, pattern: NDArray[np.uint8], tmp_path: Path) -> None:
    image = Image.fromarray(pattern).convert(mode)
    path = tmp_path / "mode.png"
    image.save(path)
    assert np.array_equal(read_image(path).pixels, np.asarray(image.convert("RGB")))


@pytest.mark.parametrize("mode", ["LA", "RGBA"])
def test_lays_alpha_on_white(mode: str, tmp_path: Path) -> None:
    image = Image.new("RGBA", (80, 60), (100, 100, 100, 0))
    image.paste((100, 100, 100, 255), (0, 0, 40, 60))
    image.paste((100, 100, 100, 51), (0, 0, 40, 30))
    path = tmp_path / "alpha.png"
    image.convert(mode).save(path)
    pixels = read_image(path).pixels
    assert (pixels[:, 40:] == 255).all()
    assert (pixels[30:, :40] == 100).all()
    assert (pixels[:30, :40] == round(0.2 * 100 + 0.8 * 255)).all()


def test_reads_palette_transparency_as_white(tmp_path: Path) -> None:
    image = Image.new("P", (80, 64), 1)
    image.putpalette([10, 20, 30, 200, 100, 50])
    image.paste(0, (0, 0, 40, 64))
    path = tmp_path / "palette.png"
    image.save(path, transparency=0)
    pixels = read_image(path).pixels
    assert (pixels[:, :40] == 255).all()
    assert (pixels[:, 40:] == (200, 100, 50)).all()


@pytest.mark.parametrize("kind", ["JPEG", "TIFF"])
def test_reads_cmyk(kind: str, pattern: NDArray[np.uint8], tmp_path: Path) -> None:
    # Pillow writes the Adobe marker and inverted values, as Photoshop does.
    path = tmp_path / "print.any"
    Image.fromarray(pattern).convert("CMYK").save(path, format=kind, quality=95)
    assert close(read_image(path).pixels, pattern, 6)


def test_applies_a_colour_profile(pattern: NDArray[np.uint8], tmp_path: Path) -> None:
    # sRGB with the red and the green primary exchanged, under another name.
    profile = bytearray(ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB")).tobytes())
    for at in range(132, 132 + 12 * struct.unpack(">I", profile[128:132])[0], 12):
        name = bytes(profile[at : at + 4])
        if name in (b"rXYZ", b"gXYZ"):
            profile[at : at + 4] = {b"rXYZ": b"gXYZ", b"gXYZ": b"rXYZ"}[name]
    renamed = bytes(profile).replace("sRGB".encode("utf-16-be"), "swap".encode("utf-16-be"))
    path = tmp_path / "profile.png"
    Image.fromarray(pattern).save(path, icc_profile=renamed)
    assert close(read_image(path).pixels, np.ascontiguousarray(pattern[..., [1, 0, 2]]), 4)


def test_a_broken_profile_is_noted_not_fatal(pattern: NDArray[np.uint8], tmp_path: Path) -> None:
    path = tmp_path / "profile.png"
    Image.fromarray(pattern).save(path, icc_profile=b"no profile at all")
    photo = read_image(path)
    assert np.array_equal(photo.pixels, pattern)
    assert any("profile" in note for note in photo.notes)


def test_refuses_float_pixels(tmp_path: Path) -> None:
    path = tmp_path / "float.tif"
    Image.fromarray(np.ones((80, 80), dtype=np.float32)).save(path)
    with pytest.raises(InputError, match="8 or 16 bit"):
        read_image(path)


@pytest.mark.parametrize("kind", FORMATS)
@pytest.mark.parametrize("part", [0.02, 0.3, 0.6, 0.97])
def test_names_a_truncated_file(kind: str, part: float, tmp_path: Path) -> None:
    noise = np.random.default_rng(0).integers(0, 256, (120, 160, 3), dtype=np.uint8)
    path = tmp_path / "cut.any"
    Image.fromarray(noise).save(path, format=kind)
    data = path.read_bytes()
    path.write_bytes(data[: int(part * len(data))])
    with pytest.raises(InputError) as caught:
        read_image(path)
    assert str(path) in str(caught.value)
    assert "truncated" in caught.value.fault or "not an image" in caught.value.fault


def _png_header(width: int, height: int) -> bytes:
    body = b"IHDR" + struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    chunk = struct.pack(">I", 13) + body + struct.pack(">I", zlib.crc32(body))
    data = zlib.compress(bytes(1000))
    idat = (
        struct.pack(">I", len(data))
        + b"IDAT"
        + data
        + struct.pack(">I", zlib.crc32(b"IDAT" + data))
    )
    return b"\x89PNG\r\n\x1a\n" + chunk + idat


@pytest.mark.parametrize("size", [(30_000, 30_000), (12_000, 8_500), (40_000, 100)])
def test_refuses_huge_headers_before_memory_is_taken(size: tuple[int, int], tmp_path: Path) -> None:
    path = tmp_path / "huge.png"
    path.write_bytes(_png_header(*size))
    with pytest.raises(InputError) as caught:
        read_image(path)
    assert "Resize" in caught.value.remedy


def test_refuses_a_huge_jpeg_header(tmp_path: Path) -> None:
    path = tmp_path / "huge.jpg"
    Image.new("RGB", (64, 64)).save(path)
    data = bytearray(path.read_bytes())
    at = data.index(b"\xff\xc0") + 5
    data[at : at + 4] = struct.pack(">HH", 30_000, 30_000)
    path.write_bytes(bytes(data))
    with pytest.raises(InputError, match="megapixels"):
        read_image(path)


@pytest.mark.parametrize(
    ("content", "fault"),
    [
        (b"", "is empty"),
        (b"dear diary\n" * 40, "not an image"),
        (b"\xff\xd8\xff\xe0 and no more", "truncated"),
        (b"\0\0\0\x18ftypheic" + bytes(200), "HEIC"),
        (b"GIF89a" + bytes(200), "not an image"),
    ],
)
def test_says_what_a_file_is_not(content: bytes, fault: str, tmp_path: Path) -> None:
    path = tmp_path / "thing.jpg"
    path.write_bytes(content)
    with pytest.raises(InputError) as caught:
        read_image(path)
    assert fault in caught.value.fault
    assert caught.value.remedy


def test_says_missing_and_folder(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="does not exist"):
        read_image(tmp_path / "none.jpg")
    with pytest.raises(InputError, match="is a folder"):
        read_image(tmp_path)


@settings(
    max_examples=150, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(
    kind=st.sampled_from(FORMATS),
    flips=st.lists(st.tuples(st.integers(0, 10**6), st.integers(0, 255)), min_size=1, max_size=8),
)
def test_damage_is_an_input_error_or_a_picture(
    kind: str, flips: list[tuple[int, int]], tmp_path: Path
) -> None:
    gradient = np.add.outer(np.arange(40), np.arange(50)).astype(np.uint8)
    path = tmp_path / "damaged.any"
    exif = Image.Exif()
    exif[0x0112] = 6
    Image.fromarray(np.dstack([gradient] * 3)).save(path, format=kind, exif=exif)
    data = bytearray(path.read_bytes())
    for at, value in flips:
        data[at % len(data)] = value
    path.write_bytes(bytes(data))
    try:
        photo = read_image(path)
    except InputError:
        return
    assert photo.pixels.ndim == 3
    assert photo.pixels.shape[2] == 3


@pytest.mark.parametrize("mode", ["1", "L", "P", "LA", "RGB", "RGBA", "CMYK"])
def test_a_picture_is_the_same_in_strips(mode: str, monkeypatch: pytest.MonkeyPatch) -> None:
    rng = np.random.default_rng(5)
    image = Image.fromarray(rng.integers(0, 256, (23, 17, 4), dtype=np.uint8)).convert(mode)
    if mode in {"P", "RGB"}:
        image.info["transparency"] = 7 if mode == "P" else (1, 2, 3)
    whole, _ = colour.srgb_on_white(image)
    monkeypatch.setattr(colour, "STRIP_PX", 5 * 17 + 3)
    strips, _ = colour.srgb_on_white(image)
    np.testing.assert_array_equal(strips, whole)
    assert whole.shape == (23, 17, 3)
