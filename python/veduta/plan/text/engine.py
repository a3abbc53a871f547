"""The optical character recognition (OCR) of others: rapidocr on onnxruntime, models in its wheel.

Only its two networks are used, each alone: one says where text is (differentiable binarisation),
one says what a line of text says (CTC). The third, which turns lines of text by 180 degrees, is
not: `reading` reads both ways round where a line may stand on its head, and keeps the better.
Nothing is downloaded: the models lie in the package, and their names are not changed here.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import lru_cache
from threading import Lock
from typing import TYPE_CHECKING, Any, TypeVar

import cv2
import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from rapidocr import RapidOCR

THREADS = 2
"""So many threads look for text in one picture, or read lines of it, one line each."""
LINE_PX = 48
"""Height of the lines of text that the network reads."""


@dataclass(frozen=True)
class Line:
    """What a line of text says. `score` is the mean probability of its characters."""

    text: str
    score: float


Item = TypeVar("Item")
Result = TypeVar("Result")


_MAKING = Lock()
"""The cache of engines does not lock: each thread would make one of its own."""


@lru_cache(maxsize=1)
def prepare() -> None:
    """Load both networks in a thread, once: a large drawing takes as long to be read.

    What fails there is not asked for: it fails again, and is told, where text is looked for.
    """
    thread = ThreadPoolExecutor(1)
    thread.submit(_load)
    thread.shutdown(wait=False)


def _load() -> None:
    blank = np.full((LINE_PX, LINE_PX, 3), 255, dtype=np.uint8)
    find_lines(blank)
    read_line(blank)


def _engine(threads: int) -> RapidOCR:
    with _MAKING:
        return _made(threads)


@lru_cache(maxsize=2)
def _made(threads: int) -> RapidOCR:
    # Half a second and 60 MB: only who reads text pays for it.
    from rapidocr import RapidOCR

    return RapidOCR(
        params={
            "Global.log_level": "error",
            # Sizes are chosen by the caller: nothing is resized a second time.
            "Global.max_side_len": 10_000,
            "Global.use_vertical_padding": False,
            "Global.text_score": 0.0,
            "Det.limit_type": "min",
            "Det.limit_side_len": 32,
            # Lower than usual (0.3, 0.5): letters between lines are found as well, and what is no
            # text is dropped when it is read.
            "Det.thresh": 0.2,
            "Det.box_thresh": 0.35,
            "EngineConfig.onnxruntime.intra_op_num_threads": threads,
            # Off by default: then all memory is given back and taken anew for each picture.
            "EngineConfig.onnxruntime.enable_cpu_mem_arena": True,
        }
    )


def find_lines(pixels: NDArray[np.uint8]) -> NDArray[np.float64]:
    """Quadrangles (n, 4, 2) around the lines of text of an image, in its pixels.

    `pixels` is (h, w, 3) sRGB. Corners go clockwise from the upper left of the quadrangle; of text
    that runs upwards this is not the upper left of its first letter.
    """
    found: Any = _engine(THREADS)(_bgr(pixels), use_det=True, use_cls=False, use_rec=False)
    if found.boxes is None or not len(found.boxes):
        return np.zeros((0, 4, 2))
    return np.asarray(found.boxes, dtype=np.float64)


def read_line(strip: NDArray[np.uint8]) -> Line:
    """What an upright line of text says. `strip` is (h, w, 3) sRGB, h some 48 px."""
    found: Any = _engine(1)(_bgr(strip), use_det=False, use_cls=False, use_rec=True)
    if not found.txts:
        return Line("", 0.0)
    return Line(str(found.txts[0]).strip(), float(found.scores[0]))


def side_by_side(read: Callable[[Item], Result], items: Iterable[Item]) -> list[Result]:
    """What `read`, which calls `read_line`, gives for each, in their order.

    A line is too little work to be shared by threads: two lines at once take half of the time.
    """
    with ThreadPoolExecutor(THREADS) as threads:
        return list(threads.map(read, items))


def _bgr(pixels: NDArray[np.uint8]) -> NDArray[np.uint8]:
    return np.ascontiguousarray(cv2.cvtColor(pixels, cv2.COLOR_RGB2BGR), dtype=np.uint8)
