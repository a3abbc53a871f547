"""The options of `veduta drive`."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from veduta.run.options import Options


class ColumnOptions(Options):
    """How full scans are cut into virtual vertical ones."""

    column_spacing_m: Annotated[float, Field(ge=0.03, le=1.0)] = Field(
        default=0.12, description="spacing of the virtual vertical scans along the path (m)"
    )
    row_step_deg: Annotated[float, Field(ge=0.1, le=2.0)] = Field(
        default=0.4, description="angle between two points of a virtual vertical scan (degrees)"
    )
    reach_m: Annotated[float, Field(ge=0.0, le=80.0)] = Field(
        default=40.0,
        description="how far beyond the ends of the path full scans are used (m)",
    )
    farthest_m: Annotated[float, Field(ge=5.0, le=80.0)] = Field(
        default=25.0, description="facades are looked for so far to the sides of the path (m)"
    )


class OtherOptions(Options):
    """What else than the vertical scans fills holes of facades, before they are interpolated."""

    level_scans: bool = Field(
        default=True,
        description="points of the scanner that looks level; --no-level-scans: without",
    )
    stereo: bool = Field(
        default=True, description="points of corners in consecutive images; --no-stereo: without"
    )


class MeshOptions(Options):
    """How fine the meshes are."""

    error_m: Annotated[float, Field(ge=0.0, le=1.0)] = Field(
        default=0.02,
        description="triangles are joined while 95 % of the surface stays within this (m); 0: none",
    )
    tiles: bool = Field(
        default=False,
        description=(
            "each segment in levels of detail, too (3D Tiles): the studio fetches what it needs of"
            " them, and compares nothing with what was scanned"
        ),
    )


class TextureOptions(Options):
    """How the facades are textured."""

    texel_m: Annotated[float, Field(ge=0.005, le=0.5)] = Field(
        default=0.03, description="size of a texel on the facade (m)"
    )
    wall_top_m: Annotated[float, Field(ge=0.0, le=60.0)] = Field(
        default=8.0,
        description=(
            "up to this height over the road a wall goes on above what the scanner saw, to the roof"
            " line in the images (m); 0: it does not"
        ),
    )
    fill: bool = Field(
        default=True,
        description="what no image shows stays grey; else its texture is invented, and marked",
    )
    anonymise: bool = Field(
        default=False,
        description="blur faces and number plates; refused while there is no detector for them",
    )


class DriveOptions(Options):
    """Everything that changes the result."""

    columns: ColumnOptions = Field(default_factory=ColumnOptions)
    others: OtherOptions = Field(default_factory=OtherOptions)
    mesh: MeshOptions = Field(default_factory=MeshOptions)
    texture: TextureOptions = Field(default_factory=TextureOptions)
    seed: Annotated[int, Field(ge=0)] = Field(
        default=1, description="seed of what is drawn at random"
    )
