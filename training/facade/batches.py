"""Batches on the device: all pictures lie in its memory, and each is cut and dirtied there.

A crop shows a part of a picture at a random scale and proportion, mirrored or not, a little turned
and tilted, under other light, blurred, with noise, and with things laid before it (`sprites.py`).
"""

from __future__ import annotations

import json
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
import torch
from classes import CLASSES, NOT_OPENINGS, OPENINGS, SETS, place
from scenery import set_scene
from torch import Tensor
from torch.nn import functional

CANVAS_PX = 704
CROP_PX = 448
MOST_ELEMENTS = 400
SHARES = {"cmp": 0.56, "boxes": 0.22, "renders": 0.22}
WHOLE = 0.35
"""The share of batches whose crops show about a whole picture."""


@dataclass
class Batch:
    """What one step learns from.

    `pixels` (n, 3, c, c) 0..1; `allowed` (n, classes, c/2, c/2); `kind` (n, c/4, c/4): the kind of
    the element there, len(KINDS) where it is not known, -1 where there is none, -2 where that is
    not known either; `borders` (n, 4, c/4, c/4) px from there to its borders.
    """

    pixels: Tensor
    allowed: Tensor
    kind: Tensor
    borders: Tensor


class Pictures:
    """The prepared pictures of a folder, in the device's memory."""

    def __init__(self, folder: Path, device: str, held: bool | None) -> None:
        index = json.loads((folder / "elements.json").read_text())
        self.names = [n for n, e in index.items() if held is None or e["held"] == held]
        self.sources = np.array([index[n]["set"] for n in self.names])
        count = len(self.names)
        pixels = np.zeros((count, 3, CANVAS_PX, CANVAS_PX), np.uint8)
        labels = np.zeros((count, 2, CANVAS_PX, CANVAS_PX), np.int16)
        boxes = np.zeros((count, MOST_ELEMENTS, 4), np.float32)
        kinds = np.full((count, MOST_ELEMENTS), -1, np.int64)
        self.sizes = np.zeros((count, 2), np.float32)

        def load(i: int) -> None:
            name = self.names[i]
            picture = cv2.imread(str(folder / f"{name}.jpg"))[..., ::-1]
            height, width = picture.shape[:2]
            self.sizes[i] = width, height
            pixels[i, :, :height, :width] = picture.transpose(2, 0, 1)
            labels[i, 0, :height, :width] = cv2.imread(str(folder / f"{name}.set.png"), -1)
            labels[i, 1, :height, :width] = cv2.imread(str(folder / f"{name}.id.png"), -1)
            for k, (kind, *box) in enumerate(index[name]["elements"][: MOST_ELEMENTS - 1]):
                boxes[i, k + 1], kinds[i, k + 1] = box, kind

        with ThreadPoolExecutor(16) as pool:
            list(pool.map(load, range(count)))
        labels[:, 1][labels[:, 1] >= MOST_ELEMENTS] = 0
        self.pixels = torch.from_numpy(pixels).to(device)
        self.labels = torch.from_numpy(labels).to(device)
        self.boxes = torch.from_numpy(boxes).to(device)
        self.kinds = torch.from_numpy(kinds).to(device)
        self.device = device
        table = torch.tensor([[name in each for name in CLASSES] for each in SETS])
        self.table = table.to(device)
        openings = torch.tensor([name in OPENINGS for name in CLASSES])
        self.open = (table & openings).any(dim=1).to(device)


class Sprites:
    """What is laid before the pictures."""

    def __init__(self, folder: Path, device: str) -> None:
        stored = np.load(folder / "sprites.npz")
        self.pixels = torch.from_numpy(stored["pixels"]).to(device)
        self.kinds = torch.from_numpy(stored["kinds"]).to(device)
        self.names = [CLASSES[k] for k in stored["kinds"]]
        by_name = {
            name: [i for i, n in enumerate(self.names) if n == name] for name in set(self.names)
        }
        self.by_name = {name: np.array(which) for name, which in by_name.items()}


def draw(pictures: Pictures, sprites: Sprites, count: int, rng: np.random.Generator) -> Batch:
    """A batch of `count` crops."""
    which = _choose(pictures, count, rng)
    whole = rng.random() < WHOLE
    maps = _maps(pictures.sizes[which], whole, rng)  # crop from canvas
    device = pictures.device
    crop_from_canvas = torch.from_numpy(maps.astype(np.float32)).to(device)
    grid = _grid(torch.linalg.inv(crop_from_canvas), device)
    index = torch.from_numpy(which).to(device)
    zoom = float(np.sqrt(abs(maps[:, 0, 0] * maps[:, 1, 1])).mean())
    source = pictures.pixels[index].half() / 255.0
    if zoom < 0.7:
        source = functional.avg_pool2d(source, 2)
    pixels = functional.grid_sample(source, grid.half(), align_corners=False).float()
    labels = functional.grid_sample(
        pictures.labels[index].float(), grid, mode="nearest", align_corners=False
    )
    sets, ids = labels[:, 0].long(), labels[:, 1].long()
    inside = (grid.abs() <= 1).all(dim=-1) & _within(grid, pictures.sizes[which], device)
    pixels = _filled(pixels, inside, rng)
    sets = torch.where(inside, sets, place(*NOT_OPENINGS))
    ids = torch.where(inside, ids, 0)
    allowed = pictures.table[sets].permute(0, 3, 1, 2)
    pixels, allowed, hidden = set_scene(pixels, allowed)
    pixels, allowed, before = _lay_before(pixels, allowed, sprites, rng)
    hidden |= before
    ids = torch.where(hidden, 0, ids)
    kind, borders = _elements(pictures, index, crop_from_canvas, sets, ids, hidden)
    return Batch(_dirtied(pixels, rng), allowed[:, :, 1::2, 1::2], kind, borders)


def _choose(pictures: Pictures, count: int, rng: np.random.Generator) -> np.ndarray:
    names = [s for s in SHARES if (pictures.sources == s).any()]
    shares = np.array([SHARES[s] for s in names])
    drawn = rng.choice(len(names), count, p=shares / shares.sum())
    return np.array([rng.choice(np.flatnonzero(pictures.sources == names[d])) for d in drawn])


def _maps(sizes: np.ndarray, whole: bool, rng: np.random.Generator) -> np.ndarray:
    """(n, 3, 3) crop pixels from canvas pixels."""
    count = len(sizes)
    base = np.exp(rng.uniform(np.log(0.7), np.log(1.9)))
    maps = np.zeros((count, 3, 3))
    for i, (width, height) in enumerate(sizes):
        fit = CROP_PX / max(width, height)
        zoom = fit * rng.uniform(0.75, 1.15) if whole else base * rng.uniform(0.85, 1.2)
        stretch = np.exp(rng.normal(0, 0.16))
        sx, sy = zoom * stretch, zoom / stretch
        spare = np.maximum(np.array([width, height]) - CROP_PX / np.array([sx, sy]), 0)
        centre = np.array([width, height]) / 2 + (rng.random(2) - 0.5) * (spare + 30)
        mirror = -1.0 if rng.random() < 0.5 else 1.0
        linear = np.array([[mirror * sx, 0], [0, sy]])
        tilt = np.zeros(2)
        if rng.random() < 0.6:
            angle, shear = rng.normal(0, 0.025, 2)
            linear = np.array([[1, -angle + shear], [angle, 1]]) @ linear
            tilt = rng.normal(0, 0.12, 2) / CROP_PX
        maps[i, :2, :2] = linear
        maps[i, :2, 2] = -linear @ centre
        maps[i, 2, 2] = 1.0
        maps[i] = np.array([[1, 0, 0], [0, 1, 0], [*tilt, 1]]) @ maps[i]
        maps[i] = np.array([[1, 0, CROP_PX / 2], [0, 1, CROP_PX / 2], [0, 0, 1]]) @ maps[i]
    return maps


def _grid(canvas_from_crop: Tensor, device: str) -> Tensor:
    """(n, c, c, 2) places in the canvas, from -1 to 1."""
    at = torch.arange(CROP_PX, device=device, dtype=torch.float32) + 0.5
    y, x = torch.meshgrid(at, at, indexing="ij")
    points = torch.stack([x, y, torch.ones_like(x)], dim=-1)
    found = torch.einsum("nij,hwj->nhwi", canvas_from_crop, points)
    return found[..., :2] / found[..., 2:].clamp(min=1e-3) / (CANVAS_PX / 2) - 1.0


def _within(grid: Tensor, sizes: np.ndarray, device: str) -> Tensor:
    limit = torch.from_numpy(sizes / (CANVAS_PX / 2) - 1.0).to(device)[:, None, None, :]
    return (grid <= limit).all(dim=-1)


def _filled(pixels: Tensor, inside: Tensor, rng: np.random.Generator) -> Tensor:
    """Outside of the picture: one colour, or noise of it."""
    count, device = len(pixels), pixels.device
    colour = torch.from_numpy(rng.random((count, 3, 1, 1)).astype(np.float32)).to(device)
    colour = colour * (torch.rand(count, 1, 1, 1, device=device) > 0.4)
    for size in (4, 24, 120):
        rough = torch.randn(count, 3, size, size, device=device) * 0.15
        strength = torch.rand(count, 1, 1, 1, device=device) * (rng.random() < 0.5)
        colour = colour + strength * functional.interpolate(
            rough, size=(CROP_PX, CROP_PX), mode="bilinear"
        )
    return torch.where(inside[:, None], pixels, colour)


def _lay_before(
    pixels: Tensor, allowed: Tensor, sprites: Sprites, rng: np.random.Generator
) -> tuple[Tensor, Tensor, Tensor]:
    """Up to four sprites over each crop; also where they are, (n, c, c)."""
    count, device = len(pixels), pixels.device
    hidden = torch.zeros(count, CROP_PX, CROP_PX, dtype=torch.bool, device=device)
    names = ("tree", "hedge", "vehicle", "person", "fence", "wire", "other", "ornament")
    shares = (0.18, 0.1, 0.24, 0.14, 0.09, 0.08, 0.07, 0.1)
    for _ in range(4):
        kind = [names[int(k)] for k in rng.choice(len(names), count, p=shares)]
        which = torch.tensor([int(rng.choice(sprites.by_name[k])) for k in kind], device=device)
        theta = torch.from_numpy(np.stack([_stand(k, rng) for k in kind])).to(device)
        grid = functional.affine_grid(theta, [count, 1, CROP_PX, CROP_PX], align_corners=False)
        laid = functional.grid_sample(
            sprites.pixels[which].float() / 255.0, grid, align_corners=False
        )
        alpha = laid[:, 3:] * (torch.rand(count, 1, 1, 1, device=device) < 0.32)
        light = torch.rand(count, 1, 1, 1, device=device) * 0.9 + 0.45
        colour = (laid[:, :3] / laid[:, 3:].clamp(min=0.05) * light).clamp(0, 1)
        pixels = pixels * (1 - alpha) + colour * alpha
        over = alpha[:, 0] > 0.5
        one = functional.one_hot(sprites.kinds[which], len(CLASSES)).bool()[:, :, None, None]
        allowed = torch.where(over[:, None], one, allowed)
        hidden |= over
    return pixels, allowed, hidden


def _stand(kind: str, rng: np.random.Generator) -> np.ndarray:
    """(2, 3) sprite from crop, both from -1 to 1: how large it is, and where its foot stands."""
    large = {
        "tree": (0.4, 1.6),
        "hedge": (0.2, 0.8),
        "vehicle": (0.15, 0.7),
        "person": (0.08, 0.45),
        "ornament": (0.06, 0.5),
    }
    low, high = large.get(kind, (0.15, 0.9))
    size = np.exp(rng.uniform(np.log(low), np.log(high)))
    wide = {"hedge": 3.0, "fence": 2.5, "wire": 2.5, "vehicle": 1.15}.get(kind, 1.0)
    half = size * np.array([wide * rng.uniform(0.8, 1.3), 1.0 if kind != "wire" else 2.0])
    foot = rng.uniform(-0.3, 1.25)
    if kind in ("wire", "ornament"):  # these hang
        foot = rng.uniform(0, 2) if kind == "wire" else rng.uniform(-0.9, 1.25)
    at = np.array([rng.uniform(-1.1, 1.1), foot - half[1]])
    mirror = -1.0 if rng.random() < 0.5 else 1.0
    return np.array(
        [[mirror / half[0], 0, -mirror * at[0] / half[0]], [0, 1 / half[1], -at[1] / half[1]]],
        np.float32,
    )


def _elements(
    pictures: Pictures,
    index: Tensor,
    crop_from_canvas: Tensor,
    sets: Tensor,
    ids: Tensor,
    hidden: Tensor,
) -> tuple[Tensor, Tensor]:
    """Kind and distances to the borders at every fourth pixel."""
    boxes, kinds = pictures.boxes[index], pictures.kinds[index]
    x0, y0, x1, y1 = boxes.unbind(-1)
    corners = torch.stack([torch.stack(p, -1) for p in ((x0, y0), (x1, y0), (x1, y1), (x0, y1))], 2)
    ones = torch.ones_like(corners[..., :1])
    moved = torch.einsum("nij,nmkj->nmki", crop_from_canvas, torch.cat([corners, ones], -1))
    moved = moved[..., :2] / moved[..., 2:].clamp(min=1e-3)
    # the middle of two corners, not the furthest: a tilted element fills its box
    x, y = moved[..., 0].sort(dim=2).values, moved[..., 1].sort(dim=2).values
    box = torch.stack(
        [x[..., :2].mean(2), y[..., :2].mean(2), x[..., 2:].mean(2), y[..., 2:].mean(2)], -1
    )
    at_id, at_set, over = ids[:, 2::4, 2::4], sets[:, 2::4, 2::4], hidden[:, 2::4, 2::4]
    flat = at_id.flatten(1)
    here = torch.gather(box, 1, flat[..., None].expand(-1, -1, 4)).view(*at_id.shape, 4)
    kind = torch.gather(kinds, 1, flat).view(at_id.shape)
    at = torch.arange(CROP_PX // 4, device=ids.device) * 4 + 2.5
    xs, ys = at[None, None, :], at[None, :, None]
    borders = torch.stack(
        [xs - here[..., 0], ys - here[..., 1], here[..., 2] - xs, here[..., 3] - ys], 1
    )
    unknown = pictures.open[at_set] & ~over
    none = torch.where(unknown, -2, -1)
    good = (at_id > 0) & (borders > 0).all(1)
    return torch.where(good, kind, none), borders.clamp(min=0.1)


def _dirtied(pixels: Tensor, rng: np.random.Generator) -> Tensor:
    """Other light, colours, blur, resolution and noise."""
    count, device = len(pixels), pixels.device

    def each(low: float, high: float, channels: int = 1) -> Tensor:
        return torch.rand(count, channels, 1, 1, device=device) * (high - low) + low

    y = torch.linspace(-1, 1, CROP_PX, device=device)[None, None, :, None]
    x = torch.linspace(-1, 1, CROP_PX, device=device)[None, None, None, :]
    edge = torch.sin(each(0, 6.3)) * x + torch.cos(each(0, 6.3)) * y + each(-0.8, 0.8)
    shadow = torch.sigmoid(edge * each(4, 80)) * each(0.0, 0.6) * (each(0, 1) < 0.3)
    pixels = pixels.clamp(1e-4, 1) ** torch.exp(each(-0.45, 0.45)) * (1 - shadow)
    grey = pixels.mean(1, keepdim=True)
    pixels = grey + (pixels - grey) * each(0.0, 1.7)
    middle = pixels.mean((2, 3), keepdim=True)
    pixels = middle + (pixels - middle) * each(0.6, 1.4)
    pixels = pixels * each(0.85, 1.15, 3) * each(0.75, 1.25) + each(-0.06, 0.06)
    size = int(CROP_PX / rng.uniform(1.0, 2.6))
    rough = functional.interpolate(pixels, size=(size, size), mode="bilinear", antialias=True)
    rough = functional.interpolate(rough, size=(CROP_PX, CROP_PX), mode="bicubic")
    pixels = torch.where(each(0, 1) < 0.45, rough, pixels)
    pixels = pixels + torch.randn_like(pixels) * each(0.0, 0.045)
    return (pixels.clamp(0, 1) * 255).round() / 255
