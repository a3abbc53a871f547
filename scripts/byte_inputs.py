"""The small inputs of the calls of `byte_calls.py`.

They are drawn by the makers of the unit tests, so they need no outside data and are the same in
every run.
"""

from __future__ import annotations

import sys
from pathlib import Path

from byte_calls import ROOT

TESTS = ("unit", "unit/carve", "integration")
sys.path[:0] = [str(ROOT / "tests" / folder) for folder in TESTS]


def write_inputs(folder: Path) -> None:
    """All files that the calls read."""
    folder.mkdir(parents=True)
    _facades_and_lots(folder)
    _plans(folder)
    _photos(folder)
    _objects(folder)
    _ways(folder)
    _animals(folder)


def _facades_and_lots(folder: Path) -> None:
    from PIL import Image
    from rows_of_houses import write_row
    from sample_document import sample_document, sample_photo

    for seed in range(3):
        photo = Image.fromarray(sample_photo(sample_document(), seed=seed))
        photo.resize((260, 400), Image.Resampling.LANCZOS).save(folder / f"house{seed}.png")
    write_row(folder / "three.geojson", 3)
    write_row(folder / "many.geojson", 70)


def _plans(folder: Path) -> None:
    import numpy as np
    from drawn_dxf import saved, two_rooms
    from PIL import Image
    from sample_plan import sample_plan

    from veduta.synthetic.plans.degrade import DEGRADATIONS
    from veduta.synthetic.plans.sets import sheets_of
    from veduta.synthetic.plans.styles import BY_NAME

    text = sample_plan().model_dump_json(by_alias=True)
    (folder / "plan.json").write_text(text, encoding="utf-8")
    saved(two_rooms(), folder / "rooms.dxf")
    picture, _ = next(sheets_of(5, BY_NAME["plain"], DEGRADATIONS[0]))
    Image.fromarray(picture).save(folder / "plan.png")
    rows, columns = np.mgrid[0:256, 0:512]
    around = np.stack([columns // 2, rows, 255 - columns // 2], axis=-1).astype(np.uint8)
    Image.fromarray(around).save(folder / "around.png")


def _photos(folder: Path) -> None:
    from photo_scene import write_photos
    from test_photos_textured import write_control, write_model

    write_photos(folder / "corner")
    write_model(folder / "lots.geojson")
    write_control(folder / "gcp.txt")


def _objects(folder: Path) -> None:
    """A ball with its silhouettes, and photos of a wall with a block before it."""
    from ring_of_a_ball import write_ring
    from stereo_scene import write_set

    write_ring(folder / "ball", masks=True)
    write_set(folder / "wall")


def _ways(folder: Path) -> None:
    """A street's scans, and views along a gorge."""
    from veduta.synthetic.drives import StreetOptions, TruckOptions, build_street, scan_street
    from veduta.synthetic.drives.write import write_drive
    from veduta.synthetic.walks.record import GorgeWalk, write_walk

    street = build_street(StreetOptions(length_m=30.0), 4)
    write_drive(scan_street(street, TruckOptions(), 4), folder / "street")
    write_walk(folder / "gorge", GorgeWalk(keys=3, step_m=1.5, width_px=224, height_px=144))


def _animals(folder: Path) -> None:
    """The midlines of an eel by their points, and frames of a band that swims."""
    import numpy as np
    from drawn_footage import band_footage
    from PIL import Image

    lines = ["t,frame,point,x_mm,y_mm"]
    for frame in range(40):
        for point in range(20):
            x = 4.0 * frame - 8.0 * point
            y = (2.0 + 0.6 * point) * np.sin(0.35 * point - 0.5 * frame)
            lines.append(f"{0.02 * frame:.2f},{frame},{point},{x:.3f},{y:.3f}")
    (folder / "eel.csv").write_text("\n".join(lines), encoding="ascii")
    (folder / "worm").mkdir()
    for number, pixels in enumerate(band_footage()):
        Image.fromarray(pixels).save(folder / "worm" / f"{number:03d}.png")
