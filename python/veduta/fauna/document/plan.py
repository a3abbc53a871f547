"""Body plans: which parts an animal has, where their joints lie at rest, which touch the ground."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Annotated, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

from veduta.run.errors import InputError
from veduta.run.faults import first_fault
from veduta.run.inputs import require_file

PLANS = Path(__file__).parent / "plans"
_MOST_BYTES = 1_000_000
_REMEDY = "Write it as docs/fauna.md says; veduta/fauna/document/plans has two to begin with."
Point = tuple[
    Annotated[float, Field(ge=-4.0, le=4.0)],
    Annotated[float, Field(ge=-4.0, le=4.0)],
]
Side = Literal["middle", "left", "right"]


class Part(BaseModel):
    """A chain of joints whose slices are ellipses; in shares of the animal's length.

    Its first joint is where it begins (`start`; of the body, the first of its points).
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    name: str = Field(pattern=r"^[a-z][a-z0-9_]{0,40}$")
    on: str | None = Field(default=None, description="the joint that it hangs on; the body: none")
    sides: bool = Field(default=False, description="whether there is one on either side")
    beside: float = Field(default=0.0, ge=0.0, le=1.0, description="from the middle, across")
    ground: bool = Field(default=False, description="whether its end touches the ground")
    swings: bool = Field(default=False, description="whether it swings, as a tail does")
    optional: bool = Field(default=False, description="kept only where silhouettes show it")
    joints: list[str] = Field(min_length=1, max_length=40)
    points: list[Point] = Field(min_length=1, max_length=40)
    start: Point | None = None
    deep: list[Annotated[float, Field(gt=0.0, le=1.0)]] = Field(min_length=2, max_length=41)
    round: float = Field(default=1.0, gt=0.0, le=4.0, description="width for the thickness")
    stiff: float = Field(default=1.0, gt=0.0, le=100.0, description="how little it bends")

    @model_validator(mode="after")
    def _one_each(self) -> Self:
        if len(self.points) != len(self.joints):
            raise ValueError(f"part {self.name!r} has not one point for each joint")
        begins = len(self.joints) + (self.on is not None)
        if len(self.deep) != begins:
            raise ValueError(f"part {self.name!r} needs {begins} numbers in `deep`")
        if (self.start is None) != (self.on is None):
            raise ValueError(
                f"part {self.name!r} needs both `on` and `start`, or, as body, neither"
            )
        return self


class BodyPlan(BaseModel):
    """The parts of an animal, the body first."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    name: str = Field(min_length=1, max_length=64)
    view: Literal["side", "top"]
    parts: list[Part] = Field(min_length=1, max_length=40)

    @model_validator(mode="after")
    def _hangs_together(self) -> Self:
        if self.parts[0].on is not None or len(self.parts[0].joints) < 2:
            raise ValueError("the first part is the body: two joints at least, and no `on`")
        known: set[str] = set(self.parts[0].joints)
        for part in self.parts[1:]:
            if part.on is None or part.on not in known:
                raise ValueError(
                    f"part {part.name!r} hangs on {part.on!r}, which no part before it has"
                )
            if known & set(part.joints):
                raise ValueError(f"part {part.name!r} has a joint that another has, too")
            if not part.sides:
                known |= set(part.joints)
        if len({part.name for part in self.parts}) != len(self.parts):
            raise ValueError("two parts have the same name")
        return self


def load_plan(name: str, own: Path | None = None) -> BodyPlan:
    """The plan of a kind, or a user's own; InputError names what is wrong in it."""
    path = own or PLANS / f"{name}.toml"
    try:
        require_file(path, _MOST_BYTES)
        return BodyPlan.model_validate(tomllib.loads(path.read_text(encoding="utf-8")))
    except OSError as error:
        raise InputError(path, f"cannot be read ({error.strerror})", _REMEDY) from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise InputError(path, f"is no TOML: {error}", _REMEDY) from error
    except ValidationError as error:
        raise InputError(
            path, f"is no body plan: {first_fault(error, 'the plan')}", _REMEDY
        ) from error
