"""The options of `veduta walk`."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from veduta.run.options import Options


class TakeOptions(Options):
    """Which of the pictures make the walk."""

    every: int = Field(default=1, ge=1, le=1000, description="take every n-th key position")
    first: int = Field(default=0, ge=0, description="number of the first key position, from 0")
    count: int | None = Field(default=None, ge=1, description="how many key positions at most")
    links: tuple[str, ...] = Field(
        default=(),
        description="transitions besides those to the next key position, as FROM:TO: where a path"
        " branches or comes back",
    )


class BoardOptions(Options):
    """The board by whose pictures the two cameras are calibrated (--calibrate)."""

    board: str = Field(default="9x6", description="its inner corners, across and down")
    square_m: float = Field(default=0.025, gt=0.0, le=5.0, description="side of a square (m)")
    markers: str = Field(
        default="", description="dictionary of a ChArUco board's markers (4X4_50); empty: none"
    )
    marker_share: float = Field(
        default=0.75, gt=0.1, lt=1.0, description="side of a marker over that of a square"
    )


class PhotoOptions(Options):
    """Of a single camera's frames (--cameras)."""

    largest_px: int = Field(
        default=1000, ge=64, le=8000, description="longest side at which frames are used (px)"
    )


class MorphOptions(Options):
    """How views are matched and become one another."""

    solver: Literal["trws", "icm"] = Field(
        default="trws", description="of the labels: message passing, or iterated conditional modes"
    )
    step_px: int = Field(default=4, ge=2, le=32, description="between the nodes of a mesh (px)")
    least_gain_db: float = Field(
        default=0.7,
        ge=-20.0,
        le=20.0,
        description="a transition that predicts the next view by less than this better than the"
        " unmoved picture does is cross-faded (dB)",
    )


class PlayOptions(Options):
    """How the walk is shown."""

    speed_m_s: float = Field(default=1.4, gt=0.0, le=50.0, description="of the walk (m/s)")
    video: bool = Field(default=False, description="write the walk as a film, too (walk.mp4)")
    quality: int = Field(default=88, ge=1, le=100, description="of the pictures (WebP)")


class WalkOptions(Options):
    """All that changes the result."""

    take: TakeOptions = TakeOptions()
    morph: MorphOptions = MorphOptions()
    play: PlayOptions = PlayOptions()
    board: BoardOptions = BoardOptions()
    photo: PhotoOptions = PhotoOptions()
