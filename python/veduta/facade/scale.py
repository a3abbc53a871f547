"""How many metres a pixel is: from the facade's height, its mean storey, or an assumed storey."""

from __future__ import annotations

from veduta.facade.document import Scale
from veduta.facade.options import ScaleOptions

ASSUMED_STOREY_M = 3.0


def metres(rows: list[float], bottom: float, options: ScaleOptions) -> Scale:
    """Metres per rectified pixel.

    `rows` are the boundaries of the floors above the ground floor, eaves first, and `bottom` is
    the street, all in rectified pixels from the top.
    """
    if options.height_m is not None:
        return Scale(metres_per_px=options.height_m / (bottom - rows[0]), basis="height")
    storey_px = (rows[-1] - rows[0]) / (len(rows) - 1)
    if options.storey_m is not None:
        return Scale(metres_per_px=options.storey_m / storey_px, basis="storey")
    return Scale(metres_per_px=ASSUMED_STOREY_M / storey_px, basis="assumed-storey")


def scale_notes(scale: Scale, options: ScaleOptions) -> list[str]:
    """What was assumed, and what was given but not used."""
    notes = []
    if options.height_m is not None and options.storey_m is not None:
        notes.append("scale: --height-m decides; --storey-m beside it is not used")
    if scale.basis == "assumed-storey":
        notes.append(f"scale: the mean storey is assumed to be {ASSUMED_STOREY_M} m")
    return notes
