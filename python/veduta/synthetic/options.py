"""The options of a synthetic facade photo."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from veduta.run.options import Options
from veduta.synthetic.layout import Style

Perspective = Literal["frontal", "mild", "strong"]
Weather = Literal["sunny", "cloudy"]


class SyntheticOptions(Options):
    """What stands in the street, and how it is photographed."""

    style: Style = Field(default="haussmann", description="the kind of building")
    floors: Annotated[int, Field(ge=1, le=20)] | None = Field(
        default=None, description="storeys with the ground floor; drawn from the seed if not given"
    )
    columns: Annotated[int, Field(ge=1, le=20)] | None = Field(
        default=None, description="window axes; drawn from the seed if not given"
    )
    long_side_px: Annotated[int, Field(ge=64, le=8000)] = Field(
        default=1200, description="longer side of the photo (px)"
    )
    perspective: Perspective = Field(
        default="mild", description="how far the camera stands to the side, and how close"
    )
    weather: Weather = Field(default="sunny", description="sun and shadows, or an overcast sky")
    detached: bool = Field(default=False, description="no houses left and right of the facade")
    occluders: bool = Field(default=False, description="a tree, a lamp post and a parked car")
    samples: Annotated[int, Field(ge=1, le=8)] = Field(
        default=2, description="rays per pixel and axis"
    )
    blur_px: Annotated[float, Field(ge=0.0, le=10.0)] = Field(
        default=0.45, description="blur of the lens (px)"
    )
    vignetting: Annotated[float, Field(ge=0.0, le=0.9)] = Field(
        default=0.12, description="share of the light that the corners lose"
    )
    noise: Annotated[float, Field(ge=0.0, le=0.5)] = Field(
        default=0.006, description="sensor noise (share of white)"
    )
    jpeg_quality: Annotated[int, Field(ge=1, le=95)] = Field(
        default=92, description="quality of the photo's JPEG file"
    )
