"""The report's pictures of an animal with limbs: its figure in the frames, its feet's chart."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.fauna.document.limbed import LimbedAnimal
from veduta.fauna.motion.figure import Figure, Floats

Picture = NDArray[np.uint8]
_PANELS = 6
_WIDE = 460
_COLOURS = {"middle": (30, 30, 34), "left": (30, 110, 220), "right": (214, 60, 40)}
_INK, _GRID, _DOWN = (60, 60, 64), (226, 226, 230), (52, 96, 148)


def figures_picture(
    frames: NDArray[np.uint8], masks: NDArray[np.bool_], figure: Figure, joints_px: Floats
) -> Picture:
    """Six frames with the silhouette's outline (green) and the segments: left blue, right red."""
    low = np.maximum(joints_px.min(axis=(0, 1)) - 30.0, 0.0)
    high = np.minimum(joints_px.max(axis=(0, 1)) + 30.0, [frames.shape[2], frames.shape[1]])
    (left, top), (right, bottom) = low.astype(int), high.astype(int)
    scale = _WIDE / max(right - left, 1)
    panels = []
    for row in np.linspace(0, len(frames) - 1, _PANELS).round().astype(int):
        cut = frames[row][top:bottom, left:right]
        panel = np.ascontiguousarray(
            cv2.resize(cut, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA)
        )
        mask = masks[row][top:bottom, left:right].astype(np.uint8)
        large = cv2.resize(mask, panel.shape[1::-1], interpolation=cv2.INTER_NEAREST)
        outlines, _ = cv2.findContours(large, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
        cv2.drawContours(panel, outlines, -1, (60, 170, 90), 1, cv2.LINE_AA)
        at = np.round((joints_px[row] - [left, top]) * scale * 8).astype(np.int32)
        for number, (start, end) in enumerate(zip(figure.start, figure.end, strict=True)):
            colour = _COLOURS[figure.limbs[figure.limb[number]].side]
            cv2.line(panel, _point(at[start]), _point(at[end]), colour, 2, cv2.LINE_AA, shift=3)
        panels.append(cv2.copyMakeBorder(panel, 2, 2, 2, 2, cv2.BORDER_CONSTANT, value=(255,) * 3))
    half = _PANELS // 2
    lines = [np.hstack(panels[:half]), np.hstack(panels[half:])]
    return np.ascontiguousarray(np.vstack(lines), dtype=np.uint8)


def chart_picture(animal: LimbedAnimal, width: int = 900) -> Picture:
    """Figure 13: a bar where a foot stands, frame by frame."""
    poses = animal.poses
    down = np.array(poses.down, dtype=np.bool_).reshape(len(poses.frame), -1)
    line, left = 40, 170
    pixels = np.full((line * (down.shape[1] + 1), width, 3), 255, dtype=np.uint8)
    number = np.array(poses.frame, dtype=np.float64)
    span = max(float(number[-1] - number[0]) + 1.0, 1.0)
    at = left + (number - number[0]) / span * (width - left - 10)
    step = (width - left - 10) / span * float(np.median(np.diff(number)) if len(number) > 1 else 1)
    for column, name in enumerate(poses.feet):
        middle = line * column + line // 2
        _say(pixels, name.replace("_", " "), (8, middle + 5))
        cv2.line(pixels, (left, middle), (width - 10, middle), _GRID, 1)
        for x in at[down[:, column]]:
            first, last = (round(float(x)), middle - 9), (round(float(x + step)), middle + 9)
            cv2.rectangle(pixels, first, last, _DOWN, -1)
    base = line * down.shape[1] + 20
    for share in (0.0, 0.5, 1.0):
        frame = number[0] + share * (span - 1.0)
        x = round(left + (frame - number[0]) / span * (width - left - 10))
        _say(pixels, f"frame {frame:.0f}", (min(x, width - 90), base))
    return pixels


def _point(at: NDArray[np.int32]) -> tuple[int, int]:
    return int(at[0]), int(at[1])


def _say(pixels: Picture, text: str, at: tuple[int, int]) -> None:
    cv2.putText(pixels, text, at, cv2.FONT_HERSHEY_SIMPLEX, 0.45, _INK, 1, cv2.LINE_AA)
