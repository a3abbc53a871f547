"""The animal document: sizes, states and gait, each with where it comes from and how sure it is.

Lengths of the body are shares of `length`, so that one number makes the whole animal larger. Along
the body 0 is the tip of the head and 1 the end of the tail. Angles are those of the axis, towards
the head (`veduta.fauna.motion.angles`).
"""

from __future__ import annotations

from typing import Annotated, Literal, Self

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, model_validator

from veduta.fauna.motion.angles import COEFFICIENTS, Complexes
from veduta.fauna.options import Limbless

Origin = Literal["measured", "inferred", "invented", "edited"]
"""Seen in the footage; follows from it and a rule; in no record; written by a person."""
Finite = Annotated[float, Field(allow_inf_nan=False)]
Share = Annotated[float, Field(ge=0.0, le=1.0)]
State = Annotated[
    list[tuple[Finite, Finite]], Field(min_length=COEFFICIENTS + 1, max_length=COEFFICIENTS + 1)
]


class Record(BaseModel):
    """What all records of a document are: frozen, and without unknown fields."""

    model_config = ConfigDict(frozen=True, extra="forbid", populate_by_name=True)


class Source(Record):
    """The record that it was read from."""

    file: str = Field(max_length=1024)
    sha256: str = Field(max_length=64)
    frames: int = Field(ge=1)
    used: int = Field(ge=1)
    left_out: list[str] = Field(default=[], max_length=100_000, description="frames, and why")
    cut: list[int] = Field(
        default=[],
        max_length=100_000,
        description="numbers of the frames whose border cuts the animal, which was fitted from"
        " what is seen of it there",
    )
    scores: list[tuple[int, Share]] = Field(
        default=[],
        max_length=100_000,
        description="numbers of the frames that show it, and how sure its silhouette is: as large"
        " as in the others, and nothing else beside it",
    )


class Length(Record):
    """From the head's tip along the axis to the tail's end."""

    metres: Annotated[float, Field(gt=0.0, le=1000.0)]
    provenance: Origin
    score: Share = Field(description="1 less the spread between frames, as a share of the length")


class Slice(Record):
    """An ellipse across the axis; all in shares of the length."""

    at: Share
    half_width: Annotated[float, Field(ge=0.0, le=1.0)]
    half_height: Annotated[float, Field(ge=0.0, le=1.0)]


class Body(Record):
    """The part that the animal is made of."""

    slices: list[Slice] = Field(min_length=3, max_length=1000)
    widths: Origin
    heights: Origin
    coat: Literal["coat.png"] | None = Field(
        default=None, description="the texture beside this file; null: one painted by its kind"
    )
    score: Share = Field(description="of the widths, as of the length; 0 where none was measured")

    @model_validator(mode="after")
    def _ascends(self) -> Self:
        places = [piece.at for piece in self.slices]
        if places[0] != 0.0 or places[-1] != 1.0 or (np.diff(places) <= 0.0).any():
            raise ValueError("the slices do not go from 0 to 1")
        return self


class Motion(Record):
    """The states of the axis through the footage."""

    frame_s: Annotated[float, Field(gt=0.0, le=10.0)]
    states: list[State] = Field(
        min_length=2,
        max_length=100_000,
        description="for each frame the Fourier coefficients 0 to 7 of the angles A(s), as pairs",
    )
    frame: list[int] = Field(description="the number of each state's frame, ascending")
    provenance: Origin
    score: Share = Field(description="1 less the mean distance between axis and states, in lengths")
    speed: Annotated[float, Field(gt=0.0, le=100.0)] = Field(description="body lengths a second")
    speed_provenance: Origin

    @model_validator(mode="after")
    def _one_frame_each(self) -> Self:
        if len(self.frame) != len(self.states) or (np.diff(self.frame) <= 0).any():
            raise ValueError("the frames do not ascend, one for each state")
        return self

    def columns(self) -> Complexes:
        """(t, 8) complex128."""
        pairs = np.array(self.states, dtype=np.float64)
        return np.asarray(pairs[..., 0] + 1j * pairs[..., 1], dtype=np.complex128)


class Animal(Record):
    """The document."""

    schema_: Literal["veduta/animal"] = Field(default="veduta/animal", alias="schema")
    version: Literal[1] = 1
    name: str = Field(min_length=1, max_length=256)
    kind: Limbless
    source: Source
    length: Length
    body: Body
    motion: Motion
    doubts: list[str] = Field(default=[], max_length=1000, description="what may be wrong")
