"""Learned eyes beside plain ones, on pictures that neither was made with.

    python benchmarks facade/facade_eyes [ecp] [artdeco] [cmp] [boxes] [street] [none]
                                     [--eyes learned|plain] [--images N]

ECP val and Art Deco were never trained on; of CMP the pictures b0241 to b0300, and of
`facades/street-cc0-boxes` every fifth, were held out; `facades/street-cc0` was never trained on.
The street photos are rectified first, and their boxes are compared in the photo. `none` are
pictures without a facade.
"""

from __future__ import annotations

import argparse
import os
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from facade_measures import Matches, accuracy, confusion, match
from facade_reading import OPTIONS, PLAIN, PLAIN_STREET, STREET, Reading, boxes_of, read_facades
from facade_truth import (
    IGNORED,
    SPECK_PX,
    Boxes,
    Labelled,
    artdeco,
    cmp_picture_labels,
    components,
    ecp,
    true_storeys,
)
from PIL import Image
from record import Row, keep_or_print

from veduta.facade.document import CLASSES, FacadeClass, FacadeDocument

DATA = Path(os.environ.get("VEDUTA_DATA", Path(__file__).parents[3] / "shared" / "data"))
KINDS: tuple[FacadeClass, ...] = ("window", "balcony", "door", "shop")
SETS = ("ecp", "artdeco", "cmp", "boxes", "street", "none")
CMP_HELD_FROM, EVERY_BOXES = 241, 5
"""As `training/facade/prepare.py` holds them out."""
NONE = (
    *("animals/goat", "animals/dog", "stereo/kitti03", "silhouettes/vgg-dino"),
    *("silhouettes/templeSparseRing", "stereo/motorcycle", "plans"),
)
EACH_NONE = 5
ADVERTISED = {0: "window", 5: "door"}
SHIFTED = {"boxes": (), "street": ("img_15",)}
"""Photos whose true boxes lie elsewhere than the openings, by `shifted_boxes.py`: left out."""


def main() -> None:
    """Read, compare, print and record."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("sets", nargs="*", choices=[*SETS, []], default=list(SETS))
    parser.add_argument("--eyes", choices=["learned", "plain"], nargs="*")
    parser.add_argument("--images", type=int, help="no more than N of a set; nothing is kept")
    call = parser.parse_args()
    for eyes in call.eyes or ("plain", "learned"):
        for name in call.sets or SETS:
            rows, notes = _measured(name, eyes, call.images)
            keep_or_print(f"facade-eyes-{name}-{eyes}", rows, notes, call.images is None)


def _measured(name: str, eyes: str, some: int | None) -> tuple[list[Row], list[str]]:
    started = time.perf_counter()
    if name == "none":
        rows, notes = _without_facade(eyes, some)
    elif name in ("boxes", "street"):
        rows, notes = _boxed(name, eyes, some)
    else:
        rows, notes = _labelled(name, eyes, some)
    return rows, [*notes, f"{time.perf_counter() - started:.0f} s for the set, two processes."]


def _labelled(name: str, eyes: str, some: int | None) -> tuple[list[Row], list[str]]:
    """Pixels, boxes and storeys of pictures with a label per pixel."""
    examples = _examples(name)[:some]
    options = OPTIONS if eyes == "learned" else PLAIN
    readings = read_facades([e.image for e in examples], options=options)
    pairs = list(zip(readings, examples, strict=True))
    counts = [confusion(r.labels, e.labels) for r, e in pairs]
    rows: list[Row] = [
        {"measure": "pixels, mean of pictures", "F1": float(np.mean([accuracy(c) for c in counts]))}
    ]
    for kind in KINDS:
        for least in (0.5, 0.8):
            rows.append(
                _row(f"{kind}, IoU {least}", [_matched(r, e, kind, least) for r, e in pairs])
            )
    storeys = [
        r.document is not None and r.document.storeys == true_storeys(e.labels) for r, e in pairs
    ]
    rows.append({"measure": "storeys right", "F1": float(np.mean(storeys))})
    shopless = [(r, e) for r, e in pairs if not (e.labels == CLASSES.index("shop")).any()]
    false = sum(len(_found(r, "shop")) > 0 for r, _ in shopless)
    rows.append(
        {"measure": "fronts without a shop that got one", "found": false, "true": len(shopless)}
    )
    doubted = sum(r.document is None or r.document.storeys_doubtful for r in readings)
    rows.append({"measure": "storeys doubted, or refused", "found": doubted, "true": len(readings)})
    return rows, [f"{len(examples)} pictures of {name}. Accuracy and shares stand under F1."]


def _examples(name: str) -> list[Labelled]:
    if name == "ecp":
        return ecp(DATA, "val")
    if name == "artdeco":
        return artdeco(DATA)
    paths = sorted((DATA / "facades/cmp").glob("cmp_b*.png"))
    kept = [p for p in paths if int(p.stem.removeprefix("cmp_b")) >= CMP_HELD_FROM]
    return [Labelled(p.stem, p.with_suffix(".jpg"), cmp_picture_labels(p)) for p in kept]


def _found(reading: Reading, kind: FacadeClass) -> Boxes:
    return boxes_of(reading.document, kind) if reading.document else np.zeros((0, 4))


def _matched(reading: Reading, example: Labelled, kind: FacadeClass, least: float) -> Matches:
    known = np.where(example.labels == IGNORED, len(CLASSES), example.labels)
    return match(_found(reading, kind), components(known, CLASSES.index(kind), SPECK_PX), least)


def _row(measure: str, several: Sequence[Matches]) -> Row:
    total = Matches(0, 0, 0)
    for each in several:
        total += each
    return {
        "measure": measure,
        "F1": total.f1,
        "precision": total.precision,
        "recall": total.recall,
        "true": total.true,
        "found": total.found,
    }


@dataclass(frozen=True)
class Boxed:
    """A street photo and its true boxes, by class, in its pixels."""

    image: Path
    boxes: dict[str, Boxes]


def _boxed(name: str, eyes: str, some: int | None) -> tuple[list[Row], list[str]]:
    """Boxes in photos of streets."""
    examples = _photos(name)[:some]
    options = STREET if eyes == "learned" else PLAIN_STREET
    readings = read_facades([e.image for e in examples], options=options)
    rows: list[Row] = []
    for kind in ("window", "door"):
        matches = [
            match(_in_photo(r.document, kind), e.boxes[kind])
            for r, e in zip(readings, examples, strict=True)
        ]
        rows.append(_row(f"{kind}, IoU 0.5", matches))
    refused = sum(r.document is None for r in readings)
    rows.append({"measure": "refused", "found": refused, "true": len(readings)})
    return rows, [
        f"{len(examples)} photos of {name}. Shop panes count as windows. What was found is brought "
        "back into the photo, and its upright box compared."
    ]


def _photos(name: str, shifted: bool = False) -> list[Boxed]:
    """The photos of a set that are measured; or those that are left out, too."""
    folder = DATA / "facades" / ("street-cc0-boxes" if name == "boxes" else "street-cc0")
    paths = sorted((folder / "images").glob("*.jpg"), key=lambda p: int(p.stem.split("_")[1]))
    if name == "boxes":
        paths = [p for i, p in enumerate(paths) if i % EVERY_BOXES == 0]
    return [
        Boxed(path, _true_boxes(path, folder / "labels" / f"{path.stem}.txt"))
        for path in paths
        if shifted or path.stem not in SHIFTED[name]
    ]


def _true_boxes(path: Path, labels: Path) -> dict[str, Boxes]:
    with Image.open(path) as image:
        width, height = image.size
    found: dict[str, list[list[float]]] = {kind: [] for kind in ADVERTISED.values()}
    for line in labels.read_text().splitlines():
        code, x, y, w, h = (float(v) for v in line.split())
        if int(code) in ADVERTISED:
            box = [x - w / 2, y - h / 2, x + w / 2, y + h / 2]
            found[ADVERTISED[int(code)]].append(box)
    size = np.array([width, height, width, height])
    return {kind: np.array(boxes).reshape(-1, 4) * size for kind, boxes in found.items()}


def _in_photo(document: FacadeDocument | None, kind: FacadeClass) -> Boxes:
    """Boxes of the elements in the photo that was read: the middles of their sides."""
    if document is None:
        return np.zeros((0, 4))
    boxes = boxes_of(document, kind)
    corners = boxes[:, [[0, 1], [2, 1], [2, 3], [0, 3]]]
    photo_from_rectified = np.linalg.inv(np.array(document.rectification.rectified_from_source))
    moved = np.dstack([corners, np.ones((*corners.shape[:2], 1))]) @ photo_from_rectified.T
    points = moved[..., :2] / moved[..., 2:]
    x, y = np.sort(points[..., 0], axis=1), np.sort(points[..., 1], axis=1)
    sides = [x[:, :2].mean(1), y[:, :2].mean(1), x[:, 2:].mean(1), y[:, 2:].mean(1)]
    return np.stack(sides, axis=1).reshape(-1, 4)


def _without_facade(eyes: str, some: int | None) -> tuple[list[Row], list[str]]:
    """How many pictures of other things are refused, or fall back to a plane."""
    options = STREET if eyes == "learned" else PLAIN_STREET
    rows: list[Row] = []
    for place in NONE:
        files = sorted(
            f
            for f in (DATA / place).rglob("*")
            if f.suffix.lower() in (".jpg", ".png", ".ppm", ".jpeg")
        )
        files = [f for f in files if "mask" not in str(f).lower() and "disp" not in f.stem.lower()]
        step = max(1, len(files) // EACH_NONE)
        chosen = files[::step][:EACH_NONE][:some]
        readings = read_facades(chosen, options=options)
        refused = sum(r.document is None for r in readings)
        fell = sum(r.document is not None and r.document.storeys == 1 for r in readings)
        doubted = sum(r.document is not None and r.document.storeys_doubtful for r in readings)
        rows.append(
            {
                "measure": place,
                "refused": refused,
                "fallen back": fell,
                "doubted": doubted,
                "true": len(chosen),
            }
        )
    return rows, ["Fallen back: a plane with openings instead of storeys."]


if __name__ == "__main__":
    main()
