"""The options of `veduta photos`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field

from veduta.run.options import Options

Pairing = Literal["all", "sequence", "gps", "retrieval"]
Lens = Literal["pinhole", "simple-radial", "radial", "opencv", "fisheye", "other"]
Sharing = Literal["shared", "per-photo"]
PrincipalPoint = Literal["middle", "free"]
MapKind = Literal["incremental", "global"]


class MatchOptions(Options):
    """Which photos are compared with which, and on what."""

    max_side_px: Annotated[int, Field(ge=320, le=8000)] = Field(
        default=2400, description="longest side at which features are looked for (px)"
    )
    max_features: Annotated[int, Field(ge=500, le=50_000)] = Field(
        default=8192, description="features per photo"
    )
    pairs: Literal["auto", "all", "sequence", "gps", "retrieval"] = Field(
        default="auto",
        description=(
            "which photos are compared: all pairs; neighbours in the order of time or name; "
            "those nearest by GPS; those most alike; auto: all up to 60 photos, then GPS, "
            "the order of time, or those most alike"
        ),
    )
    neighbours: Annotated[int, Field(ge=1, le=1000)] = Field(
        default=12, description="photos that each is compared with (sequence: on each side)"
    )
    epipolar: Literal["colmap", "lmeds", "magsac"] = Field(
        default="colmap",
        description=(
            "what verifies matches: the estimator of the engine (COLMAP); least median of squares"
            " with an M-estimator; MAGSAC++ of OpenCV"
        ),
    )


class MapOptions(Options):
    """How poses and points are found from the matches."""

    mapping: MapKind = Field(
        default="incremental",
        description=(
            "from a first pair on, photo by photo; or all photos at once, for which the focal"
            " length of each must be in its EXIF"
        ),
    )


class CameraOptions(Options):
    """What is assumed of the cameras; `auto` lets held-out observations decide."""

    lens: Literal["auto", "pinhole", "simple-radial", "radial", "opencv", "fisheye"] = Field(
        default="auto",
        description="lens model; auto tries all but fisheye, whose photos must all be such",
    )
    cameras: Literal["auto", "shared", "per-photo"] = Field(
        default="auto",
        description="whether photos of one size, make and focal length share a camera",
    )
    principal_point: Literal["auto", "middle", "free"] = Field(
        default="auto", description="the middle of the photo, or found with the lens"
    )
    focal_px: Annotated[float, Field(ge=50.0, le=200_000.0)] | None = Field(
        default=None,
        description=(
            "focal length of the camera that took all photos (px), from a calibration: in place of"
            " what EXIF says, and not adjusted"
        ),
    )
    rig: bool = Field(
        default=False,
        description=(
            "the photos were taken by cameras that are fixed to each other: DIR has a folder per"
            " camera, with equal names for what was taken at the same moment"
        ),
    )
    panoramas: bool = Field(
        default=False,
        description=(
            "photos twice as wide as high show all around (equirectangular), also where their XMP"
            " does not say so"
        ),
    )


class VideoOptions(Options):
    """Which frames of a film become photos."""

    video_interval_s: Annotated[float, Field(gt=0.0, le=3600.0)] | None = Field(
        default=None,
        description=(
            "seconds of film that one frame is kept of, the sharpest; by how far the picture moves "
            "if not given"
        ),
    )
    video_frames: Annotated[int, Field(ge=2, le=2000)] = Field(
        default=150, description="frames of a film that are kept at most"
    )


class ModelOptions(Options):
    """Where the place lies in the world, and what says it."""

    model: Path | None = Field(
        default=None,
        description=(
            "city model to lay the photos into: CityJSON, CityGML, OBJ, or outlines with heights"
            " (GeoJSON, GeoPackage)"
        ),
    )
    crs: str | None = Field(
        default=None,
        description="coordinate reference system of the model where it names none: EPSG:25832",
    )
    gcp: Path | None = Field(
        default=None,
        description="ground control points: a line with the CRS, then x y z px py photo [name]",
    )
    positions: Path | None = Field(
        default=None,
        description=(
            "where the photos were taken, in place of GPS: as ODM's geo.txt, a line with the CRS, "
            "then photo x y [z]"
        ),
    )
    georef: Literal["auto", "gps", "gcp", "model", "rough", "off"] = Field(
        default="auto",
        description=(
            "what says where the place lies; auto: control points, else the model, else GPS; "
            "rough: as auto, and a poor place with its deviation where none is believed"
        ),
    )
    model_up: Literal["auto", "y", "z"] = Field(
        default="auto",
        description="the axis of an OBJ model that points up; auto: along which it reaches least",
    )
    height_attribute: str | None = Field(
        default=None, description="attribute of outlines that is their height (m)"
    )
    layer: str | None = Field(
        default=None, description="layer of a GeoPackage; its only layer of polygons if not given"
    )


class WallOptions(Options):
    """Which walls are looked for in the points."""

    no_walls: bool = Field(default=False, description="look for no walls")
    wall_points: Annotated[int, Field(ge=10, le=100_000)] = Field(
        default=40, description="points that a wall must have"
    )
    wall_side_px: Annotated[int, Field(ge=128, le=8192)] = Field(
        default=2048, description="longest side of a wall's picture (px)"
    )


class TextureOptions(Options):
    """How the faces of the city model are textured from the photos."""

    no_texture: bool = Field(
        default=False, description="leave a city model that photos were laid into without textures"
    )
    texel_m: Annotated[float, Field(ge=0.002, le=1.0)] | None = Field(
        default=None,
        description="side of a texel (m); as fine as the photos show each face if not given",
    )
    max_atlas_px: Annotated[int, Field(ge=256, le=16_384)] = Field(
        default=4096, description="longest side of a file of textures (px)"
    )


class RandomOptions(Options):
    """What is drawn at random."""

    seed: Annotated[int, Field(ge=0, le=2**31 - 1)] = Field(
        default=0, description="the same seed draws the same"
    )


class PhotosOptions(Options):
    """All options of the verb that change its result."""

    match: MatchOptions = MatchOptions()
    map: MapOptions = MapOptions()
    camera: CameraOptions = CameraOptions()
    video: VideoOptions = VideoOptions()
    walls: WallOptions = WallOptions()
    world: ModelOptions = ModelOptions()
    texture: TextureOptions = TextureOptions()
    random: RandomOptions = RandomOptions()
