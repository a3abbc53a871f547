"""`drive.toml`: what a log's scanners and camera are, and where its tables lie."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field

Finite = Annotated[float, Field(allow_inf_nan=False)]
Matrix = Annotated[tuple[Finite, ...], Field(min_length=12, max_length=12)]
Table = Annotated[str, Field(min_length=1, max_length=256, pattern=r"^[^/\\.][^\\]*$")]
_IDENTITY = (1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0)


class _Record(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid")


class Scanner(_Record):
    """A 2D scanner. Beam i points along (cos a, sin a, 0) of its frame, a = first + i * step.

    table: Parquet with `time_s` and `ranges_m` (list of floats; 0 or NaN: nothing came back).
    """

    table: Table
    vehicle_from_scanner: Matrix = Field(
        description="3x4 by rows; the vehicle has x forward, y left, z up"
    )
    first_beam_rad: Finite
    beam_step_rad: Annotated[Finite, Field(gt=0.0, le=0.5)]
    nearest_m: Annotated[Finite, Field(ge=0.0)] = 0.5
    farthest_m: Annotated[Finite, Field(gt=0.0)] = 80.0
    clock_offset_s: Finite = Field(
        default=0.0, description="is added to its times to get those of the path"
    )


class FullScanner(_Record):
    """A scanner that looks all around. table: Parquet with `time_s` and `file` beside it: scans as
    .pcd, .las, .laz or .npy (n, 3), in metres; x forward, y left, z up.
    """

    table: Table
    vehicle_from_scanner: Matrix = Field(
        description="3x4 by rows; the vehicle has x forward, y left, z up and 0 on the road"
    )
    nearest_m: Annotated[Finite, Field(ge=0.0)] = Field(
        default=2.2, description="what is nearer is the vehicle itself"
    )
    farthest_m: Annotated[Finite, Field(gt=0.0)] = 120.0
    clock_offset_s: Finite = Field(
        default=0.0, description="is added to its times to get those of the path"
    )


class CameraMount(_Record):
    """The camera. table: Parquet with `time_s` and `file` (beside drive.toml)."""

    table: Table
    vehicle_from_camera: Matrix = Field(description="3x4 by rows; x right, y down, z forward")
    width_px: int = Field(gt=0, le=100_000)
    height_px: int = Field(gt=0, le=100_000)
    focal_px: tuple[Finite, Finite]
    centre_px: tuple[Finite, Finite]
    clock_offset_s: Finite = 0.0


class PathTable(_Record):
    """Poses that came with the log. table: Parquet with `time_s`, `matrix` (12 floats by rows)."""

    table: Table
    frame: Literal["world_from_vehicle"] = "world_from_vehicle"
    tf: tuple[str, str] | None = Field(
        default=None,
        description="where the table is a topic of transforms (tf): names of the world's frame and"
        " of the vehicle's",
    )


class Surface(_Record):
    """A surface model of the place: GeoTIFF beside drive.toml, or by its path.

    The drive begins at `start`, or at the first of the positions of `gps`, or anywhere in `search`.
    """

    file: str = Field(min_length=1, max_length=4096)
    start: tuple[Finite, Finite] | None = Field(
        default=None, description="x and y where the drive begins (m, CRS of the model)"
    )
    heading_deg: Finite | None = Field(
        default=None, description="to where it begins: degrees from east to north; else any"
    )
    search: tuple[Finite, Finite, Finite, Finite] | None = Field(
        default=None, description="lowest x, y and highest x, y of where it may begin"
    )
    within_m: Annotated[Finite, Field(gt=0.0, le=1000.0)] = Field(
        default=25.0, description="how far off `start` may be"
    )
    within_deg: Annotated[Finite, Field(gt=0.0, le=180.0)] = Field(
        default=30.0, description="how far off `heading_deg` may be"
    )
    sure: bool = Field(
        default=False,
        description="model and start are right: a path that fits elsewhere as well, or lies about"
        " edges and not on them, is not refused",
    )


class Positions(_Record):
    """Positions of a GPS. table: Parquet with `time_s`, `longitude_deg`, `latitude_deg`."""

    table: Table
    clock_offset_s: Finite = 0.0


class Bag(_Record):
    """A ROS 1 bag, a folder of a ROS 2 bag, or an MCAP file. topics: of each table, by its name.

    LaserScan becomes a table of scans, PointCloud2 of full ones; Odometry, PoseStamped or tf of
    poses; NavSatFix of positions; CompressedImage of images.
    """

    file: str = Field(min_length=1, max_length=4096)
    topics: dict[Table, str] = Field(min_length=1, max_length=32)


class DriveLog(_Record):
    """All of `drive.toml`. World: z up, metres from `origin` in `crs`."""

    name: str = Field(default="drive", max_length=256)
    crs: str | None = Field(default=None, description="EPSG:code of the path's coordinates")
    vertical_datum: str | None = Field(
        default=None, max_length=256, description="what the heights of the path count from"
    )
    origin: tuple[Finite, Finite, Finite] = (0.0, 0.0, 0.0)
    vertical: Scanner | None = None
    full: FullScanner | None = None
    horizontal: Scanner | None = None
    camera: CameraMount | None = None
    path: PathTable | None = None
    surface: Surface | None = None
    gps: Positions | None = None
    bag: Bag | None = Field(default=None, description="where the tables are not files")
