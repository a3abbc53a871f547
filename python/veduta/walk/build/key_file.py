"""A mosaic as arrays, so that a killed run need not merge it again."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import asdict
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.walk.build.local_model import LocalModel
from veduta.walk.build.mosaic import Mosaic
from veduta.walk.build.screen import Screen
from veduta.walk.build.turns import Turns


def arrays_of_mosaic(mosaic: Mosaic) -> dict[str, NDArray[Any]]:
    """All of it but the front view, by name."""
    model, turns = mosaic.model, mosaic.turns
    told = {
        "screen": asdict(model.screen), "front": turns.front, "matches": turns.matches,
        "off_rad": turns.off_rad, "gap": mosaic.gap,
    }  # fmt: skip
    return {
        "image": model.image, "depth": model.depth_m, "measured": model.measured,
        "sky": model.sky, "turns": turns.front_from_view, "gains": mosaic.gains,
        "told": np.frombuffer(json.dumps(told).encode(), dtype=np.uint8),
    }  # fmt: skip


def mosaic_of(
    key: str, arrays: dict[str, NDArray[Any]], view: Callable[[int], LocalModel] | None
) -> Mosaic:
    """The mosaic again. view: makes the local model of a view by its number; None: where poses are
    known, nobody asks for it.
    """
    told = json.loads(arrays["told"].tobytes())
    shape = told["screen"] | {
        name: tuple(told["screen"][name]) for name in ("focal_px", "centre_px")
    }
    model = LocalModel(
        key, Screen(**shape), arrays["image"], arrays["depth"], arrays["measured"], arrays["sky"],
        front=None if view is None else view(told["front"]),
    )  # fmt: skip
    turns = Turns(told["front"], arrays["turns"], told["matches"], told["off_rad"])
    return Mosaic(model, turns, arrays["gains"], told["gap"])
