"""`veduta dense --method linking` beside tables 3.1 and 3.2 of Moslah's thesis.

python benchmarks dense/linking [--cameras DIR] [--no-keep]: table 3.1 is the matching of one
rectified pair at given sizes and ranges of disparities, of pictures of noise: the time does not
depend on what they show. Table 3.2 is a set of photos after `veduta photos`: Merton College I,
three photos at 640 x 480, with the range of disparities that its sparse points ask for. Where there
is a graphics card its times stand beside.
"""

from __future__ import annotations

import argparse
import json
import os
import tempfile
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np
from record import Row, keep_or_print

from veduta.dense.command import run_dense
from veduta.dense.options import DenseOptions, DepthOptions, SurfaceOptions, ViewOptions
from veduta.dense.read.linking import LinkParameters, disparities_of
from veduta.photos.options import PhotosOptions
from veduta.photos.pipeline import run_photos
from veduta.run.card import Engine, choose_engine
from veduta.run.progress import Progress

THESIS_PAIRS = {
    (640, 480, 16): (0.407, 0.026),
    (640, 480, 32): (0.783, 0.054),
    (640, 480, 48): (1.158, 0.081),
    (320, 240, 16): (0.105, 0.007),
    (320, 240, 32): (0.196, 0.014),
    (320, 240, 48): (0.290, 0.020),
}
"""Width, height, disparities: seconds of VA + DP on its GPU and CPU, and of WTA on its GPU."""
THESIS_MERTON = (339, 418.214, 2.942, 0.969)
"""Merton College I: disparities, seconds of DSM, MVCL, and 3DMG & TM."""
TIMES = 5


def data() -> Path:
    """The folder of the real data."""
    given = os.environ.get("VEDUTA_DATA")
    return Path(given) if given else Path(__file__).resolve().parents[3] / "shared" / "data"


def timed(function: Callable[[], object]) -> tuple[float, float]:
    """The median of wall and processor seconds, after one to warm up."""
    function()
    rows = []
    for _ in range(TIMES):
        wall, cores = time.perf_counter(), time.process_time()
        function()
        rows.append((time.perf_counter() - wall, time.process_time() - cores))
    middle = np.median(np.array(rows), axis=0)
    return float(middle[0]), float(middle[1])


def pair_row(size: tuple[int, int, int], engines: list[Engine]) -> Row:
    """Table 3.1: one pair at a size, one way."""
    width, height, count = size
    draw = np.random.default_rng(0)
    here = draw.integers(0, 255, (height, width, 3), dtype=np.uint8)
    sides = [(one, np.ones((height, width), dtype=bool)) for one in (here, np.roll(here, 5, 1))]
    row: dict[str, str | int | float | bool | None] = {
        "pair": f"{width} x {height}",
        "disparities": count,
    }
    rule = LinkParameters()
    for engine in engines:
        name = "cores" if engine.card is None else "card"
        for kind, path in (("DP", True), ("WTA", False)):
            found = timed(
                partial(disparities_of, sides[0], sides[1], (0, count), rule, engine, path=path)
            )
            row[f"{kind}, {name}, s"] = round(found[0], 4)
            if engine.card is None:
                row[f"{kind}, processor s"] = round(found[1], 4)
    row["thesis DP, s"], row["thesis WTA, s"] = THESIS_PAIRS[size]
    return row


def merton_row(cameras: Path, folder: Path, device: str) -> Row:
    """Table 3.2: from the cameras to the place."""
    options = DenseOptions(
        views=ViewOptions(max_side_px=640),
        depth=DepthOptions(method="linking"),
        surface=SurfaceOptions(no_texture=True),
    )
    options = options.model_copy(
        update={"device": options.device.model_copy(update={"device": device})}
    )
    out = folder / f"merton-{device}"
    result = run_dense(cameras, out, options, Progress(quiet=True))
    steps = {
        one["name"]: float(one["seconds"])
        for one in json.loads((out / "report.json").read_text())["steps"]
    }
    stereo, links = steps["pairs"], steps["links"]
    rest = sum(steps.get(one, 0.0) for one in ("cloud", "surface", "simplification", "colours"))
    return {
        "set": "Merton College I",
        "computed by": device,
        "disparities": str(result.measures["disparities_px"]),
        "matching, s": round(stereo, 3),
        "links, s": round(links, 3),
        "cloud and mesh, s": round(rest, 3),
        "known": str(result.measures["known_share"]),
        "thesis DSM, s": THESIS_MERTON[1],
        "thesis MVCL, s": THESIS_MERTON[2],
        "thesis 3DMG & TM, s": THESIS_MERTON[3],
    }


def main() -> None:
    """Measure, print, keep."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--data", type=Path, default=None)
    parser.add_argument(
        "--cameras", type=Path, help="what `veduta photos` made of Merton College I"
    )
    parser.add_argument("--no-keep", action="store_true")
    given = parser.parse_args()
    engines = [choose_engine("cpu")]
    card = choose_engine("auto")
    if card.card is not None:
        engines.append(card)
    rows = [pair_row(size, engines) for size in [*THESIS_PAIRS]]
    photos = (given.data or data()) / "photos" / "merton" / "I"
    if photos.is_dir() or given.cameras is not None:
        with tempfile.TemporaryDirectory() as scratch:
            folder = Path(scratch)
            cameras = given.cameras
            if cameras is None:
                cameras = folder / "cameras"
                run_photos(photos, cameras, PhotosOptions(), Progress(quiet=True))
            devices = ["cpu"] if card.card is None else ["cpu", "gpu"]
            rows += [merton_row(cameras, folder, one) for one in devices]
    notes = [
        "Thesis: NVIDIA GeForce 8800 GTS, 3.0 GHz processor (2009).",
        f"Load when it began: {os.getloadavg()[0]:.1f}, on {os.cpu_count()} cores.",
        f"Graphics card: {card.told}.",
        "A row of table 3.1 is one pair, one way. Merton: two pairs, both ways, each confirmed.",
    ]
    keep_or_print("dense-linking", rows, notes, not given.no_keep)


if __name__ == "__main__":
    main()
