"""A transition as arrays, so that a killed run need not find it again."""

from __future__ import annotations

import json
from dataclasses import asdict
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.walk.build.judge import Verdict
from veduta.walk.build.mesh import MorphMesh
from veduta.walk.build.way import Way

_COLUMNS = ("points", "destinations", "uv", "uv_second", "psi", "triangles", "torn")


def arrays_of(way: Way) -> dict[str, NDArray[Any]]:
    """All of it, by name."""
    told = {
        "matches": way.matches, "residual_px": way.residual_px, "energies": way.energies,
        "why": way.why, "ratio": way.ratio,
        "moving": way.moving,
        "round": [mesh is not None and mesh.round for mesh in (way.forth, way.back)],
        "verdict": None if way.verdict is None else asdict(way.verdict),
    }  # fmt: skip
    arrays: dict[str, NDArray[Any]] = {
        "pose": way.second_from_first,
        "told": np.frombuffer(json.dumps(told).encode(), dtype=np.uint8),
    }
    pictures = {"predicted": way.predicted, "shown": way.shown, "beside": way.beside}
    arrays |= {name: picture for name, picture in pictures.items() if picture is not None}
    for name, mesh in (("forth", way.forth), ("back", way.back)):
        if mesh is not None:
            arrays |= {f"{name}_{column}": getattr(mesh, column) for column in _COLUMNS}
            if mesh.marks is not None:
                arrays[f"{name}_marks"] = mesh.marks
    return arrays


def way_of(arrays: dict[str, NDArray[Any]]) -> Way:
    """The transition again."""
    told = json.loads(arrays["told"].tobytes())
    forth, back = (
        _mesh(arrays, name, is_round) if f"{name}_points" in arrays else None
        for name, is_round in zip(("forth", "back"), told["round"], strict=True)
    )
    return Way(
        arrays["pose"], forth, back,
        None if told["verdict"] is None else Verdict(**told["verdict"]),
        arrays.get("predicted"), told["matches"], told["residual_px"],
        None if told["energies"] is None else tuple(told["energies"]), told["why"],
        None if told["ratio"] is None else tuple(told["ratio"]), tuple(told["moving"]),
        arrays.get("shown"), arrays.get("beside"),
    )  # fmt: skip


def _mesh(arrays: dict[str, NDArray[Any]], name: str, is_round: bool) -> MorphMesh:
    columns = {column: arrays[f"{name}_{column}"] for column in _COLUMNS}
    return MorphMesh(**columns, round=is_round, marks=arrays.get(f"{name}_marks"))
