"""Makes the picture of docs/photos.md from a rendered street: part of `make pictures`."""

from __future__ import annotations

import argparse
import shutil
import subprocess
import sys
from pathlib import Path

from pictures import HEIGHT_PX, ROOT, VEDUTA, beside, photograph, save

SEED = "7"


def main() -> None:
    """Render photos of a street, lay them into its coarse model, keep what the studio shows."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--work", type=Path, default=ROOT / "out" / "pictures-photos")
    parser.add_argument("--street", type=Path, help="what street_sets.py rendered before")
    arguments = parser.parse_args()
    work: Path = arguments.work
    shutil.rmtree(work, ignore_errors=True)
    out, shots = work / "out", work / "shots"
    shots.mkdir(parents=True)
    street: Path = arguments.street or rendered(work / "street")
    model = str(street / "model.city.json")
    command = [str(VEDUTA), "photos", str(street / "images"), "--model", model, "-o", str(out)]
    subprocess.run(command, check=True)
    photograph(out, shots, script="photos_picture.mjs")
    first = sorted((street / "images").iterdir())[0]
    pictures = beside(first, shots / "above.png", shots / "walk.png", height_px=HEIGHT_PX)
    save(pictures, "photos.jpg")


def rendered(street: Path) -> Path:
    """Photos of a street with a known coarse model."""
    script = [str(ROOT / "benchmarks"), "photos/street_sets"]
    options = ["--place", "street", "--photos", "40", "--seed", SEED]
    subprocess.run([sys.executable, *script, str(street), *options], check=True)
    return street


if __name__ == "__main__":
    main()
