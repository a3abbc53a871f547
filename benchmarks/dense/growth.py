"""How `veduta dense` grows: processor time and memory by images and by pixels.

python benchmarks dense/growth [--keep] [--method linking]: a rendered facade from 50 to 200
places, and from 50 at two sizes, with little memory and with what is usual; each run is a process
of its own, whose processor time and peak of memory (resident) are the kernel's figures. Nothing is
scored here.
"""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from record import Row, keep_or_print

from veduta.synthetic.build import build
from veduta.synthetic.camera import Camera, look_at
from veduta.synthetic.layout import STYLES
from veduta.synthetic.light import daylight
from veduta.synthetic.part import mirrors, to_part
from veduta.synthetic.photo import Lens, develop
from veduta.synthetic.render import render
from veduta.synthetic.scene import RayScene
from veduta.synthetic.styles import design

SEED, AWAY_M = 51, 7.0
MORE = ("--device", "cpu", "--no-texture", "--agree", "1", "--max-triangles", "100000", "-q")
RUNS = (
    ("linking", 50, 160, 0.5),
    ("linking", 100, 160, 0.5),
    ("linking", 200, 160, 0.5),
    ("linking", 50, 320, 0.5),
    ("linking", 200, 160, 4.0),
    ("linking", 50, 320, 4.0),
    ("patchmatch", 12, 160, 0.5),
    ("patchmatch", 24, 160, 0.5),
)
"""Method, images, their width (px), and --max-memory (GB)."""


def write_photos(folder: Path, count: int, width: int) -> None:
    """`.camera` files and photos of a facade from places in rows, each 0.35 m from the next."""
    layout = design(STYLES[SEED % len(STYLES)], SEED)
    built = build(layout, SEED, ())
    cast = RayScene([(to_part(built, "facade"), np.eye(4))], mirrors(built, "facade"))
    light, lens = daylight(SEED, True, 3.6, 0.8), Lens(0.4, 0.1, 0.01, 95)
    height = round(0.75 * width)
    across = 25
    (folder / "cameras").mkdir(parents=True)
    (folder / "images").mkdir()
    for number in range(count):
        x = 0.5 * layout.width_m + 0.35 * (number % across - 0.5 * across)
        z = 2.0 + 0.45 * (number // across)
        camera = look_at((x, -AWAY_M, z), (x, 0.0, z + 0.6), (width, height), 1.1 * width)
        photo = develop(render(cast, camera, light, 1, SEED + number), lens, SEED + number)
        _write(folder, number, camera, photo)


def _write(folder: Path, number: int, camera: Camera, photo: NDArray[np.uint8]) -> None:
    Image.fromarray(photo).save(folder / "images" / f"view{number:03d}.png")
    matrix = camera.intrinsics.copy()
    matrix[:2, 2] -= 0.5
    size = [[camera.width_px, camera.height_px]]
    turn = camera.cam_from_world[:3, :3].T
    blocks = [matrix, np.zeros((1, 3)), turn, camera.position_m[None], size]
    rows = [
        " ".join(repr(float(one)) for one in row) for each in blocks for row in np.asarray(each)
    ]
    (folder / "cameras" / f"view{number:03d}.camera").write_text("\n".join(rows))


def measured(method: str, count: int, width: int, memory: float) -> Row:
    """A run of the verb with as many images."""
    with tempfile.TemporaryDirectory() as scratch:
        folder, out = Path(scratch) / "set", Path(scratch) / "out"
        write_photos(folder, count, width)
        command = [sys.executable, "-m", "veduta.cli.main", "dense", str(folder), "-o", str(out)]
        began = time.perf_counter()
        given = ["--method", method, "--max-memory", str(memory)]
        child = os.posix_spawn(sys.executable, [*command, *given, *MORE], dict(os.environ))
        _, status, used = os.wait4(child, 0)
        seconds = time.perf_counter() - began
        kept = sum(one.stat().st_size for one in out.rglob("*") if one.is_file())
    pixels = count * width * round(0.75 * width) / 1e6
    processor = used.ru_utime + used.ru_stime
    return {
        "method": method,
        "images": count,
        "px": f"{width} x {round(0.75 * width)}",
        "--max-memory GB": memory,
        "megapixels": round(pixels, 2),
        "done": status == 0,
        "processor s": round(processor, 1),
        "processor s/MP": round(processor / pixels, 1),
        "s": round(seconds, 1),
        "peak MB": round(used.ru_maxrss / 1024),
        "on disk MB": round(kept / 1e6, 1),
    }


def main() -> None:
    """Measure, and keep the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--keep", action="store_true")
    parser.add_argument("--method", choices=("linking", "patchmatch"))
    given = parser.parse_args()
    rows = [measured(*run) for run in RUNS if given.method in (None, run[0])]
    notes = [
        "Depth maps with four neighbours, cloud and mesh; no texture. Other work ran beside.",
        f"Load at the end: {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores.",
    ]
    keep_or_print("dense-growth", rows, notes, given.keep)


if __name__ == "__main__":
    main()
