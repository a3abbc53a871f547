"""How far windows lie back, from photos alone: `photos`, `dense`, `facade --depth-map`, as typed.

    python benchmarks dense/window_depths FOLDER [--seeds N ...] [--keep]

Each seed is a house of its own style, whose windows lie back by another length, photographed in a
street from ten places, 900 x 1200. It is rendered into FOLDER once; what was made there already is
not made again. The photos have the true places in their EXIF, which give the scale.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from record import Row, keep_or_print

from veduta.facade.load import load_document
from veduta.synthetic.build import build
from veduta.synthetic.camera import Camera, look_at
from veduta.synthetic.layout import STYLES, Layout
from veduta.synthetic.light import daylight
from veduta.synthetic.part import mirrors, to_part
from veduta.synthetic.scene import RayScene
from veduta.synthetic.streets.photos import Kit, photos_of
from veduta.synthetic.styles import design

Told = dict[str, str | int | float | bool | None]
CHILD = "import sys; from veduta.cli.main import main; sys.exit(main(sys.argv[1:]))"
SIZE_PX, FOCAL_PX = (900, 1200), 900.0
BACK_M = (0.15, 0.22, 0.30, 0.40)
"""How far windows lie back, by seeds in turn."""
LATITUDE_DEG, LONGITUDE_DEG, METRES_A_DEG = 48.85, 2.35, 111_200.0
LIGHT = daylight(1, sunny=False, azimuth_rad=-1.2, elevation_rad=0.9)


def house(seed: int) -> Layout:
    """The house of a seed."""
    layout = design(STYLES[seed % len(STYLES)], seed, 4, 5)
    return replace(layout, setback_m=BACK_M[(seed // len(STYLES) + seed) % len(BACK_M)])


def cameras(layout: Layout) -> list[Camera]:
    """Five places along the street, from each one photo of the lower and one of the upper half."""
    away = 0.75 * max(layout.width_m, layout.height_m)
    places = np.array([-0.08, 0.19, 0.53, 0.74, 1.05]) * layout.width_m
    return [
        look_at(
            (float(x), -away, 1.65),
            (float(0.6 * x + 0.2 * layout.width_m), 0.0, share * layout.height_m),
            SIZE_PX,
            FOCAL_PX,
        )
        for x in places
        for share in (0.3, 0.65)
    ]


def photographed(folder: Path, seed: int) -> None:
    """The photos of a house, and its truth; kept where they are there."""
    if (folder / "truth.json").exists():
        return
    layout = house(seed)
    built = build(layout, seed)
    scene = RayScene([(to_part(built, "facade"), np.eye(4))], mirrors(built, "facade"))
    (folder / "taken").mkdir(parents=True, exist_ok=True)
    taken = cameras(layout)
    shots = photos_of(scene, LIGHT, taken, Kit("pinhole"), _gps_deg(taken), seed)
    for row, (jpeg, _) in enumerate(shots):
        (folder / "taken" / f"{row:04d}.jpg").write_bytes(jpeg)
    truth = {"width_m": layout.width_m, "back_m": layout.setback_m, "windows": len(layout.openings)}
    (folder / "truth.json").write_text(json.dumps(truth))


def _gps_deg(taken: list[Camera]) -> NDArray[np.float64]:
    places = np.stack([camera.position_m for camera in taken])
    east = METRES_A_DEG * np.cos(np.deg2rad(LATITUDE_DEG))
    north, along = LATITUDE_DEG + places[:, 1] / METRES_A_DEG, LONGITUDE_DEG + places[:, 0] / east
    return np.column_stack([north, along, places[:, 2]])


def commanded(*call: str | Path) -> int:
    """A command as a user types it; its exit code."""
    print("veduta", *call, flush=True)
    return subprocess.run(
        [sys.executable, "-c", CHILD, *map(str, call), "-q"], check=False
    ).returncode


def measured(folder: Path, seed: int) -> Row:
    """One house, from its photos to the depths of its windows."""
    truth = json.loads((folder / "truth.json").read_text())
    row: Told = {"seed": seed, "style": house(seed).style, "true m": truth["back_m"]}
    if commanded("photos", folder / "taken", "-o", folder / "photos"):
        return row | {"ended": "photos"}
    if commanded("dense", folder / "photos", "-o", folder / "dense"):
        return row | {"ended": "dense"}
    walls = json.loads((folder / "photos" / "walls.json").read_text())["walls"]
    seen = [
        wall for wall in walls if (folder / "dense" / "walls" / f"{wall['id']}_depth.tif").exists()
    ]
    if not seen:
        return row | {"ended": "no wall"}
    name = max(seen, key=lambda wall: wall["width"] * wall["height"])["id"]
    call: list[str | Path] = [
        "facade",
        folder / "photos/walls" / f"{name}.png",
        "--rectified",
        "--depth-map",
    ]
    if commanded(*call, folder / "dense/walls" / f"{name}_depth.tif", "-o", folder / "facade"):
        return row | {"ended": "facade"}
    document = load_document(next((folder / "facade").rglob("facade.json")))
    deep = [
        -one.depth_m
        for one in document.elements
        if one.class_ == "window" and one.depth_m is not None and one.provenance == "measured"
    ]
    of = sum(one.class_ == "window" for one in document.elements)
    return row | _told(np.array(deep), of, truth)


def _told(deep_m: NDArray[np.float64], of: int, truth: dict[str, float]) -> Told:
    told: Told = {"windows": truth["windows"], "found": of, "measured": len(deep_m)}
    if len(deep_m):
        off = np.abs(deep_m - truth["back_m"])
        told |= {
            "median m": round(float(np.median(deep_m)), 3),
            "off cm": round(100 * float(np.median(off)), 1),
        }
    return told


def main() -> None:
    """All seeds, in a table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--seeds", type=int, nargs="+", default=[700, 701, 702, 703])
    parser.add_argument("--keep", action="store_true")
    given = parser.parse_args()
    rows = []
    for seed in given.seeds:
        photographed(given.folder / str(seed), seed)
        rows.append(measured(given.folder / str(seed), seed))
        print(rows[-1], flush=True)
    keep_or_print("dense-window-depths", rows, NOTES, given.keep)


NOTES = (
    "Default options of all three commands; ten rendered photos of 900 x 1200 px with their true"
    " places in EXIF, the largest wall found.",
    "off: the middle of what single windows are off from the truth. In the first house trims around"
    " windows stand 3 cm before the wall, and depths count from what is around a window.",
)

if __name__ == "__main__":
    main()
