"""What scanning and age do to a sheet. Some kinds are kept back from development."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.synthetic.noise import fractal_noise, grain
from veduta.synthetic.plans.canvas import Colour, Image
from veduta.synthetic.plans.styles import Split

Affine = NDArray[np.float64]
Apply = Callable[[np.random.Generator, Image, Colour], tuple[Image, Affine]]
MAX_SKEW_RAD = math.radians(5.0)
LEAST_PX_PER_SIDE = 420


@dataclass(frozen=True)
class Degradation:
    """A kind of damage; `apply` gives the picture and the affine from pixels before to after."""

    name: str
    split: Split
    apply: Apply


def _clipped(values: NDArray[np.floating]) -> Image:
    return np.asarray(np.clip(np.round(values), 0, 255), np.uint8)


def clean(_: np.random.Generator, picture: Image, __: Colour) -> tuple[Image, Affine]:
    """As drawn."""
    return picture, np.eye(3)


def noise(rng: np.random.Generator, picture: Image, _: Colour) -> tuple[Image, Affine]:
    """Grain and specks of a scanner."""
    shape = (picture.shape[0], picture.shape[1])
    noisy = picture + (rng.uniform(6, 16) * grain(rng, shape))[..., None]
    specks = rng.random(shape) < 4e-4
    noisy[specks] = rng.uniform(0, 120)
    return _clipped(noisy), np.eye(3)


def skew(rng: np.random.Generator, picture: Image, paper: Colour) -> tuple[Image, Affine]:
    """Laid crooked on the glass, by up to five degrees."""
    angle = rng.uniform(0.2, 1.0) * MAX_SKEW_RAD * rng.choice([-1, 1])
    height, width = picture.shape[:2]
    cos, sin = math.cos(angle), math.sin(angle)
    wide = math.ceil(width * abs(cos) + height * abs(sin))
    high = math.ceil(width * abs(sin) + height * abs(cos))
    turn = np.array([[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]])
    middle = turn @ [width / 2, height / 2, 1.0]
    turn[:2, 2] = [wide / 2 - middle[0], high / 2 - middle[1]]
    return _warped(picture, turn, (wide, high), paper), turn


def _warped(picture: Image, affine: Affine, size: tuple[int, int], paper: Colour) -> Image:
    """The picture under an affine of continuous pixel coordinates (centres at 0.5)."""
    shift = np.array([[1.0, 0.0, 0.5], [0.0, 1.0, 0.5], [0.0, 0.0, 1.0]])
    matrix = (np.linalg.inv(shift) @ affine @ shift)[:2]
    warped = cv2.warpAffine(
        picture,
        matrix,
        size,
        flags=cv2.INTER_CUBIC,
        borderMode=cv2.BORDER_CONSTANT,
        borderValue=paper,
    )
    return np.asarray(warped, np.uint8)


def blur(rng: np.random.Generator, picture: Image, _: Colour) -> tuple[Image, Affine]:
    """Out of focus."""
    sigma = rng.uniform(0.9, 1.8)
    return np.asarray(cv2.GaussianBlur(picture, (0, 0), sigma), np.uint8), np.eye(3)


def low_resolution(rng: np.random.Generator, picture: Image, _: Colour) -> tuple[Image, Affine]:
    """As small as pictures of advertisements."""
    height, width = picture.shape[:2]
    scale = max(rng.uniform(0.4, 0.6), LEAST_PX_PER_SIDE / min(height, width))
    scale = min(scale, 1.0)
    size = (round(width * scale), round(height * scale))
    small = cv2.resize(picture, size, interpolation=cv2.INTER_AREA)
    return np.asarray(small, np.uint8), np.diag([size[0] / width, size[1] / height, 1.0])


def yellowed(rng: np.random.Generator, picture: Image, _: Colour) -> tuple[Image, Affine]:
    """Old paper: yellow, mottled, and ink that has faded."""
    shape = (picture.shape[0], picture.shape[1])
    tint = np.array([rng.uniform(0.9, 0.96), rng.uniform(0.82, 0.9), rng.uniform(0.6, 0.75)])
    mottle = 1.0 + 0.05 * fractal_noise(rng, shape, 160.0)[..., None]
    faded = 255.0 - (255.0 - picture.astype(np.float32)) * rng.uniform(0.7, 0.85)
    return _clipped(faded * tint * mottle), np.eye(3)


def uneven_light(rng: np.random.Generator, picture: Image, _: Colour) -> tuple[Image, Affine]:
    """Photographed by a lamp at one side, with a soft shadow."""
    height, width = picture.shape[:2]
    y, x = np.mgrid[0 : 1 : height * 1j, 0 : 1 : width * 1j].astype(np.float32)
    angle = rng.uniform(0, 2 * math.pi)
    ramp = (x - 0.5) * math.cos(angle) + (y - 0.5) * math.sin(angle)
    edge = rng.uniform(-0.2, 0.2)
    shadow = 1.0 / (1.0 + np.exp(-(ramp - edge) / 0.04))
    light = 0.82 + 0.25 * ramp - rng.uniform(0.1, 0.25) * shadow
    return _clipped(picture * light[..., None]), np.eye(3)


def jpeg(rng: np.random.Generator, picture: Image, _: Colour) -> tuple[Image, Affine]:
    """Compressed too far."""
    quality = int(rng.integers(12, 30))
    data = cv2.imencode(".jpg", picture[..., ::-1], [cv2.IMWRITE_JPEG_QUALITY, quality])[1]
    back = np.asarray(cv2.imdecode(data, cv2.IMREAD_COLOR), np.uint8)
    return np.ascontiguousarray(back[..., ::-1]), np.eye(3)


def mirrored(_: np.random.Generator, picture: Image, __: Colour) -> tuple[Image, Affine]:
    """A transparency laid upside down: everything is mirrored, text too."""
    flip = np.array([[-1.0, 0.0, picture.shape[1]], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
    return np.ascontiguousarray(picture[:, ::-1]), flip


def stains(rng: np.random.Generator, picture: Image, _: Colour) -> tuple[Image, Affine]:
    """Coffee: blots and rings."""
    height, width = picture.shape[:2]
    cover = np.zeros((height, width), np.float32)
    for _ring in range(int(rng.integers(3, 7))):
        centre = (int(rng.integers(width)), int(rng.integers(height)))
        radius = int(rng.uniform(0.05, 0.14) * width)
        one = np.zeros_like(cover)
        cv2.circle(one, centre, radius, rng.uniform(0.12, 0.3), -1, cv2.LINE_AA)
        cv2.circle(one, centre, radius, rng.uniform(0.3, 0.5), max(2, radius // 12), cv2.LINE_AA)
        cover = np.maximum(cover, cv2.GaussianBlur(one, (0, 0), max(1.0, radius / 40)))
    cover *= 1.0 + 0.4 * fractal_noise(rng, (height, width), 60.0)
    brown = np.array([120.0, 78.0, 34.0])
    share = np.clip(cover, 0.0, 0.7)[..., None]
    return _clipped(picture * (1 - share) + np.minimum(picture, brown) * share), np.eye(3)


def folded(rng: np.random.Generator, picture: Image, _: Colour) -> tuple[Image, Affine]:
    """Folded in four: creases that are dark on one side and worn white in the middle."""
    height, width = picture.shape[:2]
    worn = picture.astype(np.float32)
    for axis, size in ((0, height), (1, width)):
        at = size * rng.uniform(0.4, 0.6)
        distance = np.arange(size) - at
        shade = 1.0 - 0.16 * np.exp(-np.abs(distance) / (0.02 * size)) * (distance > 0)
        crease = np.exp(-((distance / 1.6) ** 2))
        shape = (-1, 1, 1) if axis == 0 else (1, -1, 1)
        worn = worn * shade.reshape(shape)
        gaps = 0.35 + 0.35 * fractal_noise(rng, (height, width), 14.0)[..., None]
        share = np.clip(crease.reshape(shape) * gaps * 1.5, 0.0, 0.8)
        worn = worn * (1 - share) + 235.0 * share
    return _clipped(worn), np.eye(3)


def photocopied(rng: np.random.Generator, picture: Image, paper: Colour) -> tuple[Image, Affine]:
    """A copy of a copy: crooked, blurred, black or white only, with specks."""
    turned, affine = skew(rng, picture, paper)
    grey = cv2.GaussianBlur(cv2.cvtColor(turned, cv2.COLOR_RGB2GRAY), (0, 0), 1.0).astype(
        np.float32
    )
    grey += 18.0 * grain(rng, (grey.shape[0], grey.shape[1]))
    dark_paper = sum(paper) < 300
    limit = 128.0 if dark_paper else rng.uniform(140, 190)
    black = np.where(grey > limit, 255.0, 0.0)
    specks = rng.random(grey.shape) < 8e-4
    black[specks] = 255.0 - black[specks]
    copy = cv2.GaussianBlur(black.astype(np.float32), (0, 0), 0.5)
    return _clipped(np.repeat(copy[..., None], 3, axis=2)), affine


def worn_out(rng: np.random.Generator, picture: Image, paper: Colour) -> tuple[Image, Affine]:
    """Several at once: yellow, crooked, noisy, small and badly lit."""
    affine = np.eye(3)
    for step in (yellowed, skew, uneven_light, low_resolution, noise, jpeg):
        fill = paper if step is not skew else _paper_of(picture)
        picture, change = step(rng, picture, fill)
        affine = change @ affine
    return picture, affine


def _paper_of(picture: Image) -> Colour:
    border = np.concatenate([picture[0], picture[-1]])
    red, green, blue = (int(value) for value in np.median(border, axis=0))
    return red, green, blue


DEGRADATIONS: tuple[Degradation, ...] = (
    Degradation("clean", "development", clean),
    Degradation("noise", "development", noise),
    Degradation("skew", "development", skew),
    Degradation("blur", "development", blur),
    Degradation("low-resolution", "development", low_resolution),
    Degradation("yellowed", "development", yellowed),
    Degradation("uneven-light", "development", uneven_light),
    Degradation("jpeg", "development", jpeg),
    Degradation("mirrored", "development", mirrored),
    Degradation("stains", "unseen", stains),
    Degradation("folded", "unseen", folded),
    Degradation("photocopied", "unseen", photocopied),
    Degradation("worn-out", "unseen", worn_out),
)
