"""How plans are drawn: each style is a row. Some are kept back from development."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from veduta.synthetic.plans.canvas import BLACK, Colour
from veduta.synthetic.plans.house import Language

Split = Literal["development", "unseen"]
WallDrawing = Literal["filled", "hollow", "hatched", "single-line"]
Sizes = Literal["none", "metres", "comma", "feet", "feet-inches", "area", "area-point", "area-feet"]
Leaf = Literal["line", "slab"]
Arc = Literal["quarter", "dashed", "chord", "none"]


@dataclass(frozen=True)
class Style:
    """A manner of drawing. Pens are in pixels of the undegraded sheet."""

    name: str
    split: Split
    language: Language
    walls: WallDrawing = "filled"
    wall_fill: Colour = BLACK
    ink: Colour = BLACK
    paper: Colour = (255, 255, 255)
    floor: Colour | None = None
    outlined: bool = False
    crossed: bool = False
    wall_pen_px: float = 2.0
    pen_px: float = 1.3
    leaf: Leaf = "line"
    arc: Arc = "quarter"
    hinge_on_face: bool = True
    gap_lines: bool = False
    sizes: Sizes = "none"
    dimension_lines: bool = False
    scale_bar: bool = False
    ratio: bool = False
    title: bool = False
    furniture: float = 0.0
    tiles: bool = False
    font: str = "sans"
    weight: int = 400
    capitals: bool = False
    px_per_m: tuple[float, float] = (70.0, 110.0)

    @property
    def many_languages(self) -> bool:
        """Whether it is drawn in other countries too: feet are read in English alone."""
        return not self.sizes.startswith("feet")


STYLES: tuple[Style, ...] = (
    Style("plain", "development", "en", sizes="metres"),
    Style("agent", "development", "en", sizes="feet-inches", furniture=0.8, title=True, weight=600,
          floor=(250, 246, 236), px_per_m=(45.0, 80.0)),
    Style("finnish", "development", "fi", sizes="area", furniture=1.0, arc="quarter", font="uni",
          px_per_m=(60.0, 100.0), hinge_on_face=False),
    Style("hollow", "development", "pt", walls="hollow", sizes="comma", dimension_lines=True,
          furniture=0.6, tiles=True, capitals=True, wall_pen_px=1.8),
    Style("hatched", "development", "de", walls="hatched", outlined=True, sizes="area",
          dimension_lines=True, ratio=True, furniture=0.5, leaf="slab", font="italic"),
    Style("grey", "development", "fr", wall_fill=(130, 130, 130), outlined=True, sizes="area",
          scale_bar=True, furniture=0.7, arc="dashed", leaf="slab"),
    Style("single", "development", "en", walls="single-line", wall_pen_px=4.5, sizes="feet",
          title=True, arc="quarter"),
    Style("blue", "development", "en", wall_fill=(0, 84, 158), ink=(0, 84, 158), arc="none",
          floor=(224, 242, 254), sizes="feet-inches", gap_lines=True, weight=700, capitals=True),
    Style("cross-hatched", "unseen", "fr", walls="hatched", crossed=True, outlined=True,
          sizes="metres", furniture=0.8, font="italic", arc="chord", scale_bar=True),
    Style("blueprint", "unseen", "en", walls="hollow", ink=(235, 240, 250), paper=(28, 66, 128),
          wall_fill=(28, 66, 128), sizes="metres", dimension_lines=True, furniture=0.5,
          capitals=True, wall_pen_px=2.2),
    Style("pale", "unseen", "de", wall_fill=(205, 198, 186), outlined=True, sizes="area",
          furniture=1.0, tiles=True, leaf="slab", arc="quarter", floor=(247, 243, 232), title=True),
    Style("heavy", "unseen", "pt", sizes="area-point", weight=800, furniture=0.9, leaf="slab",
          wall_pen_px=3.0, pen_px=2.2, scale_bar=True, dimension_lines=True, px_per_m=(50.0, 70.0)),
)  # fmt: skip
BY_NAME = {style.name: style for style in STYLES}
