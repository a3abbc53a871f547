"""What a graphics card makes of carve's hull and colours, of linking, and of the depth search.

Two steps, for the machine with the card has only Python, numpy and the extension. gpu.py --pack
given.npz [--data FOLDER] [--photos FOUND] takes the silhouettes of the Oxford dinosaur, the photos
of Middlebury's, Merton College I (after `veduta photos`), and one photo of FOUND, a result of
`veduta photos`; there, gpu.py --measure given.npz [--core EXTENSION] writes found.json beside it;
gpu.py --record found.json keeps `benchmarks/results/gpu.md`.
"""

from __future__ import annotations

import argparse
import importlib.util
import json
import os
import platform
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

TIMES = 9
RULE = {"rows": 25, "gamma_colour": 40.0, "gamma_px": 15.0, "most": 40, "path": (600, 12_000)}
LINKS = {"deviation_px": 0.6, "most_deviations": 3.0, "most_across_px": 1.5}
SWEEPS = {
    "spread": 25.0,
    "least_views": 3,
    "most_views": 6,
    "least_cosine": 0.35,
    "rim_voxels": 1.5,
    "sweeps": 80,
}
SEARCH = (
    "near", "far", "sweeps", "views", "step_px", "gamma_grey", "gamma_px", "noise_grey",
    "consistency", "most_px", "vary_depth", "vary_normal", "seed",
)  # fmt: skip
WHOLE = {"sweeps", "views", "seed"}
AIMS = {"carve 256": 0.1, "links of Merton College I": 0.1}


def timed(function: Callable[[], Any]) -> tuple[Any, float]:
    """What it makes, and the median of its seconds after one to warm up."""
    found = function()
    seconds = []
    for _ in range(TIMES):
        began = time.perf_counter()
        function()
        seconds.append(time.perf_counter() - began)
    return found, float(np.median(seconds))


def measure(given: Path, core: Any, software: bool) -> dict[str, Any]:
    """Rows of seconds on the card and on the processor, and whether they agree."""
    data = np.load(given)
    card = core.GraphicsCard(software=software)
    rows = [
        *_carved(data, core, card),
        _swept(data, core, card),
        *_pairs(data, core, card),
        _links(data, core, card),
        *([_searched(data, core, card)] if "f0image" in data.files else []),
    ]
    machine = f"{card.name()}; {platform.processor() or platform.machine()}, {os.cpu_count()} cores"
    return {"machine": machine, "rows": rows}


def _carved(data: Any, core: Any, card: Any) -> list[dict[str, Any]]:
    distances = [np.ascontiguousarray(data[f"d{i}"]) for i in range(len(data["cams"]))]
    low, side = data["low"].tolist(), float(data["side"])
    rows = []
    for levels in (6, 7, 8, 9):
        call = (data["cams"], distances, data["corners"], low, side, levels)
        (a, on_card), (b, on_cores) = (
            timed(partial(engine.carve_hull, *call)) for engine in (card, core)
        )
        same = abs(a.inside() - b.inside())
        rows.append(_row(f"carve {2**levels}", on_card, on_cores, f"{same} voxels differ"))
    return rows


def _swept(data: Any, core: Any, card: Any) -> dict[str, Any]:
    count = len(data["scams"])
    photos = [np.ascontiguousarray(data[f"sp{number}"]) for number in range(count)]
    distances = [np.ascontiguousarray(data[f"sd{number}"]) for number in range(count)]
    solid = np.ascontiguousarray(data["ssolid"])
    call = (
        data["scams"], photos, distances, data["scorners"], solid, data["slow"].tolist(),
        float(data["sside"]), core.SweepRule(**SWEEPS),
    )  # fmt: skip
    (a, on_card), (b, on_cores) = (
        timed(partial(engine.sweep_colours, *call)) for engine in (card, core)
    )
    gone, differ = int((solid & ~b[0]).sum()), int((a[0] != b[0]).sum())
    told = f"{differ} of {gone} carved voxels differ"
    return _row("colours of Middlebury's dino at 128", on_card, on_cores, told)


def _pairs(data: Any, core: Any, card: Any) -> list[dict[str, Any]]:
    rows = []
    for number in range(2):
        parts = ("a", "b", "as", "bs")
        call = [np.ascontiguousarray(data[f"p{number}{one}"]) for one in parts]
        low, count = (int(one) for one in data[f"p{number}t"])
        (a, on_card), (b, on_cores) = (
            timed(partial(engine.match_pair, *call, core.PairRule(low=low, count=count, **RULE)))
            for engine in (card, core)
        )
        same = float(((np.isnan(a) & np.isnan(b)) | (np.abs(a - b) < 1e-3)).mean())
        height, width = a.shape
        name = f"pair {number + 1} of Merton, {width} x {height}, {count} disparities, one way"
        rows.append(_row(name, on_card, on_cores, f"{same:.4%} of the pixels the same"))
    return rows


def _links(data: Any, core: Any, card: Any) -> dict[str, Any]:
    given = []
    for view in sorted(int(one[1:]) for one in data.files if one[0] == "v" and one[1:].isdigit()):
        near, far, width, height = (float(one) for one in data[f"v{view}r"])
        chains = [
            [
                tuple(
                    np.ascontiguousarray(data[f"v{view}c{way}s{step}q{part}"]) for part in range(4)
                )
                for step in range(int(data[f"v{view}c{way}"]))
            ]
            for way in (0, 1)
        ]
        given.append((data[f"v{view}"], int(width), int(height), chains, near, far))

    def linked(engine: Any) -> list[Any]:
        return [
            engine.link_views(
                camera, width, height, chains, core.LinkRule(near=near, far=far, **LINKS)
            )
            for camera, width, height, chains, near, far in given
        ]

    (a, on_card), (b, on_cores) = (timed(partial(linked, engine)) for engine in (card, core))
    same = np.mean([float((one[2] == other[2]).mean()) for one, other in zip(a, b, strict=True)])
    told = f"{same:.4%} of the pixels with as many estimates"
    return _row("links of Merton College I", on_card, on_cores, told)


def _searched(data: Any, core: Any, card: Any) -> dict[str, Any]:
    levels: list[tuple[Any, ...]] = []
    while f"f{len(levels)}image" in data.files:
        name = f"f{len(levels)}"
        count = len(data[f"{name}cameras"])
        depths = [
            data[f"{name}d{other}"] if f"{name}d{other}" in data.files else None
            for other in range(count)
        ]
        values = zip(SEARCH, data[f"{name}rule"].tolist(), strict=True)
        rule = core.SearchRule(**{key: int(x) if key in WHOLE else x for key, x in values})
        start = data[f"{name}start"] if f"{name}start" in data.files else None
        near = [data[f"{name}n{other}"] for other in range(count)]
        levels.append(
            (data[f"{name}image"], data[f"{name}camera"], near, data[f"{name}cameras"], depths,
             start, tuple(data[f"{name}shape"].tolist()), rule)
        )  # fmt: skip

    def searched(engine: Any) -> Any:
        return [engine.match_planes(*level) for level in levels][-1]

    (a, on_card), (b, on_cores) = (timed(partial(searched, engine)) for engine in (card, core))
    same = float((np.abs(a[:, 0] / b[:, 0] - 1.0) < 0.01).mean())
    height, width = levels[-1][0].shape
    what = f"depth search with {len(levels[0][2])} neighbours, {width} x {height}"
    return _row(what, on_card, on_cores, f"{same:.2%} of the depths within 1 %")


def _row(what: str, on_card: float, on_cores: float, agreement: str) -> dict[str, Any]:
    return {
        "what": what,
        "card, s": round(on_card, 4),
        "processor, s": round(on_cores, 4),
        "aim, s": AIMS.get(what),
        "agreement": agreement,
    }


def pack(out: Path, data: Path, photos: Path | None) -> None:
    """What the machine with the card needs."""
    from gpu_inputs import carve_inputs, link_inputs, search_inputs, sweep_arrays

    arrays: dict[str, Any] = {**carve_inputs(data), **sweep_arrays(data), **link_inputs(data)}
    if photos is not None:
        arrays |= search_inputs(photos)
    np.savez_compressed(out, **arrays)


def main() -> None:
    """Pack, measure or record."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--pack", type=Path)
    parser.add_argument("--measure", type=Path)
    parser.add_argument("--record", type=Path)
    parser.add_argument("--core", type=Path, help="the extension, where Veduta is not installed")
    parser.add_argument("--photos", type=Path, help="a result of `veduta photos`, to pack")
    parser.add_argument("--software", action="store_true")
    parser.add_argument(
        "--data", type=Path, default=Path(__file__).resolve().parents[2] / "shared" / "data"
    )
    given = parser.parse_args()
    if given.pack is not None:
        pack(given.pack, given.data, given.photos)
    elif given.measure is not None:
        found = measure(given.measure, _core(given.core), given.software)
        print(json.dumps(found, indent=1))
        given.measure.with_name("found.json").write_text(json.dumps(found, indent=1) + "\n")
    elif given.record is not None:
        from record import record

        found = json.loads(given.record.read_text())
        note = f"Measured on another machine: {found['machine']}."
        record("gpu", found["rows"], [note, *found.get("notes", [])])


def _core(path: Path | None) -> Any:
    if path is None:
        from veduta import _core as core

        return core
    spec = importlib.util.spec_from_file_location("_core", path)
    if spec is None or spec.loader is None:
        raise SystemExit(f"{path} is no extension")
    made = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(made)
    return made


if __name__ == "__main__":
    main()
