"""All that is known of a drawn and scanned storey, as plain JSON, and back from it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.synthetic.plans.house import Fitting, Opening, Room, Stairs, Storey, Wall

SCHEMA = "veduta/plan-truth"
VERSION = 1


@dataclass(frozen=True)
class SheetTruth:
    """A picture's truth.

    `px_from_m` (3, 3) is the affine from the plan frame (metres, y up) to pixels of the picture,
    x right and y down, origin at the upper left corner of the upper left pixel.
    `dpi` is what the file says of its resolution, where the sheet bears a ratio such as 1:100.
    `fittings` is None where nobody kept what was drawn in the rooms.
    """

    file: str
    seed: int
    style: str
    degradation: str
    unseen: tuple[str, ...]
    walls_drawn: str
    px_from_m: NDArray[np.float64]
    says_scale: bool
    dpi: float | None
    storey: Storey
    fittings: tuple[Fitting, ...] | None = None

    @property
    def metres_per_px(self) -> float:
        """Of the picture as it is."""
        return float(abs(np.linalg.det(self.px_from_m[:2, :2])) ** -0.5)

    @property
    def mirrored(self) -> bool:
        """Whether the picture is a mirror image of what was drawn."""
        return bool(np.linalg.det(self.px_from_m[:2, :2]) > 0)  # y turns over once as it is


def to_json(truth: SheetTruth) -> dict[str, Any]:
    """The truth as JSON values."""
    fields = asdict(truth)
    fields["px_from_m"] = truth.px_from_m.tolist()
    return {
        "schema": SCHEMA,
        "version": VERSION,
        **fields,
        "metres_per_px": truth.metres_per_px,
        "mirrored": truth.mirrored,
    }


def from_json(fields: Mapping[str, Any]) -> SheetTruth:
    """The truth that `to_json` wrote."""
    storey = fields["storey"]
    return SheetTruth(
        fields["file"],
        fields["seed"],
        fields["style"],
        fields["degradation"],
        tuple(fields["unseen"]),
        fields["walls_drawn"],
        np.array(fields["px_from_m"], float),
        fields["says_scale"],
        fields["dpi"],
        Storey(
            storey["number"],
            tuple(Wall(**_pairs(wall, "start_m", "end_m")) for wall in storey["walls"]),
            tuple(Opening(**opening) for opening in storey["openings"]),
            tuple(Room(**_outline(room)) for room in storey["rooms"]),
            tuple(_stairs(flight) for flight in storey["stairs"]),
        ),
        _fittings(fields.get("fittings")),
    )


def _pairs(fields: Mapping[str, Any], *names: str) -> dict[str, Any]:
    return {**fields, **{name: tuple(fields[name]) for name in names}}


def _stairs(fields: Mapping[str, Any]) -> Stairs:
    """Older truths know straight flights alone."""
    rings = tuple(tuple(map(tuple, ring)) for ring in fields.get("steps_m", ()))
    path = tuple(map(tuple, fields.get("path_m", ())))
    return Stairs(**{**_pairs(_outline(fields), "up"), "steps_m": rings, "path_m": path})


def _fittings(found: Sequence[Mapping[str, Any]] | None) -> tuple[Fitting, ...] | None:
    if found is None:
        return None
    return tuple(Fitting(**_pairs(fields, "box_m")) for fields in found)


def _outline(fields: Mapping[str, Any]) -> dict[str, Any]:
    return {**fields, "outline_m": tuple(tuple(point) for point in fields["outline_m"])}
