"""Bring the sets of facades into one form for the training.

    python training/facade/prepare.py OUT [--renders FOLDER]

Reads `facades/cmp` and `facades/street-cc0-boxes` of $VEDUTA_DATA (else ../shared/data), and
pictures with labels that `renders.py` made. ECP and Art Deco are left alone: they are the test.
OUT gets

    NAME.jpg          the picture, its longer side at most SIDE_PX
    NAME.set.png      per pixel the place of its label in `classes.SETS`
    NAME.id.png       per pixel the number of its element, from 1, or 0 (16 bit)
    elements.json     NAME: {"set", "held", "elements": [[kind, x0, y0, x1, y1], ...]}

Held out are the pictures b0241 to b0300 of CMP and every fifth picture of the boxes.
"""

from __future__ import annotations

import argparse
import json
import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from classes import BEFORE, CLASSES, KINDS, NOT_OPENINGS, WALL, place
from marks import apply_marks
from numpy.typing import NDArray
from PIL import Image

DATA = Path(os.environ.get("VEDUTA_DATA", Path(__file__).parents[3] / "shared" / "data"))
SIDE_PX = 640
BOXES_SIDE_PX = 512
QUALITY = 80
SPECK_PX = 24
CMP_HELD_FROM = 241
EVERY_BOXES = 5
UNKNOWN = len(KINDS)
"""The kind of an element whose box is known and whose class is not."""

_CMP: dict[int, tuple[str, ...]] = {
    2: ("wall",),
    3: ("window",),
    4: ("door",),
    5: ("cornice",),
    6: ("sill",),
    7: ("balcony",),
    8: ("blind",),
    9: ("ornament",),
    10: ("ornament",),
    11: ("pillar",),
    12: ("shop",),
}
_CMP_KINDS = {3: "window", 4: "door", 7: "balcony", 12: "shop"}
_RIGHT_ABOVE = ("roof", "sky", "tree", "wire", "other")
_ABOVE = ("roof", "wall", "cornice", "sky", "tree", "wire", "other")


@dataclass
class Sample:
    """One picture: `pixels` (h, w, 3) RGB, `sets` (h, w) uint8, `ids` (h, w) uint16."""

    name: str
    source: str
    held: bool
    pixels: NDArray[np.uint8]
    sets: NDArray[np.uint8]
    ids: NDArray[np.uint16]
    elements: list[tuple[int, float, float, float, float]] = field(default_factory=list)


def main() -> None:
    """Read, label, write."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("out", type=Path)
    parser.add_argument("--renders", type=Path)
    call = parser.parse_args()
    call.out.mkdir(parents=True, exist_ok=True)
    index: dict[str, Any] = {}
    for sample in (*_cmp(), *_boxes(), *_renders(call.renders)):
        apply_marks(sample.name, sample.sets, sample.ids)
        _write(sample, call.out)
        index[sample.name] = {
            "set": sample.source,
            "held": sample.held,
            "elements": [[k, *(round(v, 1) for v in box)] for k, *box in sample.elements],
        }
    (call.out / "elements.json").write_text(json.dumps(index))
    print({s: sum(e["set"] == s for e in index.values()) for s in ("cmp", "boxes", "renders")})


def _write(sample: Sample, out: Path) -> None:
    picture = Image.fromarray(sample.pixels)
    picture.save(out / f"{sample.name}.jpg", quality=QUALITY)
    small = (
        cv2.IMWRITE_PNG_COMPRESSION,
        9,
        cv2.IMWRITE_PNG_STRATEGY,
        cv2.IMWRITE_PNG_STRATEGY_DEFAULT,
    )
    cv2.imwrite(str(out / f"{sample.name}.set.png"), sample.sets, small)
    cv2.imwrite(str(out / f"{sample.name}.id.png"), sample.ids, small)


def _small(path: Path, side_px: int = SIDE_PX) -> NDArray[np.uint8]:
    with Image.open(path) as image:
        scale = min(1.0, side_px / max(image.size))
        size = round(image.width * scale), round(image.height * scale)
        return np.asarray(image.convert("RGB").resize(size, Image.Resampling.LANCZOS))


def _cmp() -> list[Sample]:
    samples = []
    for number in range(1, 301):
        path = DATA / "facades" / "cmp" / f"cmp_b{number:04d}.jpg"
        pixels = _small(path)
        with Image.open(path.with_suffix(".png")) as image:
            codes = np.asarray(image)
        codes = cv2.resize(codes, pixels.shape[1::-1], interpolation=cv2.INTER_NEAREST)
        sample = Sample(path.stem, "cmp", number >= CMP_HELD_FROM, pixels, *_blank(pixels))
        for code, names in _CMP.items():
            sample.sets[codes == code] = place(*names)
        _background(sample, codes == 1, codes)
        for code, kind in _CMP_KINDS.items():
            _components(sample, codes == code, KINDS.index(kind))
        samples.append(sample)
    return samples


def _background(sample: Sample, background: NDArray[np.bool_], codes: NDArray[np.uint8]) -> None:
    """What CMP calls background: sky where it is bright and smooth at the top, else by where it is.

    Black and grey fill of rectified pictures says nothing.
    """
    pixels, sets = sample.pixels, sample.sets
    rows = np.flatnonzero((codes == 2).any(axis=1))
    top, foot = (rows[0], rows[-1]) if len(rows) else (0, len(codes))
    sets[background] = place(*NOT_OPENINGS)
    height = np.arange(len(codes))[:, None] * np.ones_like(codes)
    sets[background & (height < top + 0.4 * (foot - top))] = place(*_ABOVE)
    over = np.maximum.accumulate(codes != 1, axis=0)  # pixels with some of the house above them
    sets[background & ~over & (height < top + 0.4 * (foot - top))] = place(*_RIGHT_ABOVE)
    sets[background & (height > foot)] = place("ground", "wall", *BEFORE)
    beside = (codes == 2).mean(axis=0) < 0.15  # other houses, with windows that nobody marked
    sets[background & beside[None, :]] = 0
    grey = cv2.cvtColor(pixels, cv2.COLOR_RGB2GRAY).astype(np.float32)
    smooth = cv2.boxFilter(grey**2, -1, (7, 7)) - cv2.boxFilter(grey, -1, (7, 7)) ** 2 < 30
    light = (grey > 150) & (pixels[..., 2].astype(int) >= pixels[..., 0].astype(int) - 12)
    _, parts, stats, _ = cv2.connectedComponentsWithStats(
        (background & smooth & light).astype(np.uint8)
    )
    for part in range(1, len(stats)):
        if stats[part, cv2.CC_STAT_TOP] <= 3 and stats[part, cv2.CC_STAT_AREA] > 400:
            sets[parts == part] = place("sky")
    flat = cv2.boxFilter(grey**2, -1, (9, 9)) - cv2.boxFilter(grey, -1, (9, 9)) ** 2 < 2.0
    fill = flat & ((grey < 14) | (abs(grey - 128) < 4))
    sets[cv2.dilate((background & fill).astype(np.uint8), np.ones((5, 5))) > 0] = 0
    early = (codes == 2) & (height < top + 0.3 * (foot - top))
    has_cornice = (codes == 5).any()
    first = (
        np.flatnonzero((codes == 5).any(axis=1))[0] if has_cornice else top + 0.12 * (foot - top)
    )
    sets[early & (height < first)] = place(*_ABOVE)
    _greens(sample, background | (codes == 2), 24)


def _greens(sample: Sample, where: NDArray[np.bool_], least: int) -> None:
    """Leaves, where no element is and the picture is green and rough."""
    wide = sample.pixels.astype(np.int32)
    green = 2 * wide[..., 1] - wide[..., 0] - wide[..., 2]
    grey = cv2.cvtColor(sample.pixels, cv2.COLOR_RGB2GRAY).astype(np.float32)
    rough = cv2.boxFilter(grey**2, -1, (7, 7)) - cv2.boxFilter(grey, -1, (7, 7)) ** 2 > 60
    leaves = ((green > least) & rough & where).astype(np.uint8)
    leaves = cv2.morphologyEx(leaves, cv2.MORPH_OPEN, np.ones((5, 5), np.uint8))
    sample.sets[leaves > 0] = place("tree", "hedge")


def _blank(pixels: NDArray[np.uint8]) -> tuple[NDArray[np.uint8], NDArray[np.uint16]]:
    size = pixels.shape[:2]
    return np.zeros(size, np.uint8), np.zeros(size, np.uint16)


def _components(sample: Sample, mask: NDArray[np.bool_], kind: int) -> None:
    """Each connected component becomes an element with its box."""
    count, parts, stats, _ = cv2.connectedComponentsWithStats(mask.astype(np.uint8), connectivity=4)
    for part in range(1, count):
        x, y, width, height, area = (int(v) for v in stats[part])
        if area >= SPECK_PX:
            sample.elements.append((kind, x, y, x + width, y + height))
            sample.ids[parts == part] = len(sample.elements)


def _boxes() -> list[Sample]:
    folder = DATA / "facades" / "street-cc0-boxes"
    paths = sorted((folder / "images").glob("*.jpg"), key=lambda p: int(p.stem.split("_")[1]))
    return [
        _boxed(path, folder / "labels" / f"{path.stem}.txt", i % EVERY_BOXES == 0)
        for i, path in enumerate(paths)
    ]


def _boxed(path: Path, labels: Path, held: bool) -> Sample:
    """Boxes say what is in them, and that their surroundings are no opening; the rest is open."""
    pixels = _small(path, BOXES_SIDE_PX)
    height, width = pixels.shape[:2]
    sample = Sample(path.stem, "boxes", held, pixels, *_blank(pixels))
    _greens(sample, np.ones((height, width), np.bool_), 36)
    rows = [[float(v) for v in line.split()] for line in labels.read_text().splitlines() if line]
    found = [
        (
            int(c),
            (x - w / 2) * width,
            (y - h / 2) * height,
            (x + w / 2) * width,
            (y + h / 2) * height,
        )
        for c, x, y, w, h in rows
    ]
    for _, x0, y0, x1, y1 in found:
        edge = 0.12 * min(x1 - x0, y1 - y0)
        _fill(sample, (x0 - edge, y0 - edge, x1 + edge, y1 + edge), place(*NOT_OPENINGS))
    for code, x0, y0, x1, y1 in sorted(found, key=lambda f: -(f[3] - f[1]) * (f[4] - f[2])):
        _box(sample, code, (x0, y0, x1, y1))
    return sample


def _box(sample: Sample, code: int, box: tuple[float, float, float, float]) -> None:
    """One box: window, cantilever, arch, sign, advertisement in a window, door."""
    x0, y0, x1, y1 = box
    tall = (y1 - y0) > 1.1 * (x1 - x0)
    inner = (
        x0 + 0.1 * (x1 - x0),
        y0 + 0.06 * (y1 - y0),
        x1 - 0.1 * (x1 - x0),
        y1 - 0.06 * (y1 - y0),
    )
    if code == 0:
        _fill(sample, box, place("window", "shop", "blind", *WALL))
        _fill(sample, inner, place("window", "blind") if tall else place("window", "shop", "blind"))
        _element(sample, KINDS.index("window") if tall else UNKNOWN, box)
    elif code == 1:
        _fill(sample, box, place("balcony", "fence", "wall"))
    elif code == 2:
        _fill(sample, box, place("door", "window", "shop", *WALL))
    elif code == 3:
        _fill(sample, inner, place("shop", "wall", "ornament", "cornice"))
    elif code == 5:
        _fill(sample, inner, place("door"))
        _element(sample, KINDS.index("door"), box)


def _fill(sample: Sample, box: tuple[float, float, float, float], value: int) -> None:
    x0, y0, x1, y1 = (max(0, round(v)) for v in box)
    sample.sets[y0:y1, x0:x1] = value


def _element(sample: Sample, kind: int, box: tuple[float, float, float, float]) -> None:
    sample.elements.append((kind, *box))
    x0, y0, x1, y1 = (max(0, round(v)) for v in box)
    sample.ids[y0:y1, x0:x1] = len(sample.elements)


def _renders(folder: Path | None) -> list[Sample]:
    """Pictures of synthetic streets; channels of their labels: the label, the semantic code."""
    samples = []
    for path in sorted(folder.glob("*.jpg")) if folder else []:
        pixels = np.asarray(Image.open(path).convert("RGB"))
        codes = cv2.imread(str(path.with_suffix(".png")), cv2.IMREAD_UNCHANGED)
        label, semantic = codes[..., 0], codes[..., 1]
        sample = Sample(f"render_{path.stem}", "renders", False, pixels, *_blank(pixels))
        # window wall balcony door roof chimney sky shop other
        names = ("window", WALL, "balcony", "door", "roof", "roof", "sky", "shop")
        for code, name in enumerate(names):
            sets = (name,) if isinstance(name, str) else name
            sample.sets[label == code] = place(*sets)
        sample.sets[label == 8] = place("wall", "roof", "other", "window", "ground", *BEFORE)
        sample.sets[semantic == _GROUND] = place("ground")
        for kind, code in (("window", 0), ("balcony", 2), ("door", 3), ("shop", 7)):
            _components(sample, label == code, KINDS.index(kind))
        samples.append(sample)
    return samples


_GROUND = 2


if __name__ == "__main__":
    if len(CLASSES) > 255:
        raise SystemExit("too many classes for a label picture")
    main()
