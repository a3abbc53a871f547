"""How many metres a pixel is: from the facade's height, storey or width, or an assumed storey."""

from __future__ import annotations

from veduta.facade.document import FacadeBox, Rectification, Scale
from veduta.facade.options import ScaleOptions
from veduta.run.errors import InputError, NotFoundError

ASSUMED_STOREY_M = 3.0
ASSUMED_STOREY = f"scale: the mean storey is assumed to be {ASSUMED_STOREY_M} m"
SMALLEST_SIDE_M, LARGEST_SIDE_M = 0.5, 1000.0
"""What a building may measure, and single precision bear."""

_MEND_ASPECT = {
    "given": "Give a photo that shows one facade, and is as wide for its height as the facade is.",
    "focal-length": "Check the focal length (--focal-mm35), or name the facade's --corners.",
    "assumed": "Give the focal length (--focal-mm35), which tells width from height.",
}


def metres(
    rows: list[float],
    bottom: float,
    options: ScaleOptions,
    storey_px: float | None = None,
    width_px: float = 0.0,
    known: float | None = None,
) -> Scale:
    """Metres per rectified pixel.

    `rows` are the boundaries of the floors above the ground floor, eaves first, and `bottom` is
    the street, all in rectified pixels from the top. `storey_px` is how high a storey would be
    where the rows have no floor. `width_px` is the front's. `known`: metres per rectified pixel of
    a depth map, which are taken where the options say nothing.
    """
    if options.height_m is not None:
        return Scale(metres_per_px=options.height_m / (bottom - rows[0]), basis="height")
    if len(rows) > 1 or not storey_px:
        storey_px = (rows[-1] - rows[0]) / (len(rows) - 1)
    if options.storey_m is not None:
        return Scale(metres_per_px=options.storey_m / storey_px, basis="storey")
    if options.width_m is not None and width_px > 0:
        return Scale(metres_per_px=options.width_m / width_px, basis="width")
    if known is not None:
        return Scale(metres_per_px=known, basis="depth-map")
    return Scale(metres_per_px=ASSUMED_STOREY_M / storey_px, basis="assumed-storey")


def scale_notes(scale: Scale, options: ScaleOptions) -> list[str]:
    """What was assumed, and what was given but not used."""
    notes = []
    if options.height_m is not None and options.storey_m is not None:
        notes.append("scale: --height-m decides; --storey-m beside it is not used")
    if options.width_m is not None and scale.basis != "width":
        notes.append(f"scale: --{scale.basis}-m decides; --width-m beside it is not used")
    if scale.basis == "depth-map":
        notes.append("scale: that of the wall of the depth map")
    if scale.basis == "assumed-storey":
        notes.append(ASSUMED_STOREY)
    return notes


def is_possible(side_m: float) -> bool:
    """Whether a side of a building can have this length (m)."""
    return SMALLEST_SIDE_M <= side_m <= LARGEST_SIDE_M


def require_possible(facade: FacadeBox, record: Rectification, basis: str = "height") -> None:
    """Refuse a facade of a size that none has, by what its height or its proportions come from.

    basis: that of the scale. InputError names the option that gives the height. Where the width
    alone is at fault, the photo was rectified wrongly, or shows no facade: NotFoundError.
    """
    bounds = f"not between {SMALLEST_SIDE_M:g} and {LARGEST_SIDE_M:g} m"
    if not is_possible(facade.height_m):
        by_width = basis == "width"
        raise InputError(
            "--width-m" if by_width else "--height-m",
            f"makes the facade {facade.height_m:g} m high, {bounds}",
            "Check the width, or the wall that has it, or give --height-m."
            if by_width
            else "Give the metres from the ground to the eaves.",
        )
    if not is_possible(facade.width_m):
        size = f"{facade.width_m:.3g} m wide and {facade.height_m:.3g} m high"
        raise NotFoundError(
            "a facade", f"it would be {size}, {bounds}", _MEND_ASPECT[record.aspect]
        )
