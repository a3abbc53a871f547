"""Makes the pictures of the README from the synthetic demo: `make pictures`.

No photo of anybody goes into them: the street is designed and rendered by `veduta.synthetic`.
"""

from __future__ import annotations

import argparse
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from PIL import Image

ROOT = Path(__file__).resolve().parents[1]
IMAGES = ROOT / "docs" / "images"
VEDUTA = Path(sys.executable).parent / "veduta"
HEIGHT_PX = 620
GAP_PX = 12
MAX_BYTES = 400_000


def main() -> None:
    """Run the demo, look at it in Chromium, and keep what was seen."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--work", type=Path, default=ROOT / "out" / "pictures")
    parser.add_argument("demo", nargs="*", help="further options of `veduta demo`, after --")
    arguments = parser.parse_args()
    work: Path = arguments.work
    shutil.rmtree(work, ignore_errors=True)
    subprocess.run([VEDUTA, "demo", "-o", work, *arguments.demo], check=True)
    shots = work / "shots"
    shots.mkdir()
    _photograph(work / "place", shots)
    IMAGES.mkdir(exist_ok=True)
    street = work / "place" / "street"
    _save(
        _beside(work / "truth" / "street.jpg", street / "overlay.png", shots / "bare.png"),
        "photo-to-building.jpg",
    )
    for name in ("picked", "walking"):
        with Image.open(shots / f"{name}.png") as image:
            _save(image.convert("RGB"), f"{name}.jpg")


def _photograph(place: Path, shots: Path) -> None:
    """Serve the place and take the studio's pictures of it."""
    chromium = os.environ.get("CHROMIUM") or shutil.which("chromium") or "/usr/bin/chromium"
    command = [str(VEDUTA), "view", str(place), "--no-browser"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server:
        try:
            line = server.stdout.readline() if server.stdout else ""
            address = re.search(r"http://\S+", line)
            if address is None:
                raise SystemExit(f"veduta view did not say where it serves: {line!r}")
            script = ROOT / "docs" / "screenshots.mjs"
            subprocess.run(["node", script, address[0], chromium, shots], check=True)
        finally:
            server.terminate()


def _beside(*paths: Path) -> Image.Image:
    """Return the pictures side by side on white, each HEIGHT_PX high."""
    scaled = []
    for path in paths:
        with Image.open(path) as file:
            width = round(file.width * HEIGHT_PX / file.height)
            scaled.append(file.convert("RGB").resize((width, HEIGHT_PX), Image.Resampling.LANCZOS))
    total = sum(image.width for image in scaled) + GAP_PX * (len(scaled) - 1)
    strip = Image.new("RGB", (total, HEIGHT_PX), "white")
    x = 0
    for image in scaled:
        strip.paste(image, (x, 0))
        x += image.width + GAP_PX
    return strip


def _save(image: Image.Image, name: str) -> None:
    """Write a JPEG, at the best quality that keeps it small."""
    path = IMAGES / name
    for quality in (90, 85, 80, 70, 60):
        image.save(path, quality=quality, optimize=True, progressive=True)
        if path.stat().st_size < MAX_BYTES:
            break
    print(f"{path.relative_to(ROOT)}: {image.width} x {image.height}, {path.stat().st_size} bytes")


if __name__ == "__main__":
    main()
