"""What `report.json` and `report.html` say: of one image, and of the whole call."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any
from urllib.parse import quote

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from pydantic import JsonValue

from veduta.facade.adjusted import count_adjusted
from veduta.facade.document import FacadeDocument
from veduta.facade.house_folders import beside_line
from veduta.facade.outputs import coloured, rasterise
from veduta.facade.pipeline import Building
from veduta.facade.quantities import quantities
from veduta.facade.rectify import are_corners_doubtful
from veduta.facade.rule_head import WALL_TEXTURE
from veduta.imaging.encode import jpeg_bytes, png_bytes
from veduta.imaging.read import read_image
from veduta.run.errors import InputError
from veduta.run.options import Options
from veduta.run.page import Bars, Page, Picture, Table, render
from veduta.run.report import Failure, Report, StepRecord, counted

THUMBNAIL_PX = 1000
SMALL_PX = 420
MAX_THUMBNAILS = 60
FILES = (
    ("facade.json", "everything that was found; edit it and rebuild"),
    ("rectified.jpg", "the fronto-parallel photo"),
    ("before.png", "what stands before the front, and is taken out of the wall's texture"),
    ("labels.png", "a class per pixel, drawn from facade.json"),
    ("overlay.png", "what was found, over the photo, with the numbers of the elements"),
    ("rules.cga", "the building as rules that repeat: derive it on a wider or higher lot"),
    ("cells.cga", "the building as it was read, from which the models are derived"),
    ("facade.csv", "counts, areas and the ratio of windows to wall, by kind and floor"),
    ("lot.geojson", "the lot that the rules stand on"),
    ("textures/", "the pictures that the rules name"),
    ("model.glb", "the building as glTF 2.0"),
    ("model.city.json", "the building as CityJSON 2.0, LoD3, with the pictures of `textures/`"),
)
FOUND_NOTE = (
    "Elements, regions and floor lines. The number 17 stands on elements[17] of facade.json;"
    " a small element has none. Dashed, with a white tag, is what is doubtful: its score is below"
    " 0.5."
)
_BASIS = {
    "height": "from the height given",
    "storey": "from the storey given",
    "width": "from the width given",
    "depth-map": "from the depth map",
    "assumed-storey": "assumed",
    "edited": "as edited",
}
WHOLE_WIDTH = 99.5
"""Per cent of the picture's width from which nothing worth a word was cut off beside it."""


def image_report(
    building: Building, options: Options, steps: list[StepRecord]
) -> tuple[Report, bytes]:
    """The report of one building, and its page."""
    document, style = building.document, building.style
    report = Report(
        verb="facade",
        subject=document.source.image,
        state="done",
        options=options.model_dump(mode="json"),
        steps=steps,
        measures={
            **measures(document),
            **count_adjusted(building.part.notes),
            **_taken_out(building),
            "window_to_wall": round(quantities(building.document).window_to_wall, 4),
        },
        notes=[*document.notes, *building.part.notes],
    )
    page = Page(
        title=document.source.image,
        summary=summary_line(measures(document)),
        facts=_facts(document),
        pictures=[*_pictures(building), *(style.pictures if style else ())],
        tables=[
            _elements(document),
            *(style.tables if style else ()),
            _provenance(building),
            *_energy(document),
        ],
        bars=[_times(steps)],
        files=FILES,
    )
    return report, render(report, page)


def call_report(
    out: Path,
    options: dict[str, Any],
    summaries: Mapping[str, Mapping[str, JsonValue]],
    failures: Sequence[Failure],
    notes: list[str],
) -> tuple[Report, bytes]:
    """The report of a call: a line for each image that is done, by its name; then the failures.

    `options` are those that the call's images share.
    """
    total = len(summaries) + len(failures)
    report = Report(
        verb="facade",
        subject="call",
        state="done" if summaries else "failed",
        options=options,
        measures={"images": total, "done": len(summaries), "results": dict(summaries)},
        notes=notes,
        failures=list(failures),
    )
    columns = ("image", "storeys", "windows", "doubtful", "width m", "height m", "scale", "seconds")
    keys = ("storeys", "windows", "doubtful_elements", "width_m", "height_m", "scale", "seconds")
    table = Table(
        title="Images",
        columns=columns,
        rows=[
            [name, *(_cell(summary.get(key)) for key in keys)]
            for name, summary in summaries.items()
        ],
        links=[f"{quote(name)}/report.html" for name in summaries],
    )
    page = Page(
        title=f"{total} {'image' if total == 1 else 'images'}",
        summary=f"{len(summaries)} of {total} became buildings.",
        pictures=_thumbnails(out, list(summaries)),
        tables=[table] if summaries else [],
        files=(("place.json", "the buildings as one place"),) if summaries else (),
    )
    return report, render(report, page)


def measures(document: FacadeDocument) -> dict[str, Any]:
    """What was found, in numbers."""
    found = Counter(element.class_ for element in document.elements)
    doubtful = Counter(element.class_ for element in document.elements if element.is_doubtful)
    return {
        "storeys": document.storeys,
        "storeys_doubtful": document.storeys_doubtful,
        "windows": found["window"],
        "elements": dict(sorted(found.items())),
        "doubtful_windows": doubtful["window"],
        "doubtful_elements": doubtful.total(),
        "picture_share": round(document.facade.width_px / document.rectification.width_px, 3),
        "width_m": round(document.facade.width_m, 3),
        "height_m": round(document.facade.height_m, 3),
        "metres_per_px": document.scale.metres_per_px,
        "scale": _BASIS[document.scale.basis],
        "rectification": document.rectification.method,
        "residual_deg": document.rectification.residual_deg,
        "corners_doubtful": are_corners_doubtful(document.rectification),
        "energy": {name: term.total for name, term in document.energy.items()},
    }


def summary_line(found: Mapping[str, Any]) -> str:
    """What was found, in a line, with what of it is in doubt."""
    # A result of an older run may not say what is in doubt, nor what was cut off.
    windows = int(found.get("doubtful_windows", 0))
    others = int(found.get("doubtful_elements", 0)) - windows
    share = 100 * float(found.get("picture_share", 1.0))
    said = [
        counted(found["storeys"], "storey")
        + (" (doubtful)" if found.get("storeys_doubtful", False) else ""),
        counted(found["windows"], "window") + _in_doubt(windows),
        f"{counted(others, 'other element')} doubtful" if others else "",
        f"{found['width_m']:.1f} x {found['height_m']:.1f} m (scale {found['scale']})",
        f"{share:.0f} % of the picture's width" if share < WHOLE_WIDTH else "",
        "corners doubtful" if found.get("corners_doubtful", False) else "",
        beside_line(found),
    ]
    return ", ".join(part for part in said if part)


def adjusted_line(found: Mapping[str, Any]) -> str:
    """What does not fit the model, in a line; empty where everything does."""
    # A result of an older run may not say it.
    lost, less = int(found.get("left_out", 0)), int(found.get("clipped", 0))
    said = []
    if lost:
        said.append(f"{counted(lost, 'element')} left out of the model")
    if less:
        said.append(f"{less if lost else counted(less, 'element')} clipped")
    return ", ".join(said)


def _wall(building: Building) -> NDArray[np.uint8]:
    return building.model.textures[WALL_TEXTURE].pixels


def _wall_note(building: Building) -> str:
    """What was taken out of the wall's texture, most first."""
    shares = sorted(building.model.cleared.shares.items(), key=lambda item: -item[1])
    told = ", ".join(f"{name} {100 * share:.0f} %" for name, share in shares if share >= 0.005)
    copied = f"{100 * building.model.cleared.copied:.0f} % of that is copied from elsewhere"
    if told:
        return f"Without what stands before it ({told}); {copied}."
    notes = building.model.cleared.notes or ("as the photo has it",)
    return "; ".join(notes).capitalize() + "."


def _taken_out(building: Building) -> dict[str, Any]:
    """What the wall's texture has no longer, as shares of it, and what came in its place."""
    cleared = building.model.cleared
    return {
        "taken_out": {name: round(share, 4) for name, share in cleared.shares.items()},
        "filled": round(float(cleared.filled.mean()), 4),
        "filled_by_copies": round(cleared.copied, 3),
        "light_evened": round(cleared.evened, 3),
    }


def _in_doubt(count: int) -> str:
    return f" ({count} doubtful)" if count else ""


def _facts(document: FacadeDocument) -> list[tuple[str, str]]:
    found = measures(document)
    size, box = document.rectification, document.facade
    method = size.method + (" (doubtful)" if found["corners_doubtful"] else "")
    residual = "" if size.residual_deg is None else f", {size.residual_deg:.2f}° off"
    return [
        ("storeys", f"{document.storeys}{' (doubtful)' if document.storeys_doubtful else ''}"),
        ("windows", f"{found['windows']}{_in_doubt(found['doubtful_windows'])}"),
        ("facade", f"{box.width_m:.1f} x {box.height_m:.1f} m"),
        ("scale", _BASIS[document.scale.basis]),
        ("rectified", f"{method}{residual}"),
        ("resolution", f"{1000 * document.scale.metres_per_px:.1f} mm/px"),
    ]


def _pictures(building: Building) -> list[Picture]:
    labels = coloured(building.document, rasterise(building.document))
    return [
        _picture("Found", FOUND_NOTE, building.found, "overlay.png"),
        _picture("Photo", "The fronto-parallel view.", building.pixels, "rectified.jpg"),
        _picture("Wall", _wall_note(building), _wall(building), "textures/wall.jpg"),
        _picture("Labels", "Each pixel in the colour of its class.", labels, "labels.png"),
    ]


def _picture(title: str, note: str, pixels: NDArray[np.uint8], link: str) -> Picture:
    """A small copy for the page; flat colours stay sharp as PNG."""
    image = Image.fromarray(pixels)
    if link == "labels.png":
        image.thumbnail((THUMBNAIL_PX, THUMBNAIL_PX), Image.Resampling.NEAREST)
        data = png_bytes(image.quantize(16), optimize=True)
        return Picture(title, note, data, "image/png", link)
    image.thumbnail((THUMBNAIL_PX, THUMBNAIL_PX))
    return Picture(title, note, jpeg_bytes(image, 85), "image/jpeg", link)


def _thumbnails(out: Path, names: Sequence[str]) -> list[Picture]:
    """A small overlay of each of the first images, that leads to its report."""
    pictures = []
    for name in names[:MAX_THUMBNAILS]:
        try:
            image = Image.fromarray(read_image(out / name / "overlay.png").pixels)
        except InputError:
            continue  # somebody has put something else in its place
        image.thumbnail((SMALL_PX, SMALL_PX))
        link = f"{quote(name)}/report.html"
        pictures.append(Picture(name, "", jpeg_bytes(image, 80), "image/jpeg", link))
    return pictures


def _elements(document: FacadeDocument) -> Table:
    rows: list[list[float | int | str | None]] = []
    for name in document.classes:
        items = [element for element in document.elements if element.class_ == name]
        if items:
            width = float(np.median([item.width_m for item in items]))
            height = float(np.median([item.height_m for item in items]))
            score = float(np.mean([item.score for item in items]))
            doubtful = sum(item.is_doubtful for item in items)
            sizes = round(width, 2), round(height, 2), round(score, 2)
            rows.append([name, len(items), doubtful, *sizes])
    columns = ("class", "found", "doubtful", "median width m", "median height m", "mean score")
    note = (
        "The score says how well the photo supports an element, from 0 to 1. Doubtful is what has"
        " a score below 0.5: the photo speaks rather against it."
    )
    return Table("Elements", columns, rows, note=note)


def _provenance(building: Building) -> Table:
    features = building.part.features
    count: Counter[tuple[str, str]] = Counter()
    area: defaultdict[tuple[str, str], float] = defaultdict(float)
    for row in range(len(features)):
        key = (features.semantic(row).value, features.provenance(row).value)
        count[key] += 1
        area[key] += float(building.part.feature_area_m2[row])
    rows = [(*key, count[key], round(area[key], 1)) for key in sorted(count)]
    note = "measured: seen in the photo; inferred: follows from it; invented: nothing shows it"
    columns = ("surface", "provenance", "features", "area m²")
    return Table("Where the surfaces come from", columns, rows, note=note)


def _energy(document: FacadeDocument) -> list[Table]:
    rows: list[list[float | int | str | None]] = []
    for name, field in document.energy.items():
        rows.append([name, "total", field.total, field.nodes, field.labels])
        rows += [[name, term, value, None, None] for term, value in field.terms.items()]
    columns = ("chain", "term", "energy", "nodes", "labels")
    note = (
        "How the floors and the window columns were chosen: each way to divide the facade has a"
        " cost, its energy, and of all ways the one of least energy was taken. Nodes are the"
        " floors or columns, labels the places and sizes that each could have had."
    )
    return [Table("Energy", columns, rows, note=note, for_experts=True)] if rows else []


def _times(steps: list[StepRecord]) -> Bars:
    return Bars("Time per step", "s", [(step.name, step.seconds) for step in steps])


def _cell(value: JsonValue) -> float | int | str | None:
    return value if isinstance(value, float | int | str) else None
