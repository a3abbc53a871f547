"""The options of `veduta dense`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field

from veduta.cameras import ScaleOptions
from veduta.run.card import DeviceOptions
from veduta.run.options import Options

Box = tuple[float, float, float, float, float, float]


class ViewOptions(Options):
    """Which photos are compared, and how large."""

    neighbours: Annotated[int, Field(ge=1, le=12)] = Field(
        default=4, description="photos that each is compared with"
    )
    max_memory: Annotated[float, Field(ge=0.5, le=512.0)] = Field(
        default=4.0, description="memory that may be taken (GB); photos are reduced to fit"
    )
    max_side_px: Annotated[int, Field(ge=160, le=8192)] = Field(
        default=1600, description="longest side of a depth map (px)"
    )
    box: Box | None = Field(
        default=None,
        description="the region that is wanted: xmin ymin zmin xmax ymax zmax, as the cameras",
    )


class DepthOptions(Options):
    """How depths are found."""

    method: Literal["patchmatch", "linking"] = Field(
        default="patchmatch",
        description=(
            "planes that several photos confirm (patchmatch); or disparities of photos in a row,"
            " linked along the sequence (linking: the thesis's way, faster and rougher)"
        ),
    )
    agree: Annotated[int, Field(ge=1, le=8)] = Field(
        default=2,
        description="other photos that must show a depth, too (1 where there are only two)",
    )


class SurfaceOptions(Options):
    """How the cloud and the mesh are made."""

    no_mesh: bool = Field(default=False, description="stop at the cloud")
    voxel_m: Annotated[float, Field(gt=0.0, le=100.0)] | None = Field(
        default=None, description="side of a voxel (m); as fine as the depth maps if not given"
    )
    max_triangles: Annotated[int, Field(ge=1000, le=20_000_000)] = Field(
        default=400_000, description="triangles of the mesh at most; it is simplified to them"
    )
    single_view: str | None = Field(
        default=None,
        description=(
            "the mesh of one photo alone, by its name, in place of that of all (the thesis's way):"
            " its depths triangulated in the picture"
        ),
    )
    no_texture: bool = Field(
        default=False, description="give each vertex of the mesh a colour, in place of a texture"
    )
    max_atlas_px: Annotated[int, Field(ge=256, le=16_383)] = Field(
        default=4096, description="longest side of the mesh's texture (px)"
    )
    tiles: bool = Field(
        default=False,
        description=(
            "the mesh in levels of detail, too (3D Tiles): the studio fetches what it needs of it"
        ),
    )


class ModelOptions(Options):
    """What the cloud is held against."""

    model: Path | None = Field(
        default=None,
        description=(
            "a city model (CityJSON) that the cloud is held against, where the cameras lie in a"
            " coordinate system of the earth: `veduta photos --model`"
        ),
    )
    model_reach_m: Annotated[float, Field(gt=0.0, le=100.0)] = Field(
        default=2.0, description="points farther from the city model are not compared with it (m)"
    )


class FormatOptions(Options):
    """What is written beside the result."""

    colmap: bool = Field(
        default=False,
        description=(
            "a workspace of COLMAP, too: photos, cameras, maps of depths and normals, and the cloud"
        ),
    )


class RandomOptions(Options):
    """What is drawn at random."""

    seed: Annotated[int, Field(ge=0, le=2**31 - 1)] = Field(
        default=0, description="the same seed draws the same"
    )


class DenseOptions(Options):
    """All options of the verb that change its result."""

    views: ViewOptions = ViewOptions()
    depth: DepthOptions = DepthOptions()
    surface: SurfaceOptions = SurfaceOptions()
    city: ModelOptions = ModelOptions()
    formats: FormatOptions = FormatOptions()
    random: RandomOptions = RandomOptions()
    scale: ScaleOptions = ScaleOptions()
    device: DeviceOptions = DeviceOptions()
