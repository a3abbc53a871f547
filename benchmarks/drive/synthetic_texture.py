"""Textures of synthetic drives with images, against the same fronts without what stood before them.

python benchmarks drive/synthetic_texture FOLDER [SEEDS] [FIRST]

Of each seed a drive is shot into FOLDER, which keeps its row, so that a run may be cut in pieces.
Holes of the atlas wider than a window are filled by the verb and by OpenCV's two inpaintings, on
the same atlas. A window counts as found again where what differs from the wall's colour has a box
that agrees with the true one by an intersection over union of 0.5; the same looks for the windows
in the true texture, as a control. What hides the fronts in the images is compared pixel by pixel.
"""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray
from record import keep_or_print
from texture_measures import psnr, ssim

from veduta.drive.build.atlas import Atlas, grid_places
from veduta.drive.build.backdrop import backdrop_of
from veduta.drive.build.beside import column_spacing, points_beside
from veduta.drive.build.near_images import NearImages
from veduta.drive.build.pictures_of import Around, Seen
from veduta.drive.build.segment import Geometry, Textured, frame_of, reconstruct, texture
from veduta.drive.build.solid import solid_below
from veduta.drive.build.texture_fill import fill_texture
from veduta.drive.options import DriveOptions, TextureOptions
from veduta.drive.read.own import read_own
from veduta.drive.read.segments import cut_segments, driven_line
from veduta.synthetic.drives import (
    Fronts,
    StreetCamera,
    StreetOptions,
    Taken,
    TruckOptions,
    build_street,
    scan_street,
    take_photos,
    write_drive,
    write_photos,
)

STREET = StreetOptions(length_m=36.0, near_trees=0.8, trees=0.5)
CAMERA = StreetCamera(spacing_m=1.5)
WINDOW_M, HIDDEN, FOUND = 1.2, 0.6, 0.5
ON_FRONT_M, DIFFERS = 0.35, 60.0
FIRST_UNSEEN = 500
AROUND, MOST_SEEN = 0.35, 0.97
HOLES_NOTE = (
    "Holes as they come: wider and higher than a window. Cut: about every third window that is"
    f" seen, wider by {AROUND} of its width on each side. PSNR and SSIM are means over streets,"
    " weighed by texels. Windows: a box that agrees by an intersection over union of 0.5; the"
    " control looks for them in the true texture."
)
Pixels = NDArray[np.uint8]
Mask = NDArray[np.bool_]
Row = dict[str, str | int | float | bool | None]


def shoot(folder: Path, seed: int) -> None:
    """The drive as files, and beside them what hides the fronts in its images."""
    street = build_street(STREET, seed)
    truck = TruckOptions(level=True)
    write_drive(scan_street(street, truck, seed), folder)
    masks: dict[str, NDArray[np.uint8]] = {}

    def kept() -> Iterator[Taken]:
        for one in take_photos(street, Fronts(street, seed), truck, CAMERA, seed):
            masks[f"before-{one.name}"] = np.packbits(one.photo.before)
            masks[f"front-{one.name}"] = np.packbits(one.photo.front)
            yield one

    write_photos(kept(), CAMERA, folder)
    np.savez_compressed(folder / "truth.npz", allow_pickle=False, **masks)


def made(folder: Path) -> list[tuple[Geometry, Textured, list[Seen]]]:
    """What the verb makes of the drive's left side."""
    options = DriveOptions()
    drive = read_own(folder)
    spacing = column_spacing(drive, options)
    found = []
    for segment in cut_segments(driven_line(drive.path(), spacing, 0.0), spacing):
        if segment.side == "left" and segment.fate == "build":
            points = points_beside(drive, segment, options)
            one = reconstruct(segment, frame_of(segment, options, drive.height_m), points, options)
            found.append(one)

    def around(one: Geometry) -> Around:
        high = options.texture.wall_top_m
        backdrop = backdrop_of(one.background, one.frame, high)
        crowns, solid = one.crowns(options.seed), solid_below(one.layers)
        return Around(one.foreground(), crowns, (backdrop,), solid)

    images = NearImages(drive.shots, [(one.segment, partial(around, one)) for one in found])
    result = []
    unfilled = options.model_copy(update={"texture": TextureOptions(fill=False)})
    for one in found:
        seen = images.near(one.segment)
        result.append((one, texture(one, seen, unfilled), seen))
    return result


def places_of(one: Textured) -> NDArray[np.float64]:
    """(h, w, 3) world points of the atlas's texels, from its rows and columns."""
    atlas, frame = one.atlas, one.geometry.frame
    grid = frame.vertices(one.background.depth)
    rows, columns = grid_places(atlas.row, atlas.column, atlas.seen.shape)
    across, down = np.meshgrid(columns.astype(np.float32), rows.astype(np.float32))
    middle = frame.origins[0]
    near = (grid - middle).astype(np.float32)
    found = cv2.remap(near, across, down, cv2.INTER_LINEAR)
    return np.asarray(found + middle, dtype=np.float64)


def true_texture(
    fronts: Fronts, places: NDArray[np.float64], texel_m: float
) -> tuple[Pixels, Mask]:
    """(h, w, 3) the fronts at those places, and (h, w) where one stands there."""
    flat = np.nan_to_num(places.reshape(-1, 3), nan=-1e3)
    number = fronts.number_at(flat[:, 1])
    front = np.array([house.front_m for house in fronts.houses])[number]
    low = np.array([house.low_m for house in fronts.houses])[number]
    top = np.array([house.top_m for house in fronts.houses])[number]
    there = (np.abs(flat[:, 0] - front) < ON_FRONT_M) & (flat[:, 1] > low)
    there &= (flat[:, 2] > 0.05) & (flat[:, 2] < top)
    colour = np.full(flat.shape, 128.0)
    foot = np.full(int(there.sum()), texel_m)
    colour[there] = fronts.colours(flat[there, 1], flat[there, 2], foot)
    shape = places.shape[:2]
    return np.rint(colour).astype(np.uint8).reshape(*shape, 3), there.reshape(shape)


def wide_holes(holes: Mask, places: NDArray[np.float64]) -> Mask:
    """The holes that are wider and higher than a window."""
    count, label, boxes, _ = cv2.connectedComponentsWithStats(holes.astype(np.uint8))
    found = np.zeros_like(holes)
    for number in range(1, count):
        if boxes[number, cv2.CC_STAT_AREA] < 400:
            continue
        own = places[label == number]
        wide, _, high = (
            np.nanquantile(own, 0.98, axis=0)[[1, 0, 2]]
            - np.nanquantile(own, 0.02, axis=0)[[1, 0, 2]]
        )
        if wide > WINDOW_M and high > 0.5 * WINDOW_M:
            found |= label == number
    return found


@dataclass(frozen=True, eq=False)
class Pane:
    """A window in the atlas. own: (h, w) its texels. about: (h, w) it and what is beside it. wall:
    (3,) the colour of the wall around.
    """

    own: Mask
    about: Mask
    wall: NDArray[np.float32]


def panes_of(fronts: Fronts, places: NDArray[np.float64]) -> Iterator[Pane]:
    """The windows of boxes."""
    y, z = places[..., 1], places[..., 2]
    for house in fronts.houses:
        for y0, y1, z0, z1 in house.panes.tolist():
            own = (y > y0) & (y < y1) & (z > z0) & (z < z1)
            about = (y > y0 - 0.6) & (y < y1 + 0.6) & (z > z0 - 0.02) & (z < z1 + 0.02)
            yield Pane(own, about, house.wall)


def windows(pixels: Pixels, panes: Iterable[Pane], chosen: Mask) -> tuple[int, int]:
    """How many windows lie mostly in the chosen part, and how many of them stand there in it."""
    inside, found = 0, 0
    smooth = cv2.blur(pixels, (5, 5)).astype(np.float32)
    for pane in panes:
        own = pane.own
        if own.sum() < 200 or (own & chosen).sum() < HIDDEN * own.sum():
            continue
        inside += 1
        unlike = np.abs(smooth - pane.wall).max(axis=2) > DIFFERS
        found += _agrees(pane.about & unlike, own)
    return inside, found


def _agrees(there: Mask, own: Mask) -> bool:
    """Whether the box of the largest thing found agrees with the window's."""
    closed = cv2.morphologyEx(there.astype(np.uint8), cv2.MORPH_CLOSE, np.ones((7, 7), np.uint8))
    count, label, boxes, _ = cv2.connectedComponentsWithStats(closed)
    if count < 2:
        return False
    largest = 1 + int(np.argmax(boxes[1:, cv2.CC_STAT_AREA]))
    first, second = _box(own), _box(label == largest)
    low, high = np.maximum(first[:2], second[:2]), np.minimum(first[2:], second[2:])
    both = float(np.prod(np.maximum(high - low, 0)))
    either = sum(float(np.prod(one[2:] - one[:2])) for one in (first, second)) - both
    return both / either >= FOUND


def _box(mask: Mask) -> NDArray[np.float64]:
    rows, columns = np.nonzero(mask)
    return np.array([rows.min(), columns.min(), rows.max() + 1, columns.max() + 1], dtype=float)


def cut_windows(atlas: Atlas, fronts: Fronts, places: NDArray[np.float64]) -> Mask:
    """(h, w) a hole about every third window that images show, a third of its width wider."""
    holes = np.zeros_like(atlas.seen)
    y, z = places[..., 1], places[..., 2]
    for house in fronts.houses:
        for y0, y1, z0, z1 in house.panes[::3].tolist():
            more = AROUND * (y1 - y0)
            about = (y > y0 - more) & (y < y1 + more) & (z > z0 - more) & (z < z1 + more)
            if about.sum() > 200 and atlas.seen[about].mean() > MOST_SEEN:
                holes |= about
    return holes


@dataclass(frozen=True, eq=False)
class Truth:
    """Of an atlas. pixels: (h, w, 3). there: (h, w) where a front stands. panes: its windows.
    cut: (h, w) holes to be cut about windows.
    """

    pixels: Pixels
    there: Mask
    panes: tuple[Pane, ...]
    cut: Mask


def truth_of(textured: Textured, fronts: Fronts, texel_m: float) -> Truth:
    """What is painted on the boxes."""
    places = places_of(textured)
    pixels, there = true_texture(fronts, places, texel_m)
    panes = tuple(panes_of(fronts, places))
    return Truth(pixels, there, panes, cut_windows(textured.atlas, fronts, places))


def textures(textured: Textured, known: Truth, texel_m: float, pictures: Path) -> list[Row]:
    """A row of each method, in holes as they come and in holes that are cut about windows."""
    places, atlas = places_of(textured), textured.atlas
    own = wide_holes(atlas.surface & ~atlas.seen, places) & known.there
    np.savez_compressed(
        pictures.with_suffix(".npz"), allow_pickle=False, pixels=atlas.pixels, seen=atlas.seen,
        surface=atlas.surface, truth=known.pixels, there=known.there, own=own,
        places=places.astype(np.float32), row=atlas.row, column=atlas.column,
    )  # fmt: skip
    ground = atlas.spread(~textured.background.wall)
    rows = _compared("as they come", atlas, own, known, ground, texel_m, pictures)
    seen = atlas.seen & ~known.cut
    grey = np.where(seen[..., None], atlas.pixels, np.uint8(128))
    spoilt = replace(atlas, pixels=grey, seen=seen)
    path = pictures.with_name(f"cut-{pictures.name}")
    rows += _compared("cut", spoilt, known.cut & known.there, known, ground, texel_m, path)
    rows.append(_row("what images show", "-", atlas.pixels, known.pixels, atlas.seen & known.there))
    return rows


def _compared(
    name: str, atlas: Atlas, chosen: Mask, known: Truth, ground: Mask, texel_m: float,
    pictures: Path,
) -> list[Row]:  # fmt: skip
    unknown = (~atlas.seen).astype(np.uint8)
    methods: dict[str, Callable[[], NDArray[Any]]] = {
        "veduta": lambda: fill_texture(atlas, texel_m, ground=ground)[0],
        "OpenCV Telea": lambda: cv2.inpaint(atlas.pixels, unknown, 5, cv2.INPAINT_TELEA),
        "OpenCV Navier-Stokes": lambda: cv2.inpaint(atlas.pixels, unknown, 5, cv2.INPAINT_NS),
        "truth (control)": lambda: known.pixels,
    }
    rows: list[Row] = []
    drawn = [np.where(atlas.seen[..., None], atlas.pixels, np.array([220, 40, 40], np.uint8))]
    for method, fill in methods.items():
        begin = time.process_time()
        pixels = np.asarray(fill(), dtype=np.uint8)
        seconds = time.process_time() - begin
        inside, found = windows(pixels, known.panes, chosen)
        row = _row(name, method, pixels, known.pixels, chosen)
        rows.append(row | {"windows hidden": inside, "found again": found, "seconds": seconds})
        drawn.append(pixels)
    drawn.append(np.where(chosen[..., None], np.uint8(255), np.uint8(0)).repeat(3, axis=2))
    cv2.imwrite(str(pictures), np.vstack(drawn)[..., ::-1])
    return rows


def _row(holes: str, method: str, pixels: Pixels, truth: Pixels, chosen: Mask) -> Row:
    one, other = pixels / 255.0, truth / 255.0
    some = bool(chosen.any())
    return {
        "holes": holes, "method": method, "texels": int(chosen.sum()),
        "PSNR (dB)": psnr(one, other, chosen) if some else None,
        "SSIM": ssim(one, other, chosen) if some else None,
    }  # fmt: skip


def masks(folder: Path, seen: list[Seen]) -> dict[str, int]:
    """Pixels before fronts: hidden ones found, and others that are held for hidden."""
    truth = np.load(folder / "truth.npz")
    told = dict.fromkeys(("before", "before found", "behind", "behind hidden"), 0)
    for one in seen:
        shape = one.sky.shape
        count = shape[0] * shape[1]
        before, front = (
            np.unpackbits(truth[f"{kind}-{one.shot.name}"], count=count).reshape(shape) > 0
            for kind in ("before", "front")
        )
        hidden = np.isfinite(one.hidden_m) | one.leaves
        told["before"] += int((before & front).sum())
        told["before found"] += int((before & front & hidden).sum())
        told["behind"] += int((front & ~before).sum())
        told["behind hidden"] += int((front & ~before & hidden).sum())
    return told


def one_seed(folder: Path, seed: int) -> dict[str, Any]:
    """All figures of a drive."""
    if not (folder / "truth.npz").is_file():
        shoot(folder, seed)
    fronts = Fronts(build_street(STREET, seed), seed)
    return measured(folder, lambda one: truth_of(one, fronts, DriveOptions().texture.texel_m))


def measured(folder: Path, truth: Callable[[Textured], Truth]) -> dict[str, Any]:
    """All figures of the drive in a folder, which has the truth of its images, too."""
    found: dict[str, Any] = {"rows": [], "masks": {}}
    for number, (_, textured, seen) in enumerate(made(folder)):
        picture = folder / f"textures-{number}.png"
        texel_m = DriveOptions().texture.texel_m
        found["rows"] += textures(textured, truth(textured), texel_m, picture)
        found["masks"] = masks(folder, seen)
    return found


def kept_rows(
    folder: Path, seeds: range, one: Callable[[Path, int], dict[str, Any]]
) -> list[dict[str, Any]]:
    """What `one` makes of each seed, kept in the folder."""
    told: list[dict[str, Any]] = []
    for seed in seeds:
        kept = folder / f"{seed}.json"
        if not kept.is_file():
            kept.parent.mkdir(parents=True, exist_ok=True)
            kept.write_text(json.dumps(one(folder / str(seed), seed)))
        told.append(json.loads(kept.read_text()))
    return told


def masks_note(told: list[dict[str, Any]]) -> str:
    """How much of what hides the fronts is found in the images."""
    counts = {name: sum(one["masks"][name] for one in told) for name in told[0]["masks"]}
    found = counts["before found"] / counts["before"]
    wrong = counts["behind hidden"] / counts["behind"]
    return (
        f"In the images {100 * found:.1f} % of what stands before the fronts is found, and"
        f" {100 * wrong:.1f} % of the rest of the fronts is held for it, pixel by pixel."
    )


def keep_streets(
    benchmark: str,
    one: Callable[[Path, int], dict[str, Any]],
    notes: Callable[[int, int], list[str]],
) -> None:
    """Measure the streets that the call names, print and keep. notes: of so many seeds, and the
    first of them.
    """
    folder = Path(sys.argv[1])
    seeds = int(sys.argv[2]) if len(sys.argv) > 2 else 6
    first = int(sys.argv[3]) if len(sys.argv) > 3 else FIRST_UNSEEN
    told = kept_rows(folder, range(first, first + seeds), one)
    rows = summed([row for street in told for row in street["rows"]])
    all_notes = [*notes(seeds, first), HOLES_NOTE, masks_note(told)]
    keep_or_print(benchmark, rows, all_notes, first >= FIRST_UNSEEN)


def _notes(seeds: int, first: int) -> list[str]:
    return [
        f"{seeds} streets of {STREET.length_m:.0f} m, seeds from {first} on, trees right before"
        f" walls; images of 1024 x 768 px every {CAMERA.spacing_m} m, times off by"
        f" {1000 * CAMERA.jitter_s:.0f} ms (standard deviation)."
    ]


def main() -> None:
    """Measure, print and keep."""
    keep_streets("drive-synthetic-texture", one_seed, _notes)


def summed(rows: list[Row]) -> list[Row]:
    """One row of each kind of holes and method over all streets."""
    result: list[Row] = []
    for kind in dict.fromkeys((row["holes"], row["method"]) for row in rows):
        own = [row for row in rows if (row["holes"], row["method"]) == kind]
        texels = np.array([float(row["texels"] or 0) for row in own])
        summed: Row = {"holes": kind[0], "method": kind[1], "texels": int(texels.sum())}
        for name in ("PSNR (dB)", "SSIM"):
            values = np.array([float(row[name] or 0.0) for row in own])
            summed[name] = float((texels * values).sum() / max(texels.sum(), 1.0))
        if "windows hidden" in own[0]:
            for name in ("windows hidden", "found again"):
                summed[name] = int(sum(int(row[name] or 0) for row in own))
            summed["processor (s)"] = float(sum(float(row["seconds"] or 0) for row in own))
        result.append(summed)
    return result


if __name__ == "__main__":
    main()
