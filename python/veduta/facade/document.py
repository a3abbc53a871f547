"""The facade document (`facade.json`): what was found in one photo, and nothing derived from it.

Pixel frame: the rectified image, x right, y down, origin at the upper left corner of the
upper left pixel (its centre is at (0.5, 0.5)). Facade frame: metres, x right along the wall,
y up from the ground, origin at the facade's lower left corner.
"""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, ConfigDict, Field

from veduta.facade.measured_depths import MeasuredDepths
from veduta.facade.options import ModelSizes
from veduta.facade.wall import Wall
from veduta.place.semantics import LABELS, Label

FacadeClass = Label
CLASSES = LABELS
Provenance = Literal["measured", "inferred", "invented"]
SURE_SCORE = 0.5
"""Under this score the photo speaks rather against an element that its neighbours make likely."""


class _Record(BaseModel):
    model_config = ConfigDict(extra="forbid", populate_by_name=True, allow_inf_nan=False)


class Source(_Record):
    """The photo as it was read (after EXIF orientation)."""

    image: str = Field(description="file name of the photo")
    sha256: str
    width_px: int
    height_px: int


class Rectification(_Record):
    """The fronto-parallel view of the facade plane."""

    method: Literal["rectified", "corners", "vanishing-points"]
    width_px: int
    height_px: int
    rectified_from_source: list[list[float]] = Field(
        description="3x3 homography, row major; takes source pixels to rectified pixels"
    )
    aspect: Literal["given", "focal-length", "assumed"] = Field(
        description="where the ratio of horizontal to vertical metres per pixel comes from"
    )
    focal_px: float | None = None
    residual_deg: float | None = Field(
        default=None,
        description=(
            "median angle (degrees) of straight edges to the nearest axis, in a view that was"
            " measured without them"
        ),
    )


class Scale(_Record):
    """Metres per rectified pixel, the same in x and y."""

    metres_per_px: float
    basis: Literal["height", "storey", "width", "depth-map", "assumed-storey", "edited"]


class FacadeBox(_Record):
    """The facade itself, from the ground to the eaves, in the rectified image and in metres."""

    x_px: float
    y_px: float
    width_px: float
    height_px: float
    width_m: float
    height_m: float


class House(_Record):
    """Which of several houses of the photo this one is."""

    number: int = Field(ge=1, description="from the left")
    of: int = Field(ge=2)


class Extent(_Record):
    """A region of the rectified image that the elements stand on (sky, roof, wall, other)."""

    class_: FacadeClass = Field(alias="class")
    polygon_px: list[tuple[float, float]]
    provenance: Provenance = "measured"


RoofKind = Literal["mansard", "gable", "hip", "flat"]


class Moulding(_Record):
    """What projects all along a part of the front: a cornice, or a narrower course.

    `x_px, y_px` is its upper left corner, `x_m, y_m` its lower left. `modillions`: a cornice over a
    row of brackets.
    """

    kind: Literal["cornice", "modillions", "string-course"]
    x_px: float
    y_px: float
    width_px: float
    height_px: float
    score: float = Field(ge=0.0, le=1.0)
    provenance: Provenance = "inferred"


ShutterKind = Literal["open", "closed"]


class Shutter(_Record):
    """What closes a window: an open leaf on the wall beside it, or what covers (a part of) it.

    `x_px, y_px` is its upper left corner.
    """

    kind: ShutterKind
    x_px: float
    y_px: float
    width_px: float = Field(gt=0.0)
    height_px: float = Field(gt=0.0)
    score: float = Field(ge=0.0, le=1.0)
    provenance: Provenance = "measured"


class Element(_Record):
    """A rectangle of one class. `x_px, y_px` is its upper left, `x_m, y_m` its lower left."""

    class_: FacadeClass = Field(alias="class")
    x_px: float
    y_px: float
    width_px: float
    height_px: float
    x_m: float
    y_m: float
    width_m: float
    height_m: float
    score: float = Field(ge=0.0, le=1.0)
    outline_px: list[tuple[float, float]] | None = Field(
        default=None,
        description="its shape where that is no rectangle: corners in order, within the rectangle",
    )
    floor: int | None = Field(default=None, description="0 is the ground floor, None the roof")
    column: int | None = None
    provenance: Provenance = Field(
        default="inferred", description="what the analysis found says measured"
    )
    depth_m: float | None = Field(
        default=None,
        ge=-100.0,
        le=100.0,
        exclude_if=lambda depth: depth is None,
        description="before the wall's surface above 0, behind it below, as a depth map has it",
    )

    passage: bool = Field(
        default=False,
        exclude_if=lambda passage: not passage,
        description="of a door: a way through the house, and no leaf",
    )

    balustrade: bool = Field(
        default=False,
        exclude_if=lambda balustrade: not balustrade,
        description="of a balcony: a rail along the edge of the roof, which nobody stands behind",
    )

    @property
    def is_doubtful(self) -> bool:
        """Whether the photo speaks rather against it. What a person adds is not in doubt."""
        return self.score < SURE_SCORE


class Split(_Record):
    """One rule application: the symbols and sizes (metres) of its right-hand side, in order."""

    symbols: list[str]
    sizes_m: list[float]


class RuleParameters(_Record):
    """The parameters of the five rules (Koutsourakis et al. 2009, equation 2)."""

    building_height_m: float = Field(description="h_b, ground to eaves")
    roof_height_m: float = Field(description="h_l + h_t, eaves to ridge; 0 where none is seen")
    facade: Split = Field(description="split(z; Gf, Fl_1..Fl_m; h_0..h_m)")
    floors: list[Split] = Field(description="split(x; Wa, Win, .., Wa; w'_1, w_1, .., w'_k+1)")


class DerivationNode(_Record):
    """A node of the derivation tree; the scope is in facade metres."""

    symbol: str
    rule: str | None = None
    x_m: float
    y_m: float
    width_m: float
    height_m: float
    children: list[DerivationNode] = []


class EnergyTerm(_Record):
    """What one Markov random field reached: its total and the sum of each of its terms."""

    total: float
    terms: dict[str, float]
    nodes: int
    labels: int


class FacadeDocument(_Record):
    """Everything that was found in one photo."""

    schema_: Literal["veduta/facade"] = Field(default="veduta/facade", alias="schema")
    version: Literal[1] = 1
    source: Source
    rectification: Rectification
    scale: Scale
    facade: FacadeBox
    model: ModelSizes = Field(
        default=ModelSizes(), description="what the model has that no photo shows, in metres"
    )
    wall: Wall | None = Field(
        default=None, description="of an existing building, that the front stands on"
    )
    depths: MeasuredDepths | None = Field(
        default=None,
        exclude_if=lambda depths: depths is None,
        description="what a depth map said of the front",
    )
    classes: list[FacadeClass] = list(CLASSES)
    extents: list[Extent] = Field(description="painted in order, before the elements")
    elements: list[Element] = Field(description="painted in order")
    house: House | None = Field(
        default=None, description="which of the photo's houses it is, where it has several"
    )
    roof: RoofKind = Field(
        default="mansard",
        description="what stands on the eaves; a gable's wall and windows are in the front's plane",
    )
    mouldings: list[Moulding] = Field(
        default=[], description="cornices and courses along the front, from above"
    )
    shutters: list[Shutter] = Field(
        default=[], description="shutters and blinds of the windows, open or closed"
    )
    storeys: int = Field(description="the ground floor and the full floors below the eaves")
    storeys_doubtful: bool = Field(
        default=False, description="whether the floors may be other ones; a note says why"
    )
    rules: RuleParameters
    derivation: DerivationNode
    energy: dict[str, EnergyTerm]
    notes: list[str] = Field(default=[], description="what was assumed or left out, and why")
