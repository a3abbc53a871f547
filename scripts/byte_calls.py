"""The fixed set of calls whose outputs `same_bytes.py` compares, and the small inputs they read.

The inputs are drawn by the makers of the unit tests, so they need no outside data and are the same
in every run.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[1]
sys.path[:0] = [str(ROOT / "tests" / "unit"), str(ROOT / "tests" / "integration")]


@dataclass(frozen=True)
class Call:
    """A call of a verb. name: of the folder of its result. words: the command line but for `-o`.

    `{inputs}` and `{out}` in it are the folders of the inputs and of all results.
    """

    name: str
    words: tuple[str, ...]


QUICK = ("--lens", "pinhole", "--cameras", "shared", "--principal-point", "middle",
    "--max-features", "1500")  # fmt: skip
CALLS = (
    Call("facade-one", ("facade", "{inputs}/house0.png", "--height-m", "15")),
    Call(
        "facade-three",
        ("facade", *(f"{{inputs}}/house{row}.png" for row in range(3)), "--rectified"),
    ),
    Call("facade-plain", ("facade", "{inputs}/house1.png", "--eyes", "plain")),
    Call("facade-document", ("facade", "{out}/facade-one/house0/facade.json", "--depth-m", "7")),
    Call("grammar-three", ("grammar", "derive", "haussmann", "--lots", "{inputs}/three.geojson")),
    Call("grammar-demo", ("grammar", "derive", "victorian", "--seed", "4")),
    Call(
        "grammar-tiled",
        ("grammar", "derive", "haussmann", "--lots", "{inputs}/many.geojson", "--seed", "2"),
    ),
    Call("plan-document", ("plan", "{inputs}/plan.json")),
    Call("plan-north", ("plan", "{inputs}/plan.json", "--north", "30", "--no-furniture")),
    Call(
        "plan-panorama",
        ("plan", "{inputs}/plan.json", "--panorama", "{inputs}/around.png", "--seed", "1"),
    ),
    Call("plan-dxf", ("plan", "{inputs}/rooms.dxf", "--surroundings", "none")),
    Call("plan-picture", ("plan", "{inputs}/plan.png")),
    Call("photos-corner", ("photos", "{inputs}/corner", *QUICK)),
    Call(
        "photos-textured",
        (
            "photos", "{inputs}/corner", *QUICK, "--model", "{inputs}/lots.geojson",
            "--crs", "EPSG:25832", "--gcp", "{inputs}/gcp.txt",
        ),
    ),
)  # fmt: skip


def command(call: Call, inputs: str, out: str) -> list[str]:
    """The words of the command line, after `veduta`."""
    words = [word.format(inputs=inputs, out=out) for word in call.words]
    return [*words, "-o", f"{out}/{call.name}", "--quiet"]


def write_inputs(folder: Path) -> None:
    """All files that the calls read."""
    import numpy as np
    from drawn_dxf import saved, two_rooms
    from photo_scene import write_photos
    from PIL import Image
    from rows_of_houses import write_row
    from sample_document import sample_document, sample_photo
    from sample_plan import sample_plan
    from test_photos_textured import write_control, write_model

    from veduta.synthetic.plans.degrade import DEGRADATIONS
    from veduta.synthetic.plans.sets import sheets_of
    from veduta.synthetic.plans.styles import BY_NAME

    folder.mkdir(parents=True)
    for seed in range(3):
        photo = Image.fromarray(sample_photo(sample_document(), seed=seed))
        photo.resize((260, 400), Image.Resampling.LANCZOS).save(folder / f"house{seed}.png")
    write_row(folder / "three.geojson", 3)
    write_row(folder / "many.geojson", 70)
    text = sample_plan().model_dump_json(by_alias=True)
    (folder / "plan.json").write_text(text, encoding="utf-8")
    saved(two_rooms(), folder / "rooms.dxf")
    picture, _ = next(sheets_of(5, BY_NAME["plain"], DEGRADATIONS[0]))
    Image.fromarray(picture).save(folder / "plan.png")
    rows, columns = np.mgrid[0:256, 0:512]
    around = np.stack([columns // 2, rows, 255 - columns // 2], axis=-1).astype(np.uint8)
    Image.fromarray(around).save(folder / "around.png")
    write_photos(folder / "corner")
    write_model(folder / "lots.geojson")
    write_control(folder / "gcp.txt")
