"""Textures of drives past whole houses, against renderings without what stands before them.

python benchmarks drive/made_texture FOLDER [SEEDS] [FIRST]

As `drive/synthetic_texture`, on streets of houses by the facade generator and the grammar. The
truth of a texel is what an image without cars, trees and lamps shows there, of the images the one
that looks at it most squarely, from its true place. Windows are those that the houses have.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from derived_houses import derived_house
from numpy.typing import NDArray
from synthetic_texture import (
    AROUND,
    CAMERA,
    MOST_SEEN,
    ON_FRONT_M,
    Mask,
    Pane,
    Truth,
    keep_streets,
    measured,
    places_of,
)

from veduta.drive.build.segment import Textured
from veduta.drive.options import DriveOptions
from veduta.place.semantics import SemanticClass
from veduta.synthetic.drives import (
    Kind,
    MadeHouse,
    MadeStreet,
    MadeStreetOptions,
    Taken,
    TruckOptions,
    generated_house,
    make_street,
    scan_street,
    take_photos,
    write_drive,
    write_photos,
)
from veduta.synthetic.drives.made_photos import pinhole_of
from veduta.synthetic.drives.scan import poses_at
from veduta.synthetic.render import measure

LENGTH_M, HOUSES = 36.0, 41
STREET = MadeStreetOptions(length_m=LENGTH_M, trees=0.7)
TRUCK = TruckOptions(level=True, divergence_rad=0.015)
BESIDE_M, FEWEST, EVERY = 0.6, 200, 3
PANES = [one.code for one in (SemanticClass.WINDOW, SemanticClass.SHOP, SemanticClass.DOOR)]


def house(seed: int) -> MadeHouse:
    """Every other one of the facade generator, the rest of the grammar."""
    return derived_house(seed % HOUSES) if seed % 2 else generated_house(seed % HOUSES)


def street_of(seed: int) -> MadeStreet:
    """The same for the same seed."""
    return make_street(STREET, seed, lru_cache(house))


def shoot(folder: Path, seed: int) -> None:
    """The drive as files; beside them the images without what stands before, and what that hides.

    Of each image: the pixels, and through their middles the feature and the depth (m).
    """
    street = street_of(seed)
    write_drive(scan_street(street, TRUCK, seed), folder)
    masks: dict[str, NDArray[np.uint8]] = {}

    def kept() -> Iterator[Taken]:
        for one in take_photos(street, None, TRUCK, CAMERA, seed):
            masks[f"before-{one.name}"] = np.packbits(one.photo.before)
            masks[f"front-{one.name}"] = np.packbits(one.photo.front)
            seen = measure(street.bare, pinhole_of(CAMERA, _pose(street, one.time_s)))
            np.savez_compressed(
                folder / f"bare-{one.name}.npz", allow_pickle=False, pixels=one.photo.behind,
                feature=seen.feature, depth=seen.depth_m.astype(np.float16), time_s=one.time_s,
            )  # fmt: skip
            yield one

    write_photos(kept(), CAMERA, folder)
    np.savez_compressed(folder / "truth.npz", allow_pickle=False, **masks)


def _pose(street: MadeStreet, time_s: float) -> NDArray[np.float64]:
    """(3, 4) world_from_vehicle where an image was taken."""
    found = poses_at(np.array([time_s * TRUCK.speed_m_s]), TRUCK, street.way)
    return np.asarray(found[0], dtype=np.float64)


@dataclass(eq=False)
class _Sampled:
    """What the squarest image shows of each texel. feature: (h, w), -1 where none does."""

    pixels: NDArray[np.uint8]
    feature: NDArray[np.int32]
    aside: NDArray[np.float64]


def _sampled(folder: Path, street: MadeStreet, places: NDArray[np.float64]) -> _Sampled:
    shape = places.shape[:2]
    best = _Sampled(
        np.full((*shape, 3), 128, np.uint8), np.full(shape, -1, np.int32), np.full(shape, np.inf)
    )
    for path in sorted(folder.glob("bare-*.npz")):
        with np.load(path) as image:
            _take(best, dict(image), street, places)
    return best


def _take(
    best: _Sampled, image: dict[str, NDArray[Any]], street: MadeStreet, places: NDArray[np.float64]
) -> None:
    camera = CAMERA.world_from_cam(_pose(street, float(image["time_s"])))
    local = (places - camera[:, 3]) @ camera[:, :3]
    with np.errstate(invalid="ignore", divide="ignore"):
        x, y = (local[..., k] / local[..., 2] * CAMERA.focal_px for k in (0, 1))
    x, y = x + CAMERA.width_px / 2, y + CAMERA.height_px / 2
    aside = np.abs(x - CAMERA.width_px / 2)
    inside = (local[..., 2] > 0.5) & (x >= 0) & (x < CAMERA.width_px)
    inside &= (y >= 0) & (y < CAMERA.height_px) & (aside < best.aside)
    row, column = (np.where(inside, one, 0).astype(int) for one in (y, x))
    off = np.abs(image["depth"][row, column].astype(np.float64) - local[..., 2])
    chosen = inside & (off < ON_FRONT_M)
    across, down = (np.where(chosen, one - 0.5, 0).astype(np.float32) for one in (x, y))
    shown = cv2.remap(
        image["pixels"], across, down, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE
    )
    best.pixels[chosen] = shown[chosen]
    best.feature[chosen] = image["feature"][row, column][chosen]
    best.aside[chosen] = aside[chosen]


def truth_of(folder: Path, street: MadeStreet, textured: Textured) -> Truth:
    """Of an atlas, from the images without what stands before."""
    places = places_of(textured)
    best = _sampled(folder, street, places)
    own = np.maximum(best.feature, 0)
    there = (best.feature >= 0) & (street.bare_kinds[own] == Kind.WALL)
    codes = street.bare_codes[own]
    wall = there & (codes == SemanticClass.WALL.code)
    glazed = np.where(there & np.isin(codes, PANES), best.feature, -1)
    panes = tuple(_panes(glazed, wall, best.pixels))
    atlas = textured.atlas
    cut = np.zeros_like(there)
    for pane in panes[::EVERY]:
        more = round(AROUND * _wide(pane.own))
        about = _box(pane.own, more, more)
        if (atlas.seen & about).sum() > MOST_SEEN * about.sum():
            cut |= about
    return Truth(best.pixels, there, panes, cut)


def _panes(glazed: NDArray[np.int32], wall: Mask, pixels: NDArray[np.uint8]) -> Iterator[Pane]:
    """Windows that are large enough, and what stands beside each."""
    beside = round(BESIDE_M / DriveOptions().texture.texel_m)
    for number in np.unique(glazed[glazed >= 0]).tolist():
        own = glazed == number
        around = wall & _box(own, beside, beside)
        if own.sum() >= FEWEST and around.sum() >= FEWEST:
            colour = np.median(pixels[around], axis=0).astype(np.float32)
            yield Pane(own, _box(own, beside, 0), colour)


def _wide(own: Mask) -> int:
    """Columns from the first texel to the last one."""
    return int(np.ptp(np.flatnonzero(own.any(axis=0)))) + 1


def _box(own: Mask, across: int, up: int) -> Mask:
    """(h, w) the box of some texels, larger by so many on each side."""
    rows, columns = np.flatnonzero(own.any(axis=1)), np.flatnonzero(own.any(axis=0))
    found = np.zeros_like(own)
    high = slice(max(rows[0] - up, 0), rows[-1] + 1 + up)
    found[high, max(columns[0] - across, 0) : columns[-1] + 1 + across] = True
    return found


def one_seed(folder: Path, seed: int) -> dict[str, Any]:
    """All figures of a drive."""
    if not (folder / "truth.npz").is_file():
        shoot(folder, seed)
    street = street_of(seed)
    return measured(folder, lambda one: truth_of(folder, street, one))


def _notes(seeds: int, first: int) -> list[str]:
    return [
        f"{seeds} streets of {LENGTH_M:.0f} m of houses by the facade generator and by rules, seeds"
        f" from {first} on, which choose nothing; images of {CAMERA.width_px} x"
        f" {CAMERA.height_px} px every {CAMERA.spacing_m} m, under an overcast sky.",
        "The truth of a texel: the squarest image without cars, trees and lamps; windows, doors and"
        " shops by the houses' own classes.",
    ]


def main() -> None:
    """Measure, print and keep."""
    keep_streets("drive-made-texture", one_seed, _notes)


if __name__ == "__main__":
    main()
