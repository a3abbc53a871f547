"""What `walk.json` says."""

from __future__ import annotations

import re
from typing import Annotated, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator

VERSION = 1
Finite = Annotated[float, Field(allow_inf_nan=False)]
Matrix = Annotated[tuple[Finite, ...], Field(min_length=16, max_length=16)]
MODEL = re.compile(r"walk/[A-Za-z0-9_-]{1,100}\.glb")
Kind = Literal["morph", "fade", "cut"]


class _Record(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", populate_by_name=True)


class RigRecord(_Record):
    """The rectified rig. Pixel centres at (0.5, 0.5)."""

    width_px: int = Field(gt=0)
    height_px: int = Field(gt=0)
    focal_px: tuple[Finite, Finite]
    centre_px: tuple[Finite, Finite]
    centre_right_px: Finite
    baseline_m: Finite = Field(gt=0.0)


class ViewRecord(_Record):
    """One of several views of a key position."""

    id: str
    left: str
    right: str
    turn: Annotated[tuple[Finite, ...], Field(min_length=9, max_length=9)] | None = Field(
        description="front view from this one, 3x3 by rows; null: it was left out"
    )


class KeyRecord(_Record):
    """A key position: its pictures, and where the left camera was (world frame, z up)."""

    id: str = Field(min_length=1, max_length=256)
    left: str
    right: str
    transform: Matrix = Field(description="world_from_camera, 4x4, column-major, metres")
    gain: tuple[Finite, Finite, Finite] = Field(
        default=(1.0, 1.0, 1.0), description="by which the picture's channels were levelled"
    )
    views: tuple[ViewRecord, ...] = ()
    water: Finite = Field(default=0.0, description="share of the picture that shows still water")
    grass: Finite = Field(default=0.0, description="share of the picture that shows grass")


class TransitionRecord(_Record):
    """From one key position to another. kind and why may be edited."""

    start: str
    end: str
    kind: Kind
    why: str = ""
    distance_m: Finite | None = None
    residual_px: Finite | None = Field(default=None, description="of the pose (root mean square)")
    matches: int = 0
    psi: Finite | None = Field(default=None, description="share of the start's picture in Psi")
    score_db: Finite | None = Field(default=None, description="of the end's view as predicted")
    unmoved_db: Finite | None = Field(default=None, description="of the start's picture as it is")
    moving: Finite = Field(
        default=0.0, description="share of the start's picture that is elsewhere in the end's"
    )
    energy: Finite | None = None
    energy_icm: Finite | None = None
    energy_bound: Finite | None = None
    forth: str | None = Field(
        default=None, description="file of the start's model, if there is one"
    )
    back: str | None = Field(default=None, description="file of the end's model")

    @model_validator(mode="after")
    def _models_are_inside(self) -> Self:
        for name in (self.forth, self.back):
            if name is not None and not MODEL.fullmatch(name):
                raise ValueError(f"{name!r} is no model of this walk")
        return self


class WalkDocument(_Record):
    """The document of a walk."""

    schema_: Literal["veduta/walk"] = Field(default="veduta/walk", alias="schema")
    version: Literal[1] = 1
    scale: Literal["metres", "unknown"] = Field(
        default="metres", description="unknown: neighbouring frames count as 1 m apart"
    )
    rig: RigRecord
    keys: list[KeyRecord] = Field(min_length=1, max_length=20_000)
    transitions: list[TransitionRecord] = Field(max_length=100_000)

    @model_validator(mode="after")
    def _ends_are_there(self) -> Self:
        known = {key.id for key in self.keys}
        for one in self.transitions:
            for end in (one.start, one.end):
                if end not in known:
                    raise ValueError(f"a transition names {end!r}, which is no key position")
        return self
