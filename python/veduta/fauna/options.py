"""The options of `veduta fauna`."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from veduta.run.options import Options

Limbless = Literal["snake", "worm", "fish"]
Kind = Literal["snake", "worm", "fish", "lizard", "quadruped"]
View = Literal["auto", "top", "side"]


class AnimalOptions(Options):
    """What the animal is."""

    kind: Kind = Field(
        default="snake",
        description=(
            "what kind of animal it is: a snake's tail follows its head, a worm bends where it"
            " will, a fish has a swimmer's wave; a lizard or a quadruped has legs and is fitted to"
            " its silhouettes"
        ),
    )
    view: View = Field(
        default="auto",
        description="from where it is seen; auto: a quadruped from the side, all others from above",
    )
    length_m: float | None = Field(
        default=None,
        gt=0.0,
        le=100.0,
        description="its length from head to tail, m; else that of the record, or an assumed one",
    )

    @property
    def limbless(self) -> Limbless | None:
        """The kind, if it is one that is read by its axis alone."""
        kinds: dict[Kind, Limbless] = {"snake": "snake", "worm": "worm", "fish": "fish"}
        return kinds.get(self.kind)


class FootageOptions(Options):
    """How the footage is read."""

    fps: float | None = Field(
        default=None,
        gt=0.0,
        le=10_000.0,
        description="frames a second; else as the video says, 25 for a folder of frames",
    )
    crop: tuple[int, int, int, int] | None = Field(
        default=None,
        description="left, top, width and height of the piece of the frames that is read, px",
    )
    individual: str | None = Field(
        default=None,
        max_length=256,
        description="which animal of a CSV of joints that has several",
    )
    joints_height: float | None = Field(
        default=None,
        gt=0.0,
        le=100_000.0,
        description="how high the pictures were in which joints were marked, px; else as the"
        " frames",
    )


class MotionOptions(Options):
    """How its motion is made longer than the footage."""

    seconds: float = Field(
        default=12.0, ge=1.0, le=600.0, description="how long the new motion is at least, s"
    )
    states: int = Field(
        default=160, ge=8, le=5000, description="new states that are drawn beside the footage's"
    )
    speed: float | None = Field(
        default=None,
        gt=0.0,
        le=20.0,
        description="how fast it goes, body lengths a second; else as in the footage",
    )
    seed: int = Field(default=0, ge=0, le=2**31, description="of what is drawn at random")


class FaunaOptions(Options):
    """All that changes the result."""

    animal: AnimalOptions = Field(default_factory=AnimalOptions)
    footage: FootageOptions = Field(default_factory=FootageOptions)
    motion: MotionOptions = Field(default_factory=MotionOptions)
