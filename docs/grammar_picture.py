"""Makes the picture of docs/grammar.md from the synthetic street: part of `make pictures`."""

from __future__ import annotations

import argparse
import shutil
import subprocess
from pathlib import Path

from pictures import HEIGHT_PX, ROOT, VEDUTA, beside, photograph, save


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
    save(beside(shots / "walk.png", shots / "orbit.png", height_px=HEIGHT_PX), "grammar.jpg")


if __name__ == "__main__":
    main()
