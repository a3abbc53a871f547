"""What the report says of where the place lies."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from veduta.photos.cameras.component import component_name
from veduta.photos.world.georeference import Fit, Georeference
from veduta.photos.world.georeferencing import Georeferenced, method_name
from veduta.run.page import Table

MOST_ROWS = 200


def georef_measures(found: Sequence[Georeferenced]) -> dict[str, Any]:
    """The first component's place in the world, in numbers."""
    accepted = found[0].accepted if found else None
    refused = georef_refused(found)
    if accepted is None or accepted.best is None:
        return {"georeferenced": None, "georef_refused": refused}
    best = accepted.best
    return {
        "georeferenced": accepted.method,
        "georef_refused": refused,
        "crs": accepted.crs,
        "georef_rms_m": round(best.rms_m, 4),
        "georef_shift_sd_m": [round(float(value), 3) for value in best.shift_sd_m],
        "georef_rotation_sd_deg": [
            round(float(value), 3) for value in np.rad2deg(best.rotation_sd_rad)
        ],
        "georef_scale_sd": round(best.scale_sd, 5),
    }


def georef_line(measures: dict[str, Any]) -> str:
    """For the summary; empty where the place is in a frame of its own."""
    method = measures.get("georeferenced")
    if method is None:
        return ""
    east, north, up = measures["georef_shift_sd_m"]
    return (
        f"in {measures['crs']} by {method_name(method)}, known to"
        f" {max(east, north):.2f} m and {up:.2f} m in height"
    )


def georef_refused(found: Sequence[Georeferenced]) -> list[str]:
    """What was given or found for the first component and not believed, and why."""
    tried = found[0].tried if found else ()
    return [f"{method_name(one.method)}: {one.why}" for one in tried if not one.accepted]


def georef_alarms(found: Sequence[Georeferenced]) -> list[str]:
    """What of the accepted reference a person must be told at the terminal."""
    accepted = found[0].accepted if found else None
    return [] if accepted is None else list(accepted.notes)


def georef_notes(found: Sequence[Georeferenced]) -> list[str]:
    """What was tried, believed or not, and why."""
    notes = []
    for number, one in enumerate(found):
        whose = f"component {component_name(number)}: " if len(found) > 1 else ""
        for tried in one.tried:
            state = "laid into the world by" if tried.accepted else "refused:"
            notes.append(f"{whose}{state} {method_name(tried.method)}: {tried.why}")
            notes += [f"{whose}{method_name(tried.method)}: {note}" for note in tried.notes]
    return notes


def georef_tables(found: Sequence[Georeferenced]) -> list[Table]:
    """The fits, and what is left at each facade, photo or control point."""
    rows: list[list[str]] = []
    tables: list[Table] = []
    for number, one in enumerate(found):
        for tried in one.tried:
            for which, fit in (("best", tried.best), ("second", tried.second)):
                if fit is not None:
                    rows.append(_row(number, tried, which, fit))
            if tried.best is not None and tried.best.residuals:
                tables.append(_residuals(number, tried, tried.best))
    if not rows:
        return []
    columns = (
        *("component", "by", "fit", "believed", "scale", "turn, tilt"),
        *("place", "height", "rms", "score"),
    )
    note = (
        "What stays open is one deviation; of the place, that of the middle of the photos. Best and"
        " second are the two ways of laying it that fit best: the higher the score, the better."
        " rms is how far the photos and what they are laid onto lie apart."
    )
    return [Table("In the world", columns, rows, note=note), *tables]


def _row(number: int, tried: Georeference, which: str, fit: Fit) -> list[str]:
    tilt = np.rad2deg(fit.rotation_sd_rad)
    believed = "yes" if tried.accepted and which == "best" else "no"
    return [
        component_name(number),
        method_name(tried.method),
        which,
        believed,
        f"{fit.world_from_model.scale:.4g} ± {100 * fit.scale_sd:.2f} %",
        f"± {tilt[2]:.2f}°, ± {max(tilt[0], tilt[1]):.2f}°",
        f"± {max(fit.shift_sd_m[0], fit.shift_sd_m[1]):.2f} m",
        f"± {fit.shift_sd_m[2]:.2f} m",
        f"{fit.rms_m:.2f} m",
        f"{fit.score:.1f}",
    ]


def _residuals(number: int, tried: Georeference, fit: Fit) -> Table:
    what = {"model": "facade", "gps": "photo", "gcp": "control point"}[tried.method]
    state = "" if tried.accepted else ", refused"
    rows = [(one.name, round(one.distance_m, 3)) for one in fit.residuals[:MOST_ROWS]]
    title = f"What is left at each {what} (component {component_name(number)}{state})"
    return Table(title, (what, "m"), rows, for_experts=tried.method == "gps")
