"""The options of `veduta photos`."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from veduta.run.options import Options

Pairing = Literal["all", "sequence", "gps"]
Lens = Literal["pinhole", "simple-radial", "radial", "opencv"]
Sharing = Literal["shared", "per-photo"]
PrincipalPoint = Literal["middle", "free"]


class MatchOptions(Options):
    """Which photos are compared with which, and on what."""

    max_side_px: Annotated[int, Field(ge=320, le=8000)] = Field(
        default=2400, description="longest side at which features are looked for (px)"
    )
    max_features: Annotated[int, Field(ge=500, le=50_000)] = Field(
        default=8192, description="features per photo"
    )
    pairs: Literal["auto", "all", "sequence", "gps"] = Field(
        default="auto",
        description=(
            "which photos are compared: all pairs; neighbours in the order of time or name; "
            "those nearest by GPS; auto: all up to 60 photos, then GPS or the sequence"
        ),
    )
    neighbours: Annotated[int, Field(ge=1, le=1000)] = Field(
        default=12, description="photos that each is compared with (sequence: on each side)"
    )


class CameraOptions(Options):
    """What is assumed of the cameras; `auto` lets held-out observations decide."""

    lens: Literal["auto", "pinhole", "simple-radial", "radial", "opencv"] = Field(
        default="auto", description="lens model"
    )
    cameras: Literal["auto", "shared", "per-photo"] = Field(
        default="auto",
        description="whether photos of one size, make and focal length share a camera",
    )
    principal_point: Literal["auto", "middle", "free"] = Field(
        default="auto", description="the middle of the photo, or found with the lens"
    )


class RandomOptions(Options):
    """What is drawn at random."""

    seed: Annotated[int, Field(ge=0, le=2**31 - 1)] = Field(
        default=0, description="the same seed draws the same"
    )


class PhotosOptions(Options):
    """All options of the verb that change its result."""

    match: MatchOptions = MatchOptions()
    camera: CameraOptions = CameraOptions()
    random: RandomOptions = RandomOptions()
