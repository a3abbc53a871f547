"""The options of `veduta facade`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field

from veduta.facade.measured_depths import Elevation
from veduta.facade.wall import Wall
from veduta.run.options import Options

Metres = Annotated[float, Field(gt=0)]
Setback = Annotated[float, Field(ge=0.0, le=1.0)]


class RectifyOptions(Options):
    """How the photo becomes a fronto-parallel view."""

    rectified: bool = Field(default=False, description="the image is already fronto-parallel")
    corners: tuple[float, float, float, float, float, float, float, float] | None = Field(
        default=None,
        description=(
            "facade corners in photo pixels: "
            "x y of upper left, upper right, lower right, lower left"
        ),
    )
    focal_mm35: Metres | None = Field(
        default=None, description="35 mm equivalent focal length where EXIF has none (mm)"
    )
    max_side_px: Annotated[int, Field(ge=256, le=8000)] = Field(
        default=2000, description="longest side of the rectified image (px)"
    )


class HouseOptions(Options):
    """How many buildings a photo becomes."""

    houses: Literal["auto", "one"] = Field(
        default="auto",
        description="whether several houses in one photo become several buildings, or one",
    )


class ScaleOptions(Options):
    """How pixels become metres."""

    height_m: Annotated[float, Field(ge=2.0, le=1000.0)] | None = Field(
        default=None, description="ground to eaves (m)"
    )
    storey_m: Annotated[float, Field(ge=2.0, le=8.0)] | None = Field(
        default=None, description="mean storey height (m); assumed 3.0 where nothing is given"
    )
    width_m: Annotated[float, Field(ge=0.5, le=1000.0)] | None = Field(
        default=None, description="width of the front (m), between the sides that are found"
    )

    @property
    def is_given(self) -> bool:
        """Whether something says how large the front is."""
        return any(size is not None for size in (self.height_m, self.storey_m, self.width_m))


Detail = Literal["library", "photo"]


class ModelSizes(Options):
    """Sizes of a building that no photo of its front shows, as the document keeps them."""

    depth_m: Metres = Field(default=10.0, description="depth of the footprint")
    setback_m: Setback = Field(default=0.2, description="how far openings are set back")
    detail: Detail = Field(
        default="library",
        description=(
            "railings, door leaves, dormers, cornices and chimneys: those of the asset library, or"
            " the photo on plain boxes"
        ),
    )


class ModelOptions(Options):
    """How the document becomes a building; what is not given is as the document has it."""

    depth_m: Metres | None = Field(
        default=None,
        description="depth of the footprint (m); 10.0, or what the document has, if not given",
    )
    setback_m: Setback | None = Field(
        default=None,
        description=(
            "how far openings are set back into the wall (m);"
            " 0.2, or what the document has, if not given"
        ),
    )
    detail: Detail | None = Field(
        default=None,
        description=(
            "what railings, door leaves, dormers, cornices and chimneys are made of: things of the"
            " asset library in the photo's colours, or the photo on plain boxes; library, or what"
            " the document has, if not given"
        ),
    )

    def over(self, known: ModelSizes) -> ModelSizes:
        """The sizes that are known, with those that were asked for in their place."""
        return known.model_copy(update=self.model_dump(exclude_none=True))


class OntoOptions(Options):
    """Which wall of an existing building the front is put on."""

    onto: Path | None = Field(
        default=None,
        description=(
            "footprint of an existing building, a file that `veduta grammar` reads lots from, or a"
            " model of it in glTF (.glb): the front is put on one of its walls"
        ),
    )
    edge: Annotated[int, Field(ge=0)] | None = Field(
        default=None,
        description=(
            "the wall: edge of the footprint, counter-clockwise, 0 joins its first two"
            " corners; that on the street, or the longest, if not given"
        ),
    )
    lot: str | None = Field(
        default=None, description="name of the footprint, where the file has several"
    )
    layer: str | None = Field(
        default=None, description="layer of the footprint's file, where it has several of polygons"
    )
    crs: str | None = Field(
        default=None,
        description="CRS of the footprint's file, such as EPSG:2154: instead of what it says",
    )
    up: Literal["y", "z"] = Field(
        default="y", description="the axis of a footprint in OBJ that points up"
    )
    roads: Path | None = Field(
        default=None, description="file of road lines, which say which wall is on the street"
    )
    terrain: Path | None = Field(
        default=None, description="GeoTIFF of heights that the footprint stands on, in its CRS"
    )


class EyesOptions(Options):
    """What looks at the rectified photo."""

    eyes: Literal["learned", "plain"] = Field(
        default="learned",
        description="what finds windows and doors: a trained network, or edges and colours",
    )


class StyleOptions(Options):
    """The style whose rules explain the front."""

    style: str | None = Field(
        default=None,
        description=(
            "a style of `veduta grammar`, or auto for the likeliest of all: its structure is"
            " searched and told in the report"
        ),
    )
    style_steps: Annotated[int, Field(ge=3, le=10_000_000)] = Field(
        default=600, description="steps of the search for the structure of the style"
    )


class DepthOptions(Options):
    """Depths of the front that photos from several sides have measured."""

    depth_map: Path | None = Field(
        default=None,
        description=(
            "walls/ID_depth.tif of `veduta dense` for the photo walls/ID.png of `veduta photos`:"
            " recesses and projections are measured, and the scale is where none is given"
        ),
    )


class FacadeOptions(Options):
    """All options of the verb that change its result."""

    eyes: EyesOptions = EyesOptions()
    rectify: RectifyOptions = RectifyOptions()
    scale: ScaleOptions = ScaleOptions()
    model: ModelOptions = ModelOptions()
    style: StyleOptions = StyleOptions()
    houses: HouseOptions = HouseOptions()
    onto: OntoOptions = OntoOptions()
    wall: Wall | None = None
    depth: DepthOptions = DepthOptions()
    elevation: Elevation | None = None

    def of_photo(self) -> FacadeOptions:
        """The effective options of a photo: nothing is known of its model but what is asked."""
        sizes = self.model.over(ModelSizes())
        return self.model_copy(update={"model": ModelOptions(**sizes.model_dump())})
