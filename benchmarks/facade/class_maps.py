"""What the eyes say of each pixel where a laser's labels tell what is there, and of hard pictures.

    python benchmarks facade/class_maps [--pictures FOLDER] [--draft]

The labelled points of `laser/kitti00` are carried into the left colour picture; of several points
in one cell the nearest counts. Judged is the class map that `look` gives of the whole picture: of
the points of a group, the share that the map gives the group (recall); of those that the map gives
it, the share that are of it (precision). The pictures of `cases/facade` have no labels: told is
which classes the map has in them. FOLDER gets the maps as pictures. The pictures are a street seen
along it, not a front seen from straight ahead, which is what the eyes were trained on.
"""

from __future__ import annotations

import argparse
import os
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray
from record import Row, keep_or_print

from veduta.facade.eyes import Seen, look
from veduta.facade.seen_front import BEFORE, FRONT
from veduta.imaging.read import read_image

HERE = Path(__file__).parent

DATA = Path(os.environ.get("VEDUTA_DATA", HERE.parents[2] / "shared" / "data"))
SET = DATA / "laser/kitti00"
# Groups of the eyes' classes, and the labels of SemanticKITTI that are the same things.
GROUPS: dict[str, tuple[tuple[str, ...], tuple[int, ...]]] = {
    "front": ((*FRONT, "roof"), (50, 52)),
    "plants": (("tree", "hedge"), (70, 71)),
    "vehicle": (("vehicle",), (10, 13, 15, 18, 20, 252, 256, 257, 258, 259)),
    "person": (("person",), (30, 31, 32, 253, 254, 255)),
    "fence": (("fence",), (51,)),
    "ground": (("ground",), (40, 44, 48, 49, 60, 72)),
}
CELL_PX = 3
SHOWN = 0.03
LEAST_POINTS = 50


def main() -> None:
    """Look, judge, record."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--pictures", type=Path, help="a folder for the maps")
    parser.add_argument("--draft", action="store_true", help="keep nothing")
    call = parser.parse_args()
    table = np.zeros((len(GROUPS), len(GROUPS) + 1), np.int64)
    for path in sorted((SET / "image_2").glob("*.png")):
        pixels = read_image(path).pixels
        seen = look(pixels)
        told = grouped(seen)
        column, row, group = labelled(path.stem, (pixels.shape[1], pixels.shape[0]))
        np.add.at(table, (group, told[row, column]), 1)
        _draw(call.pictures, path.stem, pixels, seen)
    rows = [_judged(name, place, table) for place, name in enumerate(GROUPS)]
    shares = table[:, :-1].trace() / max(1, int(table.sum()))
    notes = [f"All points: {100 * shares:.0f} % have their group.", *cases(call.pictures)]
    keep_or_print("facade-class-maps", [one for one in rows if one], notes, not call.draft)


def grouped(seen: Seen) -> NDArray[np.int64]:
    """(h, w) of the picture: the likeliest group of each pixel; the last is none of them."""
    size = seen.width_px, seen.height_px
    chances = np.stack([seen.chance_at(size, *names) for names, _ in GROUPS.values()])
    every = np.concatenate([chances, 1.0 - chances.sum(axis=0)[None]])
    return np.asarray(every.argmax(axis=0), np.int64)


def labelled(
    frame: str, size: tuple[int, int]
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """Columns, rows and groups of the points that the picture shows."""
    points = np.fromfile(SET / f"velodyne/{frame}.bin", np.float32).reshape(-1, 4)[:, :3]
    labels = np.fromfile(SET / f"labels/{frame}.label", np.uint32) & 0xFFFF
    lines = (SET / "calib.txt").read_text("utf-8").splitlines()
    known = {key: np.array(rest.split(), np.float64) for key, rest in (x.split(":") for x in lines)}
    camera, placed = known["P2"].reshape(3, 4), known["Tr"].reshape(3, 4)
    inside = points @ placed[:, :3].T + placed[:, 3]
    x, y, depth = (inside @ camera[:, :3].T + camera[:, 3]).T
    front = depth > 1.0
    column = np.floor(x[front] / depth[front]).astype(np.int64)
    row = np.floor(y[front] / depth[front]).astype(np.int64)
    label, depth = labels[front], depth[front]
    kept = (column >= 0) & (column < size[0]) & (row >= 0) & (row < size[1])
    column, row, label, depth = column[kept], row[kept], label[kept], depth[kept]
    order = np.argsort(depth, kind="stable")
    cell = (row // CELL_PX) * size[0] + column // CELL_PX
    _, first = np.unique(cell[order], return_index=True)
    nearest = order[first]
    groups = np.full(1 << 16, -1, np.int64)
    for place, (_, numbers) in enumerate(GROUPS.values()):
        groups[list(numbers)] = place
    group = groups[label[nearest]]
    told = group >= 0
    return column[nearest][told], row[nearest][told], group[told]


def _judged(name: str, place: int, table: NDArray[np.int64]) -> Row:
    points = int(table[place].sum())
    if points < LEAST_POINTS:
        return {}
    given = int(table[:, place].sum())
    taken = int(np.delete(table[place], place).argmax())
    others = [*(n for n in GROUPS if n != name), "none of these"]
    return {
        "group": name,
        "points": points,
        "recall": float(table[place, place] / points),
        "precision": float(table[place, place] / given) if given else None,
        "most taken for": others[taken],
    }


def cases(pictures: Path | None) -> list[str]:
    """What the map has in each of the pictures that people had trouble with."""
    told = []
    folder = DATA / "cases/facade"
    for path in sorted([*folder.glob("*.jpg"), *folder.glob("*.png")]):
        pixels = read_image(path).pixels
        seen = look(pixels)
        most = np.array(seen.names)[seen.classes.argmax(axis=0)]
        names, counts = np.unique(most, return_counts=True)
        order = np.argsort(-counts)
        shares = [(str(names[k]), counts[k] / most.size) for k in order.tolist()]
        said = ", ".join(f"{name} {100 * share:.0f} %" for name, share in shares if share > SHOWN)
        hides = sum(share for name, share in shares if name in BEFORE)
        told.append(f"{path.name}: {said}; before the front {100 * hides:.0f} %.")
        _draw(pictures, path.stem, pixels, seen)
    return told


def _draw(folder: Path | None, name: str, pixels: NDArray[np.uint8], seen: Seen) -> None:
    """The picture, and the class of each pixel over it."""
    if folder is None:
        return
    folder.mkdir(parents=True, exist_ok=True)
    hues = np.arange(len(seen.names)) * 179 // len(seen.names)
    colours = np.stack([hues, np.full_like(hues, 200), np.full_like(hues, 230)], axis=1)
    rgb = cv2.cvtColor(colours[None].astype(np.uint8), cv2.COLOR_HSV2RGB)[0]
    size = seen.width_px, seen.height_px
    place = seen.classes.argmax(axis=0).astype(np.uint8)
    drawn = rgb[cv2.resize(place, size, interpolation=cv2.INTER_NEAREST)]
    mixed = np.rint(0.45 * pixels + 0.55 * drawn).astype(np.uint8)
    cv2.imwrite(str(folder / f"{name}.png"), np.vstack([pixels, mixed])[..., ::-1])


if __name__ == "__main__":
    main()
