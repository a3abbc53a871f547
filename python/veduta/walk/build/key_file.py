"""A mosaic as arrays, so that a killed run need not merge it again."""

from __future__ import annotations

import json
from dataclasses import asdict
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.walk.build.local_model import LocalModel
from veduta.walk.build.mosaic import Mosaic
from veduta.walk.build.screen import Screen
from veduta.walk.build.turns import Turns

_FRONT = "front-"


def arrays_of_mosaic(mosaic: Mosaic, *, front: bool = True) -> dict[str, NDArray[Any]]:
    """All of it, by name. front: with the front view; where poses are known, nobody asks for it."""
    model, turns = mosaic.model, mosaic.turns
    told = {
        "front": turns.front, "matches": turns.matches, "off_rad": turns.off_rad, "gap": mosaic.gap,
    }  # fmt: skip
    arrays = _arrays_of(model) | {
        "turns": turns.front_from_view, "gains": mosaic.gains, "told": _packed(told),
    }  # fmt: skip
    if front and model.front is not None:
        arrays |= {_FRONT + name: array for name, array in _arrays_of(model.front).items()}
    return arrays


def mosaic_of(key: str, arrays: dict[str, NDArray[Any]]) -> Mosaic:
    """The mosaic again, with its front view where that was kept."""
    own = {
        name.removeprefix(_FRONT): array
        for name, array in arrays.items()
        if name.startswith(_FRONT)
    }
    told = _unpacked(arrays["told"])
    model = _model_of(key, arrays, _model_of(key, own, None) if own else None)
    turns = Turns(told["front"], arrays["turns"], told["matches"], told["off_rad"])
    return Mosaic(model, turns, arrays["gains"], told["gap"])


def _arrays_of(model: LocalModel) -> dict[str, NDArray[Any]]:
    return {
        "image": model.image, "depth": model.depth_m, "measured": model.measured,
        "sky": model.sky, "screen": _packed(asdict(model.screen)),
    }  # fmt: skip


def _model_of(key: str, arrays: dict[str, NDArray[Any]], front: LocalModel | None) -> LocalModel:
    screen = _unpacked(arrays["screen"])
    screen |= {name: tuple(screen[name]) for name in ("focal_px", "centre_px")}
    return LocalModel(
        key, Screen(**screen), arrays["image"], arrays["depth"], arrays["measured"], arrays["sky"],
        front=front,
    )  # fmt: skip


def _packed(told: dict[str, Any]) -> NDArray[np.uint8]:
    return np.frombuffer(json.dumps(told).encode(), dtype=np.uint8)


def _unpacked(array: NDArray[Any]) -> dict[str, Any]:
    told: dict[str, Any] = json.loads(array.tobytes())
    return told
