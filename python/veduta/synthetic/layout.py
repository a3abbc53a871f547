"""What a synthetic facade consists of, in facade metres: the plan that the builder follows.

Facade frame: x right along the wall, y up from the ground, origin at the lower left corner.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from veduta.synthetic.panes import WindowLook
from veduta.synthetic.textures import Colour

Style = Literal["haussmann", "terrace", "modern", "stucco"]
STYLES: tuple[Style, ...] = ("haussmann", "terrace", "modern", "stucco")
OpeningClass = Literal["window", "door", "shop"]
WallKind = Literal["ashlar", "brick", "panels", "stucco"]
RoofKind = Literal["mansard", "pitched", "flat"]
RoofCover = Literal["zinc", "slate", "tiles", "gravel"]
RailPattern = Literal["bars", "rings", "crosses", "scrolls"]


@dataclass(frozen=True)
class Rect:
    """A rectangle by its lower left corner and its size (m)."""

    x_m: float
    y_m: float
    width_m: float
    height_m: float

    @property
    def right_m(self) -> float:
        """The right edge (m)."""
        return self.x_m + self.width_m

    @property
    def top_m(self) -> float:
        """The upper edge (m)."""
        return self.y_m + self.height_m


@dataclass(frozen=True)
class Opening:
    """A hole in the wall and what fills it."""

    class_: OpeningClass
    rect: Rect
    floor: int
    column: int
    fanlight_m: float = 0.0
    surround: bool = True
    shutters: bool = False


@dataclass(frozen=True)
class Balcony:
    """A slab with a railing in front of the wall; `rect` is what it covers of the wall."""

    rect: Rect
    depth_m: float
    floor: int
    column: int | None
    pattern: RailPattern


@dataclass(frozen=True)
class Band:
    """A moulding along the whole wall: plinth, string course or cornice."""

    y_m: float
    height_m: float
    projection_m: float
    cornice: bool = False


@dataclass(frozen=True)
class Chimney:
    """A stack on the roof; `y_m` is its foot, `back_m` its distance behind the wall."""

    x_m: float
    y_m: float
    width_m: float
    height_m: float
    back_m: float
    depth_m: float
    pots: int


@dataclass(frozen=True)
class Roof:
    """What stands above the eaves. `rise_m` is eaves to ridge, `run_m` how far back that is."""

    kind: RoofKind
    cover: RoofCover
    rise_m: float
    run_m: float
    overhang_m: float = 0.0
    dormers: tuple[Rect, ...] = ()
    chimneys: tuple[Chimney, ...] = ()


@dataclass(frozen=True)
class Paint:
    """The colours (sRGB, 0..1) and the looks that are shared over the facade."""

    wall: WallKind
    wall_colour: Colour
    trim: Colour
    door: Colour
    shop: Colour
    sign: Colour
    iron: Colour
    shutter: Colour
    roof: Colour
    window: WindowLook
    mortar: Colour = (0.7, 0.68, 0.64)
    panel_m: tuple[float, float] = (1.5, 1.5)


@dataclass(frozen=True)
class Layout:
    """The whole facade. `floors_m` are the storey heights from the ground up to the eaves."""

    style: Style
    width_m: float
    depth_m: float
    floors_m: tuple[float, ...]
    columns: int
    roof: Roof
    paint: Paint
    openings: tuple[Opening, ...]
    balconies: tuple[Balcony, ...] = ()
    bands: tuple[Band, ...] = ()
    setback_m: float = 0.22

    @property
    def height_m(self) -> float:
        """Ground to eaves (m)."""
        return sum(self.floors_m)

    @property
    def storeys(self) -> int:
        """Floors below the eaves, with the ground floor."""
        return len(self.floors_m)


def centred(centre_m: float, base_m: float, width_m: float, height_m: float) -> Rect:
    """A rectangle around a vertical axis, standing on `base_m`."""
    return Rect(centre_m - width_m / 2, base_m, width_m, height_m)


def column_centres(width_m: float, columns: int, margin_m: float) -> tuple[float, ...]:
    """Evenly spaced axes that leave `margin_m` more wall at both ends than half a bay."""
    bay = (width_m - 2 * margin_m) / columns
    return tuple(margin_m + bay * (i + 0.5) for i in range(columns))
