"""The document of an animal with limbs: its own body plan, its gaits, and its poses in the footage.

All lengths are shares of `length`. The plan's points are those of the animal as it stands: forwards
from its hips, up from the ground. Angles are turns of a segment against the one that it hangs on,
from how it stands; a segment is called by its limb and its number from the body, such as
`front_leg_left_0`.
"""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from veduta.fauna.document.plan import BodyPlan
from veduta.fauna.document.schema import Finite, Length, Origin, Record, Share, Source

Turn = Annotated[float, Field(ge=-7.0, le=7.0)]


class Swing(Record):
    """A segment's turn through a cycle: the sum of cos[k] cos(2 pi (k + 1) phase) and so the sines,
    never beyond low and high, the bounds of the footage.
    """

    segment: str = Field(max_length=64)
    cos: list[Turn] = Field(max_length=16)
    sin: list[Turn] = Field(max_length=16)
    low: Turn
    high: Turn

    @model_validator(mode="after")
    def _as_many(self) -> Self:
        if len(self.cos) != len(self.sin) or self.low > self.high:
            raise ValueError("sines and cosines are not as many, or `low` is above `high`")
        return self


class Step(Record):
    """When a foot stands: it comes down at the phase `down` and goes up at `up` (figure 13)."""

    limb: str = Field(max_length=64)
    down: Share
    up: Share


class LimbedGait(Record):
    """A cycle of steps that the footage holds."""

    name: str = Field(min_length=1, max_length=64)
    cycle_s: Annotated[float, Field(gt=0.0, le=60.0)]
    stride: Annotated[float, Field(ge=0.0, le=100.0)] = Field(description="lengths in a cycle")
    swings: list[Swing] = Field(max_length=400)
    rise: Swing = Field(description="how the root goes up and down, in lengths")
    feet: list[Step] = Field(max_length=40)
    provenance: Origin
    score: Share = Field(description="how well silhouettes repeat after half a cycle")


class Poses(Record):
    """The footage, frame by frame: turns of all segments, and where the root is."""

    frame_s: Annotated[float, Field(gt=0.0, le=10.0)]
    frame: list[int] = Field(max_length=100_000)
    segments: list[str] = Field(max_length=400)
    turns: list[list[Turn]] = Field(max_length=100_000)
    root: list[tuple[Finite, Finite]] = Field(
        max_length=100_000, description="forwards from its mean, and up from the ground, in lengths"
    )
    feet: list[str] = Field(max_length=40)
    down: list[list[Literal[0, 1]]] = Field(
        max_length=100_000, description="a row for each frame: which feet stand"
    )

    @model_validator(mode="after")
    def _rows_belong_together(self) -> Self:
        count = len(self.frame)
        if {len(self.turns), len(self.root), len(self.down)} != {count}:
            raise ValueError("turns, root and down have not one row for each frame")
        wide = {len(row) for row in self.turns} | {len(row) for row in self.down}
        if wide - {len(self.segments), len(self.feet)}:
            raise ValueError("a row has not one number for each segment or foot")
        return self


class LimbedAnimal(Record):
    """The document."""

    schema_: Literal["veduta/limbed-animal"] = Field(default="veduta/limbed-animal", alias="schema")
    version: Literal[1] = 1
    name: str = Field(min_length=1, max_length=256)
    kind: str = Field(min_length=1, max_length=64)
    source: Source
    length: Length
    plan: BodyPlan
    seen: Literal["left", "right", "above"] = Field(description="from where it was seen")
    shape: Origin
    widths: Origin = Field(description="across the plane that was seen")
    shape_score: Share = Field(description="the median overlap with the silhouettes (IoU)")
    missing: list[str] = Field(default=[], description="parts of its kind that were not seen")
    coat: Literal["coat.png"] | None = None
    gaits: list[LimbedGait] = Field(max_length=20)
    poses: Poses
    doubts: list[str] = Field(default=[], max_length=1000)
