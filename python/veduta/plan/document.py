"""The plan document (`plan.json`): what was found in the drawings of a house.

Pixel frame of a storey: its cleaned image (mirrored back, upright), x right, y down, origin at the
upper left corner of the upper left pixel (its centre is at (0.5, 0.5)). Plan frame: metres, x
right and y up on the page; the same for all storeys, `Sheet.origin_px` lies at (0, 0).
"""

from __future__ import annotations

from typing import Annotated, Literal, get_args

from pydantic import AfterValidator, BaseModel, ConfigDict, Field

from veduta.plan.sun import read_time

Origin = Literal["measured", "inferred", "invented", "edited"]
"""Drawn on the plan; follows from what is drawn and a rule; on no record; written by a person."""
WallDrawing = Literal["filled", "hollow", "hatched", "single-line"]
JunctionType = Literal["end", "straight", "L", "T", "X"]
DoorType = Literal[
    "swing", "double", "sliding", "pocket", "folding", "french", "garage", "plain", "unknown"
]
WindowType = Literal["single-line", "double-line", "triple-line", "filled", "bay", "unknown"]
OpeningType = DoorType | WindowType
TYPES_OF: dict[str, tuple[str, ...]] = {
    "door": get_args(DoorType),
    "window": get_args(WindowType),
    "gap": ("plain", "unknown"),
}
"""What an opening of each kind may be."""
RoomUse = Literal[
    "living", "dining", "kitchen", "bedroom", "bathroom", "toilet", "utility", "storage",
    "wardrobe", "hall", "corridor", "stairs", "study", "sauna", "garage", "balcony", "terrace",
    "technical", "other", "unknown",
]  # fmt: skip
FittingKind = Literal[
    "toilet", "basin", "bathtub", "shower", "washer", "hob", "kitchen-sink", "bed"
]
Metres = Annotated[float, Field(ge=0.0, le=10_000.0)]
Score = Annotated[float, Field(ge=0.0, le=1.0)]
Point = tuple[float, float]
Channel = Annotated[int, Field(ge=0, le=255)]
TileCount = Annotated[int, Field(ge=1, le=64)]
Latitude = Annotated[float, Field(ge=-90.0, le=90.0)]
Longitude = Annotated[float, Field(ge=-180.0, le=180.0)]
Panorama = Literal["round", "directions"]


class _Record(BaseModel):
    model_config = ConfigDict(extra="forbid", populate_by_name=True, allow_inf_nan=False)


class Sheet(_Record):
    """The drawing of one storey, and how its cleaned image lies in the file."""

    file: str = Field(description="file name of the drawing")
    sha256: str
    page: int = Field(default=0, ge=0, description="page of a PDF, from 1; 0: a picture")
    width_px: int
    height_px: int
    mirrored: bool = Field(default=False, description="the scan was a mirror image")
    rotation_rad: float = Field(
        default=0.0,
        description=(
            "by which the scan was turned, counter-clockwise, before it was mirrored back"
        ),
    )
    clean_from_scan: list[list[float]] = Field(
        description=(
            "3x3 affine matrix, row major; takes pixels of the file (units of a DXF, y up) to"
            " cleaned pixels"
        )
    )
    origin_px: Point = Field(description="cleaned pixel at (0, 0) of the plan frame")
    metres_per_px: Annotated[float, Field(gt=0.0, le=10.0)]


class ScaleEvidence(_Record):
    """One thing on the sheet that says how large a pixel is."""

    kind: Literal[
        "dimension", "area", "line", "bar", "ratio", "door", "units", "given", "assumed"
    ] = Field(
        description=(
            "sides of a room; its area; a dimension line; a scale bar; 1:N with a resolution;"
            " widths of doors; units of a DXF; --scale; a guess"
        )
    )
    text: str = Field(default="", description="as it was read")
    metres_per_px: float
    sigma: float = Field(gt=0.0, description="standard deviation, as a share of metres_per_px")
    agrees: bool = Field(description="whether it is within what the result allows")


class Scale(_Record):
    """How large a pixel is, by the vote of all evidence."""

    metres_per_px: float
    sigma: float = Field(description="standard deviation, as a share of metres_per_px")
    basis: Literal["evidence", "given", "assumed", "edited"]
    evidence: list[ScaleEvidence] = []


class Junction(_Record):
    """Where the centre lines of walls meet or end."""

    id: str
    at_m: Point
    type: JunctionType


class Wall(_Record):
    """A piece of wall between two junctions. Left and right are those of who goes along it."""

    id: str
    start: str = Field(description="id of a junction")
    end: str
    bulge: float = Field(
        default=0.0,
        description="tan of a quarter of the arc's angle, as in DXF: positive bows to the right",
    )
    thickness_m: Metres
    drawing: WallDrawing
    outer: bool = Field(description="whether one side is outdoors")
    party: bool = Field(
        default=False, description="a neighbour's house is behind it: closed, the roof goes on"
    )
    score: Score
    origin: Origin = "measured"


class Opening(_Record):
    """A door, a window or a gap in a wall."""

    id: str
    wall: str
    kind: Literal["door", "window", "gap"]
    type: OpeningType = "unknown"
    along_m: Metres = Field(description="from the wall's start to the opening, on its centre line")
    width_m: Metres
    sill_m: Metres = 0.0
    height_m: Metres = Field(description="from the sill to the lintel")
    hinge: Literal["start", "end", "both", "none"] = Field(
        default="none", description="the end of the opening at which its leaf hangs"
    )
    swing: Literal["left", "right", "both", "none"] = Field(
        default="none", description="the side of the wall to which it opens"
    )
    score: Score
    origin: Origin = "measured"


class PhotoFile(_Record):
    """A photo of a room, as it was when it was looked at."""

    file: str = Field(description="file name of the photo")
    sha256: str


class WallColour(_Record):
    """What the walls of a room are painted with."""

    srgb: tuple[Channel, Channel, Channel]
    share: Score = Field(
        default=0.0, description="of the photo's pixels, those within 3 steps of the colour"
    )
    photo: PhotoFile | None = None
    origin: Origin = Field(default="edited", description="measured: by a photo")


class Tiling(_Record):
    """Tiles on the floor or the walls of a room; their texture is a picture beside the document."""

    surface: Literal["floor", "wall"]
    picture: Annotated[str, Field(pattern=r"^tiles-[A-Za-z0-9_-]{1,60}\.png$")] = Field(
        description="file beside the document: whole tiles, which continue when it is repeated"
    )
    tiles: tuple[TileCount, TileCount] = Field(
        description="how many the picture shows, to the right and down"
    )
    size_m: tuple[Metres, Metres] = Field(description="width and height of one tile with its joint")
    size_origin: Origin = Field(
        default="edited", description="invented: the likeliest of the sizes that are sold"
    )
    laid: bool = Field(default=True, description="whether the whole surface has them")
    photo: PhotoFile | None = None
    corners_px: list[Point] = Field(
        default=[], description="what the picture shows, in the photo: clockwise from upper left"
    )
    origin: Origin = Field(default="edited", description="measured: by a photo")


class Room(_Record):
    """A closed space. Outlines are inner faces of walls, counter-clockwise, not closed twice."""

    id: Annotated[str, Field(max_length=256)]
    outline_m: list[Point]
    holes_m: list[list[Point]] = []
    area_m2: float
    use: RoomUse
    use_score: Score
    use_origin: Origin = "inferred"
    name: str = Field(default="", description="as it is written on the plan")
    outdoors: bool = False
    open_below: bool = Field(
        default=False, description="it has no floor: one looks down into the storey below"
    )
    walls: list[str] = []
    openings: list[str] = Field(default=[], description="those that lead in or let in light")
    mended: bool = Field(default=False, description="whether a gap was closed to make it a room")
    wall_colour: WallColour | None = Field(default=None, description="null: no photo shows it")
    tilings: list[Tiling] = Field(default=[], description="at most one of each surface")
    score: Score
    origin: Origin = "measured"


class Stairs(_Record):
    """Stairs, as drawn: a straight flight, or treads that turn or share landings."""

    id: str
    outline_m: list[Point]
    treads: Annotated[int, Field(ge=1, le=100)] = Field(description="a landing is one")
    up: Point = Field(
        description="direction in which it rises at its foot, of length 1; (0, 0) if not drawn"
    )
    steps_m: list[list[Point]] = Field(
        default=[],
        description=(
            "outlines of its treads and landings, from the lowest up; empty: a straight flight,"
            " whose outline is cut into `treads` equal parts across `up`"
        ),
    )
    path_m: list[Point] = Field(
        default=[],
        description=(
            "walking line over `steps_m`, from the edge of the lowest to that of the upper floor"
        ),
    )
    score: Score
    origin: Origin = "measured"


class Fitting(_Record):
    """A thing that the plan draws in a room, such as a bath: it is furnished where it is drawn."""

    id: str
    kind: FittingKind
    room: str = Field(description="id of a room")
    at_m: Point = Field(description="middle of its rectangle")
    turn_rad: float = Field(description="of its front from -y of the plan, counter-clockwise")
    size_m: tuple[Metres, Metres] = Field(description="width (along its back), depth")
    score: Score
    origin: Origin = "measured"


class Furniture(_Record):
    """A thing that stands in a room, hangs on its wall, or stands on another thing."""

    id: str
    object: str = Field(description="name of the object in the catalogue")
    room: str = Field(description="id of a room")
    at_m: Point = Field(description="middle of its base")
    turn_rad: float = Field(
        default=0.0, description="of its front from -y of the plan, counter-clockwise"
    )
    size_m: tuple[Metres, Metres, Metres] = Field(
        description="width (along its back), depth (from back to front), height"
    )
    above_m: Metres = Field(default=0.0, description="from the floor to its base")
    on: str | None = Field(default=None, description="id of the thing that it stands on")
    origin: Origin = "invented"


class Light(_Record):
    """A lamp; it shines from `at_m` and `above_m`."""

    id: str
    kind: Literal["ceiling", "wall", "floor", "table"]
    room: str = Field(description="id of a room")
    at_m: Point
    above_m: Metres = Field(description="from the floor to where it shines from")
    lumen: Annotated[float, Field(gt=0.0, le=100_000.0)]
    thing: str | None = Field(
        default=None, description="id of the furniture that is this lamp: it shines from there"
    )
    origin: Origin = "invented"


class Text(_Record):
    """A piece of text on the sheet."""

    text: str
    box_px: list[Point] = Field(description="its four corners, from the upper left, clockwise")
    score: Score


class Storey(_Record):
    """One floor of the house."""

    name: str
    elevation_m: float
    height_m: Metres = Field(description="from its floor to the next one's")
    sheet: Sheet
    scale: Scale
    junctions: list[Junction]
    walls: list[Wall]
    openings: list[Opening]
    rooms: list[Room]
    stairs: list[Stairs] = []
    fittings: list[Fitting] = Field(default=[], description="what is drawn in the rooms")
    furniture: list[Furniture] | None = Field(
        default=None, description="null: not furnished yet; [] is left empty"
    )
    lights: list[Light] | None = Field(
        default=None, description="null: not lit yet; [] is left dark"
    )
    texts: list[Text] = []
    notes: list[str] = Field(default=[], description="what was assumed, mended or left out")
    doubts: list[str] = Field(
        default=[], description="what of it must be known before the house is trusted"
    )


def _checked_time(text: str) -> str:
    read_time(text)
    return text


class PlanDocument(_Record):
    """Everything that was found in the drawings of one house."""

    schema_: Literal["veduta/plan"] = Field(default="veduta/plan", alias="schema")
    version: Literal[1] = 1
    flat: bool = Field(
        default=False, description="a flat in a larger house: no roof of its own, no garden"
    )
    north_deg: Annotated[float, Field(ge=0.0, le=360.0)] | None = Field(
        default=None,
        description="where north is on the page, clockwise from up; null: not known, up is taken",
    )
    place_deg: tuple[Latitude, Longitude] | None = Field(
        default=None, description="latitude and longitude, north and east positive (WGS 84)"
    )
    time: Annotated[str, AfterValidator(_checked_time)] | None = Field(
        default=None,
        description=(
            "when it is looked at, ISO 8601; without an offset by the clock of the longitude's zone"
        ),
    )
    panorama: Panorama | None = Field(
        default=None,
        description=(
            "the picture around the house, beside this file. round: panorama.jpg, its middle is"
            " north; directions: panorama-north.jpg, -east, -south and -west"
        ),
    )
    storeys: list[Storey]
    notes: list[str] = []
