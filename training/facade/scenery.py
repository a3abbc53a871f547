"""Skies, roofs and streets, painted over the crops of the training.

The sets say little of them: CMP ends at the eaves, the boxes at the pavement. So a part of the
crops gets a sky with or without clouds, a roof of slates or tiles below it, and a street.
"""

from __future__ import annotations

import torch
from classes import CLASSES
from torch import Tensor
from torch.nn import functional

SKY, ROOF, GROUND = (CLASSES.index(name) for name in ("sky", "roof", "ground"))


def set_scene(pixels: Tensor, allowed: Tensor) -> tuple[Tensor, Tensor, Tensor]:
    """Pixels (n, 3, c, c), their classes (n, classes, c, c), and which were painted (n, c, c)."""
    count, _, height, width = pixels.shape
    device = pixels.device
    y = torch.linspace(0, 1, height, device=device)[None, :, None]
    x = torch.linspace(0, 1, width, device=device)[None, None, :]
    known_sky = allowed[:, SKY] & (allowed.sum(1) == 1)
    eaves = _each(count, device, -0.15, 0.5) + _each(count, device, -0.12, 0.12) * (x - 0.5)
    has_top = _each(count, device, 0, 1) < 0.25
    has_roof = has_top & (_each(count, device, 0, 1) < 0.7)
    depth = torch.where(has_roof, _each(count, device, 0.05, 0.22), torch.zeros(1, device=device))
    gable = _each(count, device, 0, 1) < 0.2
    ridge = (
        eaves
        - depth
        + gable * depth * (2 * (x - _each(count, device, 0.2, 0.8)).abs()).clamp(max=1)
    )
    sky = (has_top & (y < ridge)) | (known_sky & (_each(count, device, 0, 1) < 0.5))
    roof = has_roof & (y >= ridge) & (y < eaves)
    foot = _each(count, device, 0.6, 1.1) + _each(count, device, -0.06, 0.06) * (x - 0.5)
    ground = (_each(count, device, 0, 1) < 0.4) & (y >= foot)
    for where, index, painted in (
        (sky, SKY, _sky(pixels)),
        (roof, ROOF, _roof(pixels)),
        (ground, GROUND, _ground(pixels)),
    ):
        pixels = torch.where(where[:, None], painted, pixels)
        only = torch.arange(len(CLASSES), device=device)[None, :, None, None] == index
        allowed = torch.where(where[:, None], only, allowed)
    return pixels.clamp(0, 1), allowed, sky | roof | ground


def _each(count: int, device: torch.device, low: float, high: float, dims: int = 3) -> Tensor:
    return torch.rand(count, *([1] * (dims - 1)), device=device) * (high - low) + low


def _noise(like: Tensor, rows: int, columns: int, channels: int = 1) -> Tensor:
    rough = torch.randn(len(like), channels, rows, columns, device=like.device)
    return functional.interpolate(rough, size=like.shape[2:], mode="bilinear", align_corners=False)


def _colour(like: Tensor, low: tuple[float, ...], high: tuple[float, ...]) -> Tensor:
    ends = torch.tensor([low, high], device=like.device)
    mix = torch.rand(len(like), 3, device=like.device)
    return (ends[0] + (ends[1] - ends[0]) * mix)[:, :, None, None]


def _sky(like: Tensor) -> Tensor:
    count, device = len(like), like.device
    y = torch.linspace(0, 1, like.shape[2], device=device)[None, None, :, None]
    blue = _colour(like, (0.2, 0.4, 0.6), (0.6, 0.75, 1.0))
    grey = _each(count, device, 0.55, 1.0, 4).expand(-1, 3, -1, -1)
    base = torch.where(_each(count, device, 0, 1, 4) < 0.6, blue + (1 - blue) * 0.5 * y, grey)
    clouds = sum(_noise(like, 2**k + 1, 2**k) / 2 ** (0.8 * k) for k in range(1, 7))
    cover = torch.sigmoid(
        (clouds + _each(count, device, -1.5, 1.0, 4)) * _each(count, device, 1, 8, 4)
    )
    cover = cover * (_each(count, device, 0, 1, 4) < 0.6)
    return base + (_each(count, device, 0.75, 1.0, 4) - base) * cover * _each(
        count, device, 0.3, 1.0, 4
    )


def _roof(like: Tensor) -> Tensor:
    count, device = len(like), like.device
    slate = _each(count, device, 0.15, 0.65, 4) * _colour(like, (0.85, 0.9, 0.95), (1.0, 1.05, 1.2))
    tile = _colour(like, (0.3, 0.12, 0.06), (0.7, 0.4, 0.3))
    base = torch.where(_each(count, device, 0, 1, 4) < 0.6, slate, tile)
    fine = _noise(like, 110, 90) * _each(count, device, 0.0, 0.09, 4)
    rows = _noise(like, 80, 2) * _each(count, device, 0.0, 0.08, 4)
    seams = _noise(like, 2, 50) * _each(count, device, 0.0, 0.07, 4)
    broad = _noise(like, 5, 5) * 0.05
    return base + fine + torch.where(_each(count, device, 0, 1, 4) < 0.6, rows, seams) + broad


def _ground(like: Tensor) -> Tensor:
    count, device = len(like), like.device
    y = torch.linspace(0, 1, like.shape[2], device=device)[None, None, :, None]
    grey = _each(count, device, 0.2, 0.85, 4) * _colour(like, (0.92, 0.92, 0.9), (1.08, 1.05, 1.05))
    grass = _colour(like, (0.15, 0.3, 0.05), (0.5, 0.6, 0.3))
    base = torch.where(_each(count, device, 0, 1, 4) < 0.8, grey, grass)
    grain = _noise(like, 224, 160) * _each(count, device, 0.0, 0.06, 4)
    bands = _noise(like, 40, 2) * _each(count, device, 0.0, 0.1, 4)
    broad = _noise(like, 8, 4) * _each(count, device, 0.0, 0.12, 4)
    kerb = (_each(count, device, 0.6, 1.0, 4) - y).abs() < _each(count, device, 0.0, 0.02, 4)
    return base + grain + bands + broad + 0.2 * kerb
