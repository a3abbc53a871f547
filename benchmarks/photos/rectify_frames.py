"""How true the frames of CMP are, which benchmarks/photos/rectify.py takes for the truth.

    python benchmarks photos/rectify_frames [--pictures N]

Somebody rectified these pictures by hand, and then drew a box round each window. Where the boxes of
one floor do not end on one level, or those of one column lean, the frame is off, whatever our lines
say. Reads `facades/cmp` of $VEDUTA_DATA (else ../shared/data); a run over another number of
pictures than rectify.py's is printed and not kept.
"""

from __future__ import annotations

import argparse

import numpy as np
from facade_truth import cmp_picture_labels, components
from numpy.typing import NDArray
from record import Row, keep_or_print
from rectify import DATA, compared, drawn_pictures, own_rectification

from veduta.facade.document import CLASSES
from veduta.geometry import homography, polygon
from veduta.geometry.homography import Matrix
from veduta.imaging.read import read_image

PICTURES = 60
_WINDOW_PX = 200
_FEWEST_PAIRS = 6
# Parts of the width: how far ends of one floor differ where nobody erred; what slopes and their
# change over the picture are likely (weak: a few windows say little).
_SCATTER = 0.003
_LIKELY = (0.02, 0.06)
_MAX_ROUNDS = 30

Boxes = NDArray[np.float64]


def frame_by_windows(windows: Boxes, size: tuple[int, int]) -> Matrix | None:
    """level_from_picture: takes (n, 4) boxes to where floors are level and columns upright.

    With y' = (y + a x) / (1 + p x + r y) and x' = (x + b y) / (1 + p x + r y), lines y' = const
    have the slope p y - a and lines x' = const the slope r x - b against the other axis. `a`, `p`,
    `b` and `r` are fitted to all pairs of windows of one floor and of one column, in widths of the
    picture, by iterated least squares with Geman and McClure's weights. None for too few pairs.
    """
    unit = _unit(size)
    boxes = homography.apply(unit, windows.reshape(-1, 2)).reshape(-1, 4)
    rows, columns = _slopes(boxes, 1), _slopes(boxes, 0)
    if rows is None or columns is None:
        return None
    (a, p), (b, r) = (-rows[0], rows[1]), (-columns[0], columns[1])
    return np.array([[1.0, b, 0.0], [a, 1.0, 0.0], [p, r, 1.0]]) @ unit


def _unit(size: tuple[int, int]) -> Matrix:
    """Pixels to widths of the picture from its middle."""
    width, height = size
    return homography.scaling(1 / width, 1 / width) @ homography.translation(
        -width / 2, -height / 2
    )


def _slopes(boxes: Boxes, axis: int) -> NDArray[np.float64] | None:
    """Slope at 0 and its change, of what is level (`axis` 1) or upright (0)."""
    low, high = boxes[:, axis], boxes[:, 2 + axis]
    across = (boxes[:, 1 - axis] + boxes[:, 3 - axis]) / 2
    i, j = np.triu_indices(len(boxes), 1)
    size = np.minimum((high - low)[i], (high - low)[j])
    apart = np.abs(across[j] - across[i])
    broad = (boxes[:, 3 - axis] - boxes[:, 1 - axis]).max(initial=0.0) / 2
    alike = (np.abs((high - low)[i] - (high - low)[j]) < 0.2 * size) & (apart > broad)
    design, steps = [], []
    for ends in (low, high):
        step = ends[j] - ends[i]
        one = alike & (np.abs(step) < np.minimum(0.35 * size, 0.05 * apart + 0.004))
        reach, middle = (across[j] - across[i])[one], (ends[i] + ends[j])[one] / 2
        design.append(np.stack([reach, reach * middle], axis=1))
        steps.append(step[one])
    return _robust(np.vstack(design), np.concatenate(steps), len(boxes))


def _robust(
    design: NDArray[np.float64], steps: NDArray[np.float64], boxes: int
) -> NDArray[np.float64] | None:
    if len(steps) < _FEWEST_PAIRS:
        return None
    # Pairs are many times as many as windows: together they weigh as the windows do.
    share = 1.0 / boxes
    found: NDArray[np.float64] = np.zeros(2)
    likely = np.diag((_SCATTER / np.array(_LIKELY)) ** 2) / 2
    for _ in range(_MAX_ROUNDS):
        weight = share / (1 + ((steps - design @ found) / _SCATTER) ** 2) ** 2
        normal = design.T @ (weight[:, None] * design) + likely
        found = np.asarray(np.linalg.solve(normal, design.T @ (weight * steps)), np.float64)
    return found


def terms(found: Matrix, size: tuple[int, int]) -> NDArray[np.float64]:
    """(4,) a, b, p, r of `frame_by_windows` of any homography that hardly turns the picture."""
    unit = _unit(size)
    matrix = found @ np.linalg.inv(unit)
    matrix = matrix / matrix[2, 2]
    matrix = homography.translation(-matrix[0, 2], -matrix[1, 2]) @ matrix
    matrix = np.diag([1 / matrix[0, 0], 1 / matrix[1, 1], 1.0]) @ matrix
    return np.array([matrix[1, 0], matrix[0, 1], matrix[2, 0], matrix[2, 1]])


def main() -> None:
    """Compare the frame, the windows and what our lines say, over rectify.py's pictures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--pictures", type=int, default=PICTURES)
    count = parser.parse_args().pictures
    rows: list[Row] = []
    both: list[NDArray[np.float64]] = []
    paths = drawn_pictures(sorted((DATA / "facades/cmp").glob("**/*.jpg")), count)[0]
    for path in paths:
        picture = read_image(path)
        height, width = picture.pixels.shape[:2]
        size = (width, height)
        windows = components(cmp_picture_labels(path), CLASSES.index("window"), _WINDOW_PX)
        level = frame_by_windows(windows, size)
        if level is None:
            continue
        found = own_rectification(picture)
        frame = polygon.rectangle(0, 0, width, height).astype(np.float64)
        by_windows, by_lines = homography.apply(level, frame), homography.apply(found, frame)
        both.append(np.stack([terms(level, size), terms(found, size)]))
        rows.append(
            {
                "picture": path.stem,
                "windows": len(windows),
                "frame off %": 100 * compared(frame, by_windows)[0],
                "lines off the frame %": 100 * compared(by_lines, frame)[0],
                "lines off the windows %": 100 * compared(by_lines, by_windows)[0],
            }
        )
    keep_or_print("rectify-frames", [*rows, *_totals(rows)], _notes(both, count), count == PICTURES)


def _totals(rows: list[Row]) -> list[Row]:
    names = [name for name in rows[0] if name.endswith("%")]
    values = {name: np.array([float(row[name] or 0.0) for row in rows]) for name in names}
    within = {name: float(np.mean(values[name] <= 1.0)) for name in names}
    median = {name: float(np.median(values[name])) for name in names}
    return [{"picture": "share within 1 %", **within}, {"picture": "median", **median}]


def _notes(both: list[NDArray[np.float64]], count: int) -> list[str]:
    windows, lines = np.array(both).transpose(1, 0, 2)
    shared = [float(np.corrcoef(windows[:, i], lines[:, i])[0, 1]) for i in range(4)]
    return [
        f"The {count} pictures of cmp that rectify.py judges, less those with too few windows.",
        "frame off: the largest distance of a corner from where it belongs, as in rectify.py, with "
        "the hand-drawn boxes of the windows as the truth (floors level, columns upright) and the "
        "picture left as it is. The boxes are drawn by hand, so their own error is in it.",
        "lines: what rectify finds in the unturned picture, against its frame and the windows.",
        "Correlation, over pictures, of what windows and lines say of the frame: turned "
        f"{shared[0]:.2f}, leaning {shared[1]:.2f}, levels that fan out {shared[2]:.2f}, uprights "
        f"that fan out {shared[3]:.2f}. The lines never see the boxes: what both say lies in the "
        "frame.",
    ]


if __name__ == "__main__":
    main()
