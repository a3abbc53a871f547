"""What stands before facades, drawn or cut out, to be laid over pictures of the training.

    python training/facade/sprites.py OUT     (after prepare.py OUT)

Writes `sprites.npz`: `pixels` (n, 4, SIDE, SIDE) uint8 RGBA, `kinds` (n,) places in CLASSES. Drawn
are trees in leaf and bare, hedges, cars, vans, people, fences, wires, lamps, and signs, which are
parts of the wall. Cut out of the training pictures (of CC0 and CMP, never of those held out) are
the vehicles and people of `marks.json`.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
from classes import CLASSES
from marks import MARKS
from numpy.typing import NDArray

SIDE = 160
EACH = 90
Rng = np.random.Generator
Picture = NDArray[np.uint8]


def main() -> None:
    """Draw, cut, write."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("out", type=Path)
    out = parser.parse_args().out
    rng = np.random.default_rng(7)
    made: list[tuple[str, Picture]] = []
    for kind, draw in DRAWN:
        made += [(kind, draw(rng)) for _ in range(EACH)]
    made += _cut(out)
    pixels = np.stack([sprite.transpose(2, 0, 1) for _, sprite in made])
    kinds = np.array([CLASSES.index(kind) for kind, _ in made], np.int64)
    np.savez_compressed(out / "sprites.npz", pixels=pixels, kinds=kinds)
    sheet = [_on_grey(sprite) for _, sprite in made[:: max(1, len(made) // 60)]][:60]
    rows = [np.hstack(sheet[i : i + 12]) for i in range(0, len(sheet) // 12 * 12, 12)]
    cv2.imwrite(str(out / "sprites.png"), np.vstack(rows)[..., ::-1])
    print(len(made), "sprites")


def _on_grey(sprite: Picture) -> Picture:
    alpha = sprite[..., 3:] / 255.0
    return (sprite[..., :3] * alpha + 170 * (1 - alpha)).astype(np.uint8)


def _blank() -> Picture:
    return np.zeros((SIDE, SIDE, 4), np.uint8)


def _noise(rng: Rng, sizes: tuple[int, ...]) -> NDArray[np.float64]:
    """(SIDE, SIDE) about zero, of patches of these sizes."""
    total = np.zeros((SIDE, SIDE))
    for size in sizes:
        small = rng.standard_normal((SIDE // size + 2, SIDE // size + 2))
        total += cv2.resize(small, (SIDE, SIDE), interpolation=cv2.INTER_CUBIC)
    return total / len(sizes) ** 0.5


def _leaf_colour(rng: Rng) -> NDArray[np.float64]:
    hue = rng.choice([40, 50, 60, 32, 20], p=[0.3, 0.3, 0.25, 0.1, 0.05]) + rng.uniform(-6, 6)
    hsv = np.array([[[hue, rng.uniform(60, 190), rng.uniform(50, 150)]]], np.uint8)
    return cv2.cvtColor(hsv, cv2.COLOR_HSV2RGB)[0, 0].astype(float)


def _leaves(rng: Rng) -> NDArray[np.float64]:
    light = _noise(rng, (2, 5, 12, 40)) * rng.uniform(0.25, 0.5) + 1.0
    return np.clip(_leaf_colour(rng) * light[..., None], 0, 255)


def _tree(rng: Rng) -> Picture:
    sprite = _blank()
    trunk = int(rng.uniform(4, 9))
    bark = tuple(float(v) for v in rng.uniform(30, 90, 3))
    cv2.line(sprite, (SIDE // 2, SIDE), (SIDE // 2, 70), (*bark, 255), trunk)
    if rng.random() < 0.3:
        _branch(rng, sprite, np.array([SIDE / 2, 110.0]), -np.pi / 2, 34.0, trunk, bark)
        return sprite
    crown = np.zeros((SIDE, SIDE), np.uint8)
    centre = np.array([SIDE / 2, rng.uniform(50, 70)])
    for _ in range(int(rng.uniform(12, 40))):
        at = centre + rng.standard_normal(2) * (26, 20)
        radius = int(rng.uniform(8, 26))
        cv2.circle(crown, tuple(int(v) for v in at), radius, 255, -1)
    holes = _noise(rng, (3, 8)) > rng.uniform(0.6, 2.0)
    crown[holes] = 0
    sprite[crown > 0] = np.dstack([_leaves(rng), np.full((SIDE, SIDE), 255.0)])[crown > 0]
    return sprite


def _branch(
    rng: Rng,
    sprite: Picture,
    at: NDArray[np.float64],
    angle: float,
    length: float,
    width: int,
    colour: tuple[float, ...],
) -> None:
    if length < 5:
        return
    end = at + length * np.array([np.cos(angle), np.sin(angle)])
    ends = [tuple(int(v) for v in p) for p in (at, end)]
    cv2.line(sprite, ends[0], ends[1], (*colour, 255), max(1, width))
    for turn in rng.uniform(-0.8, 0.8, 3):
        _branch(rng, sprite, end, angle + turn, length * rng.uniform(0.6, 0.85), width - 2, colour)


def _hedge(rng: Rng) -> Picture:
    sprite = _blank()
    tops = SIDE * rng.uniform(0.1, 0.6) + 6 * _noise(rng, (6, 20))[0]
    mask = np.arange(SIDE)[:, None] > tops[None, :]
    sprite[mask] = np.dstack([_leaves(rng), np.full((SIDE, SIDE), 255.0)])[mask]
    return sprite


def _vehicle(rng: Rng) -> Picture:
    sprite = _blank()
    grey = rng.random() < 0.65
    body = np.full(3, rng.uniform(10, 240)) if grey else rng.uniform(10, 230, 3)
    paint = (*(float(v) for v in body), 255)
    tall = rng.random() < 0.35
    roof = rng.uniform(20, 50) if tall else rng.uniform(70, 85)
    hood, foot = (roof + 35 if tall else rng.uniform(100, 108)), 140
    front, back = (
        (rng.uniform(8, 25), rng.uniform(2, 8))
        if tall
        else (rng.uniform(40, 55), rng.uniform(15, 40))
    )
    outline = [
        (4, foot),
        (4, hood + 4),
        (front, hood),
        (front + 16, roof),
        (SIDE - back - 14, roof),
        (SIDE - back, hood - 2),
        (SIDE - 4, hood + 6),
        (SIDE - 4, foot),
    ]
    cv2.fillPoly(sprite, [np.array(outline, np.int32)], paint)
    glass = (*(float(v) for v in rng.uniform(20, 110, 3)), 255)
    low = hood - 2 if not tall else roof + 40
    right = SIDE - back - 16 if rng.random() < 0.7 or not tall else front + 45
    window = [(front + 6, low), (front + 20, roof + 6), (right, roof + 6), (right + 6, low)]
    cv2.fillPoly(sprite, [np.array(window, np.int32)], glass)
    for x in np.linspace(front + 20, right, 4)[1:-1]:
        cv2.line(sprite, (int(x), int(roof)), (int(x), int(low)), paint, 4)
    for x in (36, SIDE - 36):
        cv2.circle(sprite, (x, foot), 16, (15, 15, 15, 255), -1)
        cv2.circle(sprite, (x, foot), 8, (*(float(v) for v in rng.uniform(60, 190, 3)), 255), -1)
    return _shaded(rng, sprite)


def _shaded(rng: Rng, sprite: Picture) -> Picture:
    light = 1.0 + 0.12 * _noise(rng, (10, 50)) + np.linspace(0.15, -0.2, SIDE)[:, None]
    sprite[..., :3] = np.clip(sprite[..., :3] * light[..., None], 0, 255).astype(np.uint8)
    return sprite


def _person(rng: Rng) -> Picture:
    sprite = _blank()
    middle = SIDE // 2
    coat, legs = ((*(float(v) for v in rng.uniform(10, 220, 3)), 255) for _ in range(2))
    spread = int(rng.uniform(2, 16))
    for side in (-1, 1):
        cv2.line(sprite, (middle + side * 6, 95), (middle + side * spread, 156), legs, 11)
        arm = int(rng.uniform(10, 28))
        cv2.line(sprite, (middle + side * 14, 45), (middle + side * arm, 95), coat, 8)
    cv2.ellipse(sprite, (middle, 68), (int(rng.uniform(14, 22)), 38), 0, 0, 360, coat, -1)
    skin = (*(float(v) for v in np.array([200, 150, 120]) * rng.uniform(0.3, 1.1)), 255)
    cv2.circle(sprite, (middle, 22), 11, skin, -1)
    cv2.ellipse(sprite, (middle, 17), (12, 9), 0, 180, 360, (30, 25, 20, 255), -1)
    return _shaded(rng, sprite)


def _fence(rng: Rng) -> Picture:
    sprite = _blank()
    colour = (*(float(v) for v in np.full(3, rng.uniform(10, 220)) + rng.uniform(-15, 15, 3)), 255)
    step, thick = int(rng.uniform(5, 18)), int(rng.uniform(1, 5))
    top = int(rng.uniform(20, 100))
    for x in range(0, SIDE, step):
        cv2.line(sprite, (x, top + int(rng.uniform(-2, 3))), (x, SIDE), colour, thick)
    for y in (top + 8, (top + SIDE) // 2, SIDE - 8)[: int(rng.integers(2, 4))]:
        cv2.line(sprite, (0, y), (SIDE, y), colour, max(2, thick))
    return sprite


def _wires(rng: Rng) -> Picture:
    sprite = _blank()
    colour = (*(float(v) for v in np.full(3, rng.uniform(5, 90))), 255)
    for _ in range(int(rng.integers(1, 5))):
        x = np.linspace(0, SIDE, 24)
        y0, y1, sag = rng.uniform(0, SIDE), rng.uniform(0, SIDE), rng.uniform(0, 30)
        y = y0 + (y1 - y0) * x / SIDE + sag * np.sin(np.pi * x / SIDE)
        line = np.stack([x, y], axis=1).astype(np.int32)
        cv2.polylines(sprite, [line], False, colour, 1)
    return sprite


def _lamp(rng: Rng) -> Picture:
    sprite = _blank()
    colour = (*(float(v) for v in np.full(3, rng.uniform(10, 150))), 255)
    x, width = SIDE // 2, int(rng.uniform(2, 7))
    cv2.line(sprite, (x, SIDE), (x, 8), colour, width)
    if rng.random() < 0.6:
        size = int(rng.uniform(8, 22))
        cv2.rectangle(
            sprite,
            (x - size, 6),
            (x + size, 6 + int(size * rng.uniform(0.5, 2))),
            (*(float(v) for v in rng.uniform(20, 240, 3)), 255),
            -1,
        )
    return sprite


def _sign(rng: Rng) -> Picture:
    """A board, a banner or a poster on the wall: flat, with words or stripes, and no opening."""
    sprite = _blank()
    half = np.array([rng.uniform(18, 78), rng.uniform(8, 78)])
    x0, y0 = (int(v) for v in SIDE / 2 - half)
    x1, y1 = (int(v) for v in SIDE / 2 + half)
    board = rng.uniform(0, 255, 3)
    ink = np.where(board.mean() > 127, rng.uniform(0, 90, 3), rng.uniform(165, 255, 3))
    cv2.rectangle(sprite, (x0, y0), (x1, y1), (*(float(v) for v in board), 255), -1)
    if rng.random() < 0.5:
        cv2.rectangle(sprite, (x0, y0), (x1, y1), (*(float(v) for v in ink), 255), 2)
    if rng.random() < 0.4:  # a picture on it
        patch = np.clip(board[None, None] + 60 * _noise(rng, (8, 30))[..., None], 0, 255)
        low = y0 + int(0.4 * (y1 - y0))
        sprite[low : y1 - 3, x0 + 3 : x1 - 3, :3] = patch[low : y1 - 3, x0 + 3 : x1 - 3]
    at = float(y0)
    while at < y1 - 4 and rng.random() < 0.9:
        size = rng.uniform(0.25, 1.2)
        at += 24 * size
        letters = "".join(chr(int(code)) for code in rng.integers(65, 91, int(rng.integers(2, 12))))
        face = int(rng.integers(0, 8))
        place = (x0 + int(rng.uniform(2, 12)), int(at))
        thick = int(rng.integers(1, 4))
        drawn = sprite.copy()
        cv2.putText(drawn, letters, place, face, size, (*(float(v) for v in ink), 255), thick)
        sprite[y0 : y1 + 1, x0 : x1 + 1] = drawn[y0 : y1 + 1, x0 : x1 + 1]
    return _shaded(rng, sprite)


DRAWN: tuple[tuple[str, Callable[[Rng], Picture]], ...] = (
    ("tree", _tree),
    ("hedge", _hedge),
    ("vehicle", _vehicle),
    ("person", _person),
    ("fence", _fence),
    ("wire", _wires),
    ("other", _lamp),
    ("ornament", _sign),
)


def _cut(out: Path) -> list[tuple[str, Picture]]:
    """Vehicles and people of the marks, parted from their surroundings by GrabCut."""
    index = json.loads((out / "elements.json").read_text())
    found = []
    for name, marks in json.loads(MARKS.read_text()).items():
        if name not in index or index[name]["held"]:
            continue
        pixels = cv2.imread(str(out / f"{name}.jpg"))
        height, width = pixels.shape[:2]
        for kind, *box in marks:
            x0, x1 = (round(v * width / 100) for v in box[0::2])
            y0, y1 = (round(v * height / 100) for v in box[1::2])
            if kind in ("vehicle", "person") and min(x1 - x0, y1 - y0) >= 18:
                found += [(kind, _cut_out(pixels, (x0, y0, x1, y1)))] * 6
    return found


def _cut_out(pixels: Picture, box: tuple[int, int, int, int]) -> Picture:
    x0, y0, x1, y1 = box
    pad = 6
    left, top = max(0, x0 - pad), max(0, y0 - 2 * pad)
    crop = pixels[top : y1 + pad, left : x1 + pad]
    mask = np.zeros(crop.shape[:2], np.uint8)
    inside = (x0 - left, y0 - top, x1 - x0, y1 - y0)
    cv2.grabCut(crop, mask, inside, np.zeros((1, 65)), np.zeros((1, 65)), 4, cv2.GC_INIT_WITH_RECT)
    alpha = np.where((mask == cv2.GC_FGD) | (mask == cv2.GC_PR_FGD), 255, 0).astype(np.uint8)
    if (alpha > 0).mean() < 0.3:
        alpha[:] = 0
        cv2.ellipse(
            alpha,
            (alpha.shape[1] // 2, alpha.shape[0] // 2),
            (alpha.shape[1] // 2, alpha.shape[0] // 2),
            0,
            0,
            360,
            255,
            -1,
        )
    cut = np.dstack([crop[..., ::-1], alpha])
    scale = SIDE / max(cut.shape[:2])
    cut = cv2.resize(cut, None, fx=scale, fy=scale, interpolation=cv2.INTER_LINEAR)
    sprite = _blank()
    x = (SIDE - cut.shape[1]) // 2
    sprite[SIDE - cut.shape[0] :, x : x + cut.shape[1]] = cut
    return sprite


if __name__ == "__main__":
    main()
