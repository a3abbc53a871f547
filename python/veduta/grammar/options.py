"""The options of `veduta grammar derive`."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from veduta.run.options import Options

MAX_SEED = 2**53 - 1
"""Whole numbers that JSON keeps exactly."""


class DeriveOptions(Options):
    """What changes the buildings of the same rules and lots."""

    seed: Annotated[int, Field(ge=0, le=MAX_SEED)] = Field(
        default=0, description="of all that is random; each lot draws its own from it"
    )
    start: str | None = Field(
        default=None, description="rule to start with; the one with @StartRule if not given"
    )
    seconds: Annotated[float, Field(gt=0.0, le=3600.0)] = Field(
        default=20.0, description="longest time for one lot (s); a lot that takes longer fails"
    )


class OutputOptions(Options):
    """What is written of the buildings."""

    separate: bool = Field(
        default=False,
        description="a GLB for each building in parts/, also for more than 64 lots",
    )
    city: bool = Field(
        default=True,
        description="write CityJSON: city.city.json, or city.city.jsonl for more than 1000 lots;"
        " --no-city leaves it out",
    )


class AttributeOptions(Options):
    """Values of the rule file's attributes for all lots, as the command line has them."""

    values: dict[str, bool | float | str] = Field(
        default={}, description="instead of those in the file, and of those of the lots"
    )


class GrammarOptions(Options):
    """All options of the verb that change its result."""

    derive: DeriveOptions = DeriveOptions()
    output: OutputOptions = OutputOptions()
    attributes: AttributeOptions = AttributeOptions()
