"""Makes the pictures of the README and the docs from the synthetic demo: `make pictures`.

No photo of anybody goes into them: the street is designed and rendered by `veduta.synthetic`.
"""

from __future__ import annotations

import argparse
import io
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from edit_example import ground_floor, make_edit
from PIL import Image

ROOT = Path(__file__).resolve().parents[1]
IMAGES = ROOT / "docs" / "images"
VEDUTA = Path(sys.executable).parent / "veduta"
HEIGHT_PX = 620
GAP_PX = 12
EDIT_HEIGHT_PX = 320
MAX_BYTES = 300_000
LANCZOS = Image.Resampling.LANCZOS


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
    photograph(work / "place", shots)
    IMAGES.mkdir(exist_ok=True)
    street = work / "place" / "street"
    save(
        beside(work / "truth" / "street.jpg", street / "overlay.png", shots / "bare.png"),
        "photo-to-building.jpg",
    )
    for name in ("picked", "walking"):
        with Image.open(shots / f"{name}.png") as image:
            save(image.convert("RGB"), f"{name}.jpg")
    _show_edit(work, street)


def _show_edit(work: Path, street: Path) -> None:
    """The example of an edit: what was found, what it was corrected to, and the model then."""
    edited = make_edit(work, work / "edit")
    shots = work / "edit" / "shots"
    shots.mkdir()
    photograph(edited, shots)
    corrected = edited / "street"
    with Image.open(shots / "ground.png") as model:
        pictures = [
            ground_floor(street / "overlay.png", street / "facade.json"),
            ground_floor(corrected / "overlay.png", corrected / "facade.json"),
            model.convert("RGB"),
        ]
    save(_strip(pictures, EDIT_HEIGHT_PX), "edit.jpg")


def photograph(place: Path, shots: Path, script: str = "screenshots.mjs") -> None:
    """Serve the place and take the studio's pictures of it."""
    chromium = os.environ.get("CHROMIUM") or shutil.which("chromium") or "/usr/bin/chromium"
    command = [str(VEDUTA), "view", str(place), "--no-browser"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server:
        try:
            line = server.stdout.readline() if server.stdout else ""
            address = re.search(r"http://\S+", line)
            if address is None:
                raise SystemExit(f"veduta view did not say where it serves: {line!r}")
            path = ROOT / "docs" / script
            subprocess.run(["node", path, address[0], chromium, shots], check=True)
        finally:
            server.terminate()


def beside(*paths: Path, height_px: int = HEIGHT_PX) -> Image.Image:
    """Return the pictures side by side on white, all of one height."""
    pictures = []
    for path in paths:
        with Image.open(path) as file:
            pictures.append(file.convert("RGB"))
    return _strip(pictures, height_px)


def _strip(pictures: Sequence[Image.Image], height_px: int) -> Image.Image:
    scaled = [
        image.resize((round(image.width * height_px / image.height), height_px), LANCZOS)
        for image in pictures
    ]
    total = sum(image.width for image in scaled) + GAP_PX * (len(scaled) - 1)
    strip = Image.new("RGB", (total, height_px), "white")
    x = 0
    for image in scaled:
        strip.paste(image, (x, 0))
        x += image.width + GAP_PX
    return strip


def small_jpeg(image: Image.Image, most_bytes: int) -> bytes:
    """The content of a JPEG file, at the best quality that keeps it small."""
    for quality in (88, 82, 75, 68, 60):
        buffer = io.BytesIO()
        image.save(buffer, "JPEG", quality=quality, optimize=True, progressive=True)
        if buffer.tell() < most_bytes:
            break
    return buffer.getvalue()


def save(image: Image.Image, name: str) -> None:
    """Write a JPEG, at the best quality that keeps it small."""
    path = IMAGES / name
    for quality in (90, 85, 80, 70, 60):
        image.save(path, quality=quality, optimize=True, progressive=True)
        if path.stat().st_size < MAX_BYTES:
            break
    print(f"{path.relative_to(ROOT)}: {image.width} x {image.height}, {path.stat().st_size} bytes")


if __name__ == "__main__":
    main()
