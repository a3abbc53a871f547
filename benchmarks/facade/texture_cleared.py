"""Fronts behind balconies, trees, hedges, vehicles, fences and people: the hidden part filled.

    python benchmarks facade/texture_cleared [--seeds 8] [--pictures DIR]

`hidden_fronts.py` makes them, each with the same front without what hides it. The facade is read
from the hidden picture, as `veduta facade` does; the true holes are given to all ways alike, and
PSNR and SSIM are those of their pixels alone. Seeds from 100; what was looked at while the step was
made is below 10. A window counts as found again where a third of it or more was hidden, and the
learned eyes see one in the filled picture at an intersection over union of 0.5.
"""

from __future__ import annotations

import argparse
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
from facade_measures import overlaps
from hidden_fronts import HiddenFront, hidden_fronts
from numpy.typing import NDArray
from record import Row, keep_or_print
from texture_measures import psnr, ssim

from veduta.facade.analyse import analyse
from veduta.facade.cleared.surface import fill_front
from veduta.facade.document import FacadeDocument, Source
from veduta.facade.eyes import believed, look, seen_elements
from veduta.facade.options import FacadeOptions, RectifyOptions
from veduta.facade.photo_masks import PixelBox
from veduta.facade.rectify import rectify
from veduta.imaging.read import read_image
from veduta.run.errors import NotFoundError

FIRST_SEED = 100
HIDDEN_SHARE = 1.0 / 3.0
SAME = 0.5
# The thesis's N and the side of its kernel, and alpha, which is not given there.
_ROWS_M, _KERNEL_M, _ALPHA = 0.05, 0.21, 0.5
Pixels = NDArray[np.uint8]
Mask = NDArray[np.bool_]


def read_front(pixels: Pixels) -> FacadeDocument | None:
    """The facade as it is read from a rectified picture; nothing where it is refused."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "front.png"
        cv2.imwrite(str(path), pixels[..., ::-1])
        rectified = rectify(read_image(path), RectifyOptions(rectified=True))
    source = Source(
        image=path.name, sha256="0" * 64, width_px=pixels.shape[1], height_px=pixels.shape[0]
    )
    try:
        return analyse(rectified, source, FacadeOptions())[0]
    except NotFoundError:
        return None


def _veduta(front: HiddenFront, document: FacadeDocument | None) -> Pixels:
    if document is None:
        return _telea(front, document)
    box = PixelBox(0, 0, front.seen.shape[1], front.seen.shape[0])
    return fill_front(document, front.seen, box, front.hole).pixels


def _telea(front: HiddenFront, _: FacadeDocument | None) -> Pixels:
    holes = front.hole.astype(np.uint8)
    return np.asarray(cv2.inpaint(front.seen, holes, 5, cv2.INPAINT_TELEA), np.uint8)


def _navier_stokes(front: HiddenFront, _: FacadeDocument | None) -> Pixels:
    holes = front.hole.astype(np.uint8)
    return np.asarray(cv2.inpaint(front.seen, holes, 5, cv2.INPAINT_NS), np.uint8)


def _copying(front: HiddenFront, document: FacadeDocument | None) -> Pixels:
    """What lies a storey above, or below where that is hidden too, and so on; else a median."""
    made, open_ = front.seen.copy(), front.hole.copy()
    height = len(open_)
    storeys = 4 if document is None else max(document.storeys, 1)
    facade = height if document is None else document.facade.height_px
    storey = max(4, round(facade / storeys))
    for step in [s * n * storey for n in range(1, storeys + 1) for s in (-1, 1)]:
        rows = np.arange(height) + step
        inside = (rows >= 0) & (rows < height)
        rows = np.clip(rows, 0, height - 1)
        usable = open_ & inside[:, None] & ~front.hole[rows]
        made[usable] = front.seen[rows][usable]
        open_ &= ~usable
    made[open_] = np.median(front.seen[~front.hole], axis=0).astype(np.uint8)
    return made


def _thesis(front: HiddenFront, _: FacadeDocument | None) -> Pixels:
    """(6.8) and (6.9), with 1 for the mask in the hole, row by row from above.

    Opening takes away what is bright; dark railings are closed instead.
    """
    rows = max(1, round(_ROWS_M * front.px_per_m))
    side = max(3, round(_KERNEL_M * front.px_per_m) | 1)
    kernel = np.ones((side, side), np.uint8)
    closed = cv2.morphologyEx(front.seen, cv2.MORPH_CLOSE, kernel).astype(np.float32)
    made = front.seen.astype(np.float32)
    for y in range(rows, len(made)):
        mixed = _ALPHA * closed[y] + (1.0 - _ALPHA) * made[y - rows]
        made[y] = np.where(front.hole[y, :, None], mixed, made[y])
    return np.clip(np.rint(made), 0, 255).astype(np.uint8)


METHODS: dict[str, Callable[[HiddenFront, FacadeDocument | None], Pixels]] = {
    "veduta": _veduta,
    "OpenCV Telea": _telea,
    "OpenCV Navier-Stokes": _navier_stokes,
    "copying a storey": _copying,
    "thesis (6.8, 6.9)": _thesis,
}


def hidden_windows(front: HiddenFront) -> NDArray[np.float64]:
    """The true windows (n, 4) of which a third or more is hidden."""
    kept = []
    for box in front.windows:
        x0, y0, x1, y1 = (max(0, round(v)) for v in box.tolist())
        part = front.hole[y0:y1, x0:x1]
        kept.append(part.size > 0 and part.mean() >= HIDDEN_SHARE)
    return front.windows[np.array(kept, dtype=np.bool_)]


def found_again(pixels: Pixels, true: NDArray[np.float64]) -> int:
    """How many of the windows (n, 4) the learned eyes see in a picture."""
    seen = look(pixels)
    windows = [e for e in believed(seen_elements(seen), seen) if e.kind == "window"]
    boxes = np.array([[e.x0, e.y0, e.x1, e.y1] for e in windows]).reshape(-1, 4)
    return int((overlaps(boxes, true).max(axis=0) >= SAME).sum()) if len(boxes) else 0


def measure(front: HiddenFront, pictures: Path | None) -> list[dict[str, float | str | bool]]:
    """Each way on one front."""
    document = read_front(front.seen)
    windows = hidden_windows(front)
    rows: list[dict[str, float | str | bool]] = []
    shown = [front.seen]
    for name, method in METHODS.items():
        start = time.process_time()
        filled = method(front, document)
        seconds = time.process_time() - start
        one, other = front.bare / 255.0, filled / 255.0
        rows.append(
            {
                "method": name,
                "kind": front.kind,
                "wide": front.is_wide,
                "read": document is not None,
                "psnr": psnr(one, other, front.hole),
                "ssim": ssim(one, other, front.hole),
                "windows": float(len(windows)),
                "found": float(found_again(filled, windows)) if len(windows) else 0.0,
                "seconds": seconds,
            }
        )
        shown.append(filled)
    if pictures is not None:
        sheet = np.hstack([*shown, front.bare])[..., ::-1]
        cv2.imwrite(str(pictures / f"{front.name}.jpg"), sheet)
    return rows


def _line(name: str, kind: str, rows: list[dict[str, float | str | bool]]) -> Row:
    found, windows = (sum(float(row[key]) for row in rows) for key in ("found", "windows"))
    return {
        "before the front": kind,
        "method": name,
        "fronts": len(rows),
        "PSNR (dB)": float(np.mean([float(row["psnr"]) for row in rows])),
        "SSIM": float(np.mean([float(row["ssim"]) for row in rows])),
        "windows found again": f"{found:.0f} of {windows:.0f}",
        "processor s": float(np.mean([float(row["seconds"]) for row in rows])),
    }


def main() -> None:
    """Measure all seeds and keep the means, of all and of each kind."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=8)
    parser.add_argument("--pictures", type=Path)
    given = parser.parse_args()
    if given.pictures:
        given.pictures.mkdir(parents=True, exist_ok=True)
    rows: list[dict[str, float | str | bool]] = []
    for seed in range(FIRST_SEED, FIRST_SEED + given.seeds):
        for front in hidden_fronts(seed):
            rows += measure(front, given.pictures)
        print(seed, flush=True)
    wide = [row for row in rows if row["wide"]]
    table = [_line(name, "all", [r for r in wide if r["method"] == name]) for name in METHODS]
    for kind in dict.fromkeys(str(row["kind"]) for row in wide):
        of_kind = [row for row in wide if row["kind"] == kind]
        table += [
            _line(name, kind, [r for r in of_kind if r["method"] == name]) for name in METHODS
        ]
    unread = sum(not row["read"] for row in wide) // len(METHODS)
    notes = [
        f"Unseen seeds {FIRST_SEED} to {FIRST_SEED + given.seeds - 1}; holes wider than a window;"
        " true holes given to all ways, PSNR and SSIM inside them alone.",
        f"{unread} fronts were not read as a facade: these are interpolated alone.",
    ]
    keep_or_print("facade-texture", table, notes, keep=given.seeds >= 4)


if __name__ == "__main__":
    main()
