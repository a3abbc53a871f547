"""Look at a picture with the trained network; `docs/facade-eyes.md` says what it was trained on."""

from __future__ import annotations

import contextlib
import json
import threading
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING

import cv2
import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import onnxruntime

Float = NDArray[np.float32]

WEIGHTS = "eyes.onnx"
LONG_SIDE_PX = 896
"""The longer side of what the network sees: fronts were that large in training."""
_STRIDE = 32
BOX_STEP_PX = 4
_THREADS = 2
_READING = threading.Lock()


@dataclass(frozen=True)
class Seen:
    """What the network says of a picture of `width_px` by `height_px`.

    `classes` (n, h, w) are the chances of the `names` at a grid over the whole picture; `centres`
    (k, h', w') how sure the middle of an element of each of the `kinds` is there, `borders`
    (4, h', w') how far its left, upper, right and lower border are from there, in pixels of the
    size that the network saw, which has `across` and `down` pixels for one of the picture.
    """

    names: tuple[str, ...]
    kinds: tuple[str, ...]
    classes: Float
    centres: Float
    borders: Float
    across: float
    down: float
    width_px: int
    height_px: int

    def chance(self, *names: str) -> Float:
        """The chance (h, w) of any of these classes, at the size of the grid."""
        return np.asarray(self.classes[[self.names.index(n) for n in names]].sum(0), np.float32)

    def chance_at(self, size: tuple[int, int], *names: str) -> Float:
        """The same at another (width, height)."""
        whole = cv2.resize(self.chance(*names), size, interpolation=cv2.INTER_LINEAR)
        return np.asarray(whole, np.float32)


def look(pixels: NDArray[np.uint8]) -> Seen:
    """Look at (h, w, 3) uint8 sRGB pixels of a front seen about from straight ahead."""
    height, width = pixels.shape[:2]
    scale = LONG_SIDE_PX / max(height, width)
    size = tuple(max(_STRIDE, round(side * scale / _STRIDE) * _STRIDE) for side in (width, height))
    way = cv2.INTER_AREA if scale < 1.0 else cv2.INTER_CUBIC
    seen = cv2.resize(pixels, size, interpolation=way).astype(np.float32) / 255.0
    session, names, kinds = _network()
    classes, centres, borders = session.run(None, {"pixels": seen.transpose(2, 0, 1)[None]})
    return Seen(
        names=names,
        kinds=kinds,
        classes=np.asarray(classes[0], np.float32),
        centres=np.asarray(centres[0], np.float32),
        borders=np.asarray(borders[0], np.float32),
        across=size[0] / width,
        down=size[1] / height,
        width_px=width,
        height_px=height,
    )


def look_soon() -> None:
    """Begin to read the network in a thread of its own, while the caller prepares the picture."""
    threading.Thread(target=_read_ahead).start()  # no daemon: it ends well before the process does


def _read_ahead() -> None:
    with contextlib.suppress(Exception):  # whoever looks meets the same fault, and tells it
        _network()


def _network() -> tuple[onnxruntime.InferenceSession, tuple[str, ...], tuple[str, ...]]:
    """The network, and what it names; read once in a process, by whoever comes first."""
    with _READING:
        return _read_network()


@cache
def _read_network() -> tuple[onnxruntime.InferenceSession, tuple[str, ...], tuple[str, ...]]:
    import onnxruntime  # loaded where it is used: it takes longer than the rest of the package

    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = _THREADS
    weights = files("veduta.facade.eyes").joinpath(WEIGHTS).read_bytes()
    session = onnxruntime.InferenceSession(weights, options, providers=["CPUExecutionProvider"])
    told = session.get_modelmeta().custom_metadata_map
    return session, tuple(json.loads(told["classes"])), tuple(json.loads(told["kinds"]))
