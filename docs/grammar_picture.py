"""Makes the pictures of docs/grammar.md from synthetic lots: part of `make pictures`."""

from __future__ import annotations

import argparse
import shutil
import subprocess
from pathlib import Path

from pictures import HEIGHT_PX, ROOT, VEDUTA, beside, photograph, save
from PIL import Image


def main() -> None:
    """Derive the street, look at it in Chromium, and keep what was seen."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--work", type=Path, default=ROOT / "out" / "pictures-grammar")
    work: Path = parser.parse_args().work
    shutil.rmtree(work, ignore_errors=True)
    street, shots = work / "street", work / "shots"
    shots.mkdir(parents=True)
    derive = [str(VEDUTA), "grammar", "derive", "haussmann", "-o", str(street)]
    subprocess.run(derive, check=True)
    photograph(street, shots, script="grammar_picture.mjs")
    save(samples(work), "grammar-sample.jpg")
    save(beside(shots / "walk.png", shots / "orbit.png", height_px=HEIGHT_PX), "grammar.jpg")


def samples(work: Path) -> Image.Image:
    """Six derivations of the style that Veduta brings along, in both kinds of colours."""
    sheet = work / "sheet.png"
    look = ["--colours", "both", "--width", "300", "--rays", "3", "--columns", "3"]
    call = [str(VEDUTA), "grammar", "sample", "haussmann", "-n", "6", "-o", str(sheet), *look]
    subprocess.run(call, check=True)
    return Image.open(sheet)


if __name__ == "__main__":
    main()
