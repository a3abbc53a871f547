"""Options of the scale."""

from __future__ import annotations

from pydantic import Field

from veduta.run.options import Options


class VoteOptions(Options):
    """What is taken for granted where a sheet says nothing of its scale."""

    door_m: float = Field(
        default=0.85, gt=0.3, le=2.0, description="width of the usual door, wall to wall (m)"
    )
    wall_m: float = Field(
        default=0.3, gt=0.05, le=1.5, description="thickness of the thickest walls (m)"
    )
    sheet_m: float = Field(
        default=12.0, gt=0.5, le=1000.0, description="long side of what is drawn (m)"
    )
    blur_px: float = Field(
        default=0.7, gt=0.0, le=20.0, description="how exactly faces of walls are found (px)"
    )
