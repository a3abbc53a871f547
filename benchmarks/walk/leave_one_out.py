"""Views that were left out, made from the key positions on both sides, beside five peers.

`python benchmarks walk/leave_one_out [SET ...] [--pictures FOLDER]` keeps
`benchmarks/results/walk-leave-one-out.md`.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray
from record import Row, record
from walk_peers import (
    both_depths,
    cross_fade,
    dis_flow,
    flat_morph,
    nearest_model,
    second_pose,
)
from walk_sets import PathSet, between, load_set

from veduta.walk.build.judge import psnr
from veduta.walk.build.render import Transition, draw_between
from veduta.walk.build.screen import Screen
from veduta.walk.build.way import find_way
from veduta.walk.read.pairs import read_stereo
from veduta.walk.rig import Image

GAPS = {"kitti03": (2, 4, 8), "kitti-seq1": (2, 4, 6)}
MOST = 4
"""Transitions of each distance: spread over the path."""
PEERS = ("a cross-fade", "b nearest model", "c flat morph", "d DIS flow", "e both depths")
AIM_DB, GRADIENT = 1.0, 0.1
"""How far over (e) is aimed at, and how far the gradients may be off."""


def views(data: PathSet, first: int, last: int) -> tuple[dict[str, Image], Image, float]:
    """The omitted middle view by each method, the true one, and the distance (m)."""
    middle = (first + last) // 2
    own, other = data.model(first), data.model(last)
    way = find_way(own, other, data.rig)
    if way.forth is None or way.back is None:
        raise RuntimeError(f"{data.name}: {first} and {last} have nothing in common")
    screen = Screen.of(data.rig)
    true_end, true_middle = data.true_pose(first, last), data.true_pose(first, middle)
    camera, share = between(true_end, way.second_from_first, true_middle)
    meshes, images = (way.forth, way.back), (own.image, other.image)
    found = (camera, second_pose(camera, way.second_from_first))
    given = (true_middle, second_pose(true_middle, true_end))
    transition = Transition(way.forth, way.back, way.second_from_first, own.image, other.image)
    made = {
        "walk": draw_between(transition, share, camera, screen)[0],
        "a cross-fade": cross_fade(own.image, other.image, share),
        "b nearest model": nearest_model(meshes, images, found, share, screen),
        "c flat morph": flat_morph(meshes, images, share, screen),
        "d DIS flow": dis_flow(own.image, other.image, share),
        "e both depths": both_depths(meshes, images, given, share, screen),
        "e, own poses": both_depths(meshes, images, found, share, screen),
    }
    truth = read_stereo(data.pairs[middle], data.rectifier).left
    return made, truth, float(np.linalg.norm(true_end[:, 3]))


def measures(made: Image, truth: Image) -> tuple[float, float, float]:
    """PSNR (dB), SSIM, and gradient strength over that of the truth."""
    grey = [cv2.cvtColor(image, cv2.COLOR_RGB2GRAY).astype(np.float64) for image in (made, truth)]
    similar = similarity(grey[0], grey[1])
    strengths = [float(np.abs(np.gradient(one)).mean()) for one in grey]
    return psnr(made, truth), similar, strengths[0] / strengths[1]


def similarity(one: NDArray[np.float64], other: NDArray[np.float64]) -> float:
    """SSIM (Wang et al. 2004): Gaussian window of 1.5 px, K 0.01 and 0.03, of values 0..255."""

    def mean(values: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.asarray(cv2.GaussianBlur(values, (11, 11), 1.5), dtype=np.float64)

    a, b = mean(one), mean(other)
    both = mean(one * other) - a * b
    spread = mean(one * one) - a * a + mean(other * other) - b * b
    light = (2 * a * b + 6.5025) / (a * a + b * b + 6.5025)
    return float((light * (2 * both + 58.5225) / (spread + 58.5225))[5:-5, 5:-5].mean())


def not_held(means: dict[str, list[float]]) -> list[str]:
    """Which of the bounds the walk misses. means: PSNR, SSIM and gradient by method."""
    decibels, similar, gradient = means["walk"]
    told = []
    for name in PEERS:
        if means[name][0] >= decibels:
            told.append(f"{means[name][0] - decibels:.2f} dB below {name}")
        if means[name][1] > similar:
            told.append(f"SSIM {means[name][1] - similar:.3f} below {name}")
    over = decibels - means["e both depths"][0]
    if over < AIM_DB:
        told.append(f"{over:.2f} dB over (e), {AIM_DB:.0f} aimed at")
    if abs(gradient - 1.0) > GRADIENT:
        told.append(f"gradient {gradient - 1.0:+.0%}, {GRADIENT:.0%} allowed")
    return told


def rows_of(data: PathSet, gap: int, pictures: Path | None) -> list[Row]:
    """A row per method: the means over the transitions of this distance."""
    starts = list(range(0, len(data.pairs) - gap, gap))
    chosen = [starts[int(n)] for n in np.linspace(0, len(starts) - 1, min(MOST, len(starts)))]
    found: dict[str, list[tuple[float, float, float]]] = {}
    distances = []
    for first in chosen:
        made, truth, distance = views(data, first, first + gap)
        distances.append(distance)
        for name, image in made.items():
            found.setdefault(name, []).append(measures(image, truth))
        if pictures is not None:
            sheet = np.vstack(
                [truth, *(made[name] for name in ("walk", "e both depths", "d DIS flow"))]
            )
            cv2.imwrite(str(pictures / f"{data.name}-{gap}-{first}.png"), sheet[..., ::-1])
    rows: list[Row] = []
    means = {name: np.mean(values, axis=0).tolist() for name, values in found.items()}
    for name, (decibels, similar, gradient) in means.items():
        rows.append(
            {
                "set": data.name, "apart m": float(np.mean(distances)), "views": len(chosen),
                "method": name, "PSNR dB": decibels, "SSIM": similar, "gradient": gradient,
                "not held": "; ".join(not_held(means)) if name == "walk" else "",
            }
        )  # fmt: skip
    return rows


def main() -> None:
    """Measure the sets that are named, or both."""
    parser = argparse.ArgumentParser()
    parser.add_argument("sets", nargs="*", default=list(GAPS))
    parser.add_argument("--pictures", type=Path)
    parser.add_argument("--draft", action="store_true", help="print, and keep nothing")
    called = parser.parse_args()
    rows = [
        row
        for name in called.sets
        for data in [load_set(name)]
        for gap in GAPS[name]
        for row in rows_of(data, gap, called.pictures)
    ]
    notes = [
        "The view in the middle of two key positions, made from both without the omitted pair; the"
        " omitted camera stands where the true poses say that it does on the way.",
        "(e) has the given poses; `e, own poses` has those found here.",
        "gradient: mean strength of the light's gradient over the true view's.",
        "not held: the walk is to be above (a) to (e) in PSNR, 1 dB over (e) is aimed at, SSIM no"
        " lower, gradients within 10 % of the true view's.",
    ]
    if called.draft:
        for row in rows:
            print(*(f"{v:.3f}" if isinstance(v, float) else v for v in row.values()))
    else:
        record("walk-leave-one-out", rows, notes)


if __name__ == "__main__":
    main()
