"""A page on which one clicks where a drive begins, over its surface model (sections 2 and 8.3).

The click is the paper's one manual step. The page shows what of `drive.toml` it comes to.
"""

from __future__ import annotations

import base64
import json
from pathlib import Path

import cv2
import numpy as np
from jinja2 import Environment, PackageLoader, StrictUndefined
from numpy.typing import NDArray

from veduta.drive.document.log import Surface
from veduta.drive.read.own import LOG, read_toml
from veduta.drive.read.surface_picture import draw_surface
from veduta.drive.record import Overview
from veduta.run.atomic import atomic_write
from veduta.run.errors import InputError
from veduta.run.names import real_path

LONGEST_PX = 2400
"""The longer side of the picture; a click is as exact as one of its pixels."""
_FAR_M = 1e8
_JPEG_QUALITY = 88


def write_start_page(log: Path, page: Path) -> None:
    """The page for a log's folder. InputError where it names no surface model, or a wrong one."""
    toml = log / LOG
    if not toml.is_file():
        raise InputError(toml, "there is no such file", "docs/drive.md says what stands in it.")
    surface = read_toml(toml).surface
    if surface is None:
        fault = "names no surface model"
        raise InputError(toml, fault, 'Write [surface] and file = "MODEL.tif" into it first.')
    if not page.parent.is_dir():
        raise InputError(page.parent, "there is no such folder", "Make it first, or name another.")
    overview = draw_surface(
        log / surface.file, (0.0, 0.0, 0.0), (-_FAR_M, -_FAR_M), (_FAR_M, _FAR_M), LONGEST_PX
    )
    text = start_page(real_path(log).name, surface, overview)
    with atomic_write(page) as written:
        written.write_text(text, encoding="utf-8")


def start_page(name: str, surface: Surface, overview: Overview) -> str:
    """The page as HTML, in one file that needs nothing else."""
    rows, columns = overview.pixels.shape[:2]
    high = [overview.low[0] + columns * overview.cell_m, overview.low[1] + rows * overview.cell_m]
    start = surface.start or ("", "")
    heading = "" if surface.heading_deg is None else surface.heading_deg
    fields = [
        ("x", "x of the start (m)", start[0]),
        ("y", "y of the start (m)", start[1]),
        ("heading", "heading (degrees)", heading),
        ("within", "off by at most (m)", surface.within_m),
    ]
    told = surface.model_dump(
        exclude_unset=True, exclude={"file", "start", "heading_deg", "within_m", "search"}
    )
    environment = Environment(
        loader=PackageLoader("veduta.drive"), autoescape=True, undefined=StrictUndefined
    )
    return environment.get_template("start.html.j2").render(
        name=name,
        picture=_picture(overview.pixels),
        fields=fields,
        note=f"A pixel of the picture is {overview.cell_m:.2g} m.",
        place={
            "file": surface.file,
            "low": list(overview.low),
            "high": high,
            "kept": [f"{key} = {json.dumps(value)}" for key, value in told.items()],
        },
    )


def _picture(pixels: NDArray[np.uint8]) -> str:
    """North up, as a JPEG inside the page."""
    shown = np.ascontiguousarray(pixels[::-1])
    _, coded = cv2.imencode(".jpg", shown[..., ::-1], [cv2.IMWRITE_JPEG_QUALITY, _JPEG_QUALITY])
    return f"data:image/jpeg;base64,{base64.b64encode(coded.tobytes()).decode('ascii')}"
