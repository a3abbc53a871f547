"""What `veduta carve` can be told."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from veduta.cameras import ScaleOptions
from veduta.run.card import DeviceOptions
from veduta.run.options import Options


class PoseOptions(Options):
    """Where the photos were taken, when nothing beside them says it."""

    turntable: bool = Field(
        False,
        description=(
            "the photos have no cameras: one stood still and the object turned, from each photo to"
            " the next, once round; how far is found from the silhouettes"
        ),
    )
    board: Literal["no", "a4", "a3", "letter"] = Field(
        "no",
        description=(
            "the photos have no cameras, but show a printed board of markers under the object, on"
            " a sheet of this size: poses and metres come from it (--print-board makes one)"
        ),
    )
    ruler_mm: float = Field(
        100.0,
        ge=10.0,
        le=1000.0,
        description="with --board: the length (mm) of its line of 100 mm as it was printed",
    )
    even_turns: bool = Field(
        False,
        description="with --turntable: all turns are the same, and together once round",
    )
    focal_px: float | None = Field(
        None,
        gt=0.0,
        le=1e6,
        description=(
            "with --turntable: the camera's focal length in pixels of the photos; found from EXIF"
            " and the silhouettes where it is not given"
        ),
    )

    @property
    def unposed(self) -> bool:
        """Whether the photos come without cameras."""
        return self.turntable or self.board != "no"


class SilhouetteOptions(Options):
    """Where the object is in the photos."""

    background: Literal["auto", "dark", "bright", "masks"] = Field(
        "auto",
        description=(
            "how the object is told from what is behind it: masks where there are some, else the"
            " colours along the photos' borders (auto); dark or bright: what is behind it is black"
            " or white; masks: they must be there"
        ),
    )


class VolumeOptions(Options):
    """The volume that is carved."""

    levels: int = Field(
        8, ge=5, le=10, description="the octree's depth: 2^levels voxels along the longest side"
    )
    up: Literal["auto", "kept"] = Field(
        "auto",
        description=(
            "turn the object so that the cameras' ring lies level (auto), or keep the frame of the"
            " cameras (kept)"
        ),
    )


class ColourOptions(Options):
    """What the colours of the photos decide."""

    carve: bool = Field(
        True,
        description="carve concavities where the photos' colours disagree on the hull; --no-carve"
        " leaves the hull alone",
    )
    spread: float | None = Field(
        None,
        gt=0.0,
        le=255.0,
        description=(
            "disagreement of colours (grey levels) from which a voxel is carved; found from the"
            " hull's own where it is not given"
        ),
    )


class TextureOptions(Options):
    """How the object is painted."""

    no_texture: bool = Field(
        False, description="give each vertex of the object a colour, in place of a texture"
    )
    max_atlas_px: int = Field(
        4096, ge=256, le=16_384, description="longest side of the object's texture (px)"
    )


class CarveOptions(Options):
    """All that changes the result."""

    poses: PoseOptions = PoseOptions()
    silhouettes: SilhouetteOptions = SilhouetteOptions()
    volume: VolumeOptions = VolumeOptions()
    colour: ColourOptions = ColourOptions()
    texture: TextureOptions = TextureOptions()
    scale: ScaleOptions = ScaleOptions()
    device: DeviceOptions = DeviceOptions()
