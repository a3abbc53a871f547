"""The worked example of an edit in docs/facade.md, made from the demo: `make pictures` calls it.

In the demo's street the shop front takes in the house door beside it. The edit ends the shop where
the street's truth says, and adds the door. The JSON in the page is written here, so that it is what
the demo gives and what the picture shows.
"""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from veduta.geometry.homography import apply

PAGE = Path(__file__).with_name("facade.md")
VEDUTA = Path(sys.executable).parent / "veduta"
MARGIN_PX = 10
Element = dict[str, Any]


def make_edit(demo: Path, work: Path) -> Path:
    """Edit a copy of the demo's document and rebuild it; the folder of the new place.

    The page gets the elements before and after.
    """
    source = demo / "place" / "street"
    document = json.loads((source / "facade.json").read_text("utf-8"))
    truth = json.loads((demo / "truth" / "truth.json").read_text("utf-8"))
    place = _shop_over_the_door(document)
    before = document["elements"][place]
    after = [_ended(before, _rectified(truth, document, "shop"))]
    after.append(_door(before, _rectified(truth, document, "door")))
    document["elements"][place : place + 1] = after
    _write_page(before, after)
    copy = work / "street"
    copy.mkdir(parents=True)
    shutil.copy(source / "rectified.jpg", copy)
    (copy / "facade.json").write_text(json.dumps(document), "utf-8")
    subprocess.run([VEDUTA, "facade", copy / "facade.json", "-o", work / "place"], check=True)
    return work / "place"


def ground_floor(overlay: Path, document: Path) -> Image.Image:
    """The part of an overlay that shows the ground floor of the facade."""
    content = json.loads(document.read_text("utf-8"))
    shop = next(item for item in content["elements"] if item["class"] == "shop")
    box = content["facade"]
    below, height = box["y_px"] + box["height_px"], 1.25 * shop["height_px"]
    left, right = box["x_px"] - MARGIN_PX, box["x_px"] + box["width_px"] + MARGIN_PX
    with Image.open(overlay) as image:
        scale = image.height / content["rectification"]["height_px"]
        corners = np.multiply((left, below - height, right, below), scale).round().astype(int)
        return image.convert("RGB").crop(tuple(corners.tolist()))


def _shop_over_the_door(document: dict[str, Any]) -> int:
    """The place in the list of the shop front that has no door beside it."""
    shops = [i for i, item in enumerate(document["elements"]) if item["class"] == "shop"]
    if not shops or any(item["class"] == "door" for item in document["elements"]):
        raise SystemExit("the demo's ground floor is read otherwise now: choose another example")
    return max(shops, key=lambda i: document["elements"][i]["width_px"])


def _rectified(truth: dict[str, Any], document: dict[str, Any], kind: str) -> list[int]:
    """Left, top, right and bottom of the true shop or door in the rectified photo (px)."""
    element = next(item for item in truth["elements"] if item["class"] == kind)
    matrix = np.array(document["rectification"]["rectified_from_source"])
    corners = apply(matrix, np.array(element["visible_corners_px"]))
    return [round(float(v)) for v in (*corners.min(axis=0), *corners.max(axis=0))]


def _ended(shop: Element, true: list[int]) -> Element:
    """The shop front with its right side where it truly is."""
    return shop | {"width_px": round(true[2] - shop["x_px"], 2)}


def _door(shop: Element, true: list[int]) -> Element:
    """A door as a person would write it; it stands on what the shop stands on."""
    foot = shop["y_px"] + shop["height_px"]
    pixels = {"x_px": true[0], "y_px": true[1], "width_px": true[2] - true[0]}
    metres = {"x_m": 1, "y_m": 1, "width_m": 1, "height_m": 1}
    return {"class": "door", **pixels, "height_px": round(foot - true[1]), **metres, "score": 1}


def _write_page(before: Element, after: list[Element]) -> None:
    text = PAGE.read_text("utf-8")
    for name, elements in (("before", [before]), ("after", after)):
        start, end = f"<!-- edit {name} -->\n", f"<!-- /edit {name} -->"
        head, _, rest = text.partition(start)
        _, found, tail = rest.partition(end)
        if not found:
            raise SystemExit(f"{PAGE.name}: has no place for the elements {name} the edit")
        body = ",\n".join(map(_shown, elements))
        text = f"{head}{start}```json\n{body}\n```\n{end}{tail}"
    PAGE.write_text(text, "utf-8")


def _shown(element: Element) -> str:
    """An element as JSON, a line for its pixels and one for its metres."""
    lines: dict[str, list[str]] = {"class": [], "px": [], "m": [], "": []}
    for name, value in element.items():
        unit = name.rpartition("_")[2]
        short = round(value, 2) if isinstance(value, float) else value
        lines[unit if unit in lines else ""].append(f"{json.dumps(name)}: {json.dumps(short)}")
    return "{" + ",\n ".join(", ".join(line) for line in lines.values()) + "}"
