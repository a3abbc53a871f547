"""The options of `veduta grammar derive`, `sample` and `tree`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field

from veduta import _core
from veduta.run.options import Options

MAX_SEED = 2**53 - 1
"""Whole numbers that JSON keeps exactly."""


class DeriveOptions(Options):
    """What changes the buildings of the same rules and lots."""

    seed: Annotated[int, Field(ge=0, le=MAX_SEED)] = Field(
        default=0, description="of all that is random; each lot draws its own from it"
    )
    start: str | None = Field(
        default=None,
        description="rule to start with, with its arguments if it takes any: `Lot(9)`;"
        " the one with @StartRule if not given",
    )
    style: str | None = Field(
        default=None, description="style of the rule file to derive in; `Default` if not given"
    )


class LimitOptions(Options):
    """What the derivation of one lot may cost; a lot that needs more fails, and says of what."""

    seconds: Annotated[float, Field(gt=0.0, le=3600.0)] = Field(
        default=20.0, description="longest time for one lot (s); a lot that takes longer fails"
    )
    max_depth: Annotated[int, Field(ge=1, le=1_000_000)] = Field(
        default=1_000, description="rules applied one within another"
    )
    max_shapes: Annotated[int, Field(ge=1, le=100_000_000)] = Field(
        default=500_000, description="shapes of one lot, those that become others counted too"
    )
    max_faces: Annotated[int, Field(ge=1, le=100_000_000)] = Field(
        default=1_000_000, description="faces of one shape"
    )
    max_parts: Annotated[int, Field(ge=1, le=10_000_000)] = Field(
        default=100_000, description="parts of one split, points of one scatter"
    )
    max_work: Annotated[int, Field(ge=1, le=10**15)] = Field(
        default=30_000_000_000,
        description="steps of work for one lot: looks at a pair of faces, edges or corners;"
        " other than the time, they are the same on each machine",
    )
    max_memory: Annotated[int, Field(ge=1, le=2**20)] = Field(
        default=4096, description="faces, values and messages of one lot (MiB)"
    )

    @property
    def core(self) -> _core.GrammarLimits:
        """As the engine takes them."""
        return _core.GrammarLimits(
            depth=self.max_depth,
            shapes=self.max_shapes,
            faces=self.max_faces,
            parts=self.max_parts,
            seconds=self.seconds,
            work=self.max_work,
            memory=self.max_memory * 2**20,
        )


class LotOptions(Options):
    """How a file of lots is read."""

    layer: str | None = Field(
        default=None,
        description="layer of a file with several; its only layer of polygons if not given",
    )
    crs: str | None = Field(
        default=None,
        description="CRS of the file, such as EPSG:2154: instead of what it says itself",
    )
    up: Literal["y", "z"] = Field(
        default="y", description="the axis of an OBJ file that points up; with y, -z is north"
    )
    roads: Path | None = Field(
        default=None,
        description="file of road lines, which say where the fronts of lots are; those in the file"
        " of lots count, too",
    )
    terrain: Path | None = Field(
        default=None, description="GeoTIFF of heights that the lots stand on, in their CRS"
    )
    ground: Literal["lowest", "mean"] = Field(
        default="lowest",
        description="where a lot stands on the terrain: at its lowest place, or at the mean",
    )


class SampleOptions(Options):
    """What the sheet shows."""

    colours: Literal["classes", "real", "both"] = Field(
        default="classes", description="a colour for each class, those of the rules, or both"
    )
    columns: Annotated[int, Field(ge=1, le=12)] | None = Field(
        default=None, description="buildings in a row; about as many as rows if not given"
    )
    width: Annotated[int, Field(ge=120, le=1600)] = Field(
        default=400, description="width of one picture (px)"
    )
    rays: Annotated[int, Field(ge=1, le=6)] = Field(
        default=2, description="rays for a pixel along each side; more are smoother and slower"
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


class NameOptions(Options):
    """What the file of lots calls the attributes of the rules, as the command line has it."""

    values: dict[str, str] = Field(default={}, description="a property for each attribute")


class GrammarOptions(Options):
    """All options of the verb that change its result."""

    derive: DeriveOptions = DeriveOptions()
    limits: LimitOptions = LimitOptions()
    lots: LotOptions = LotOptions()
    output: OutputOptions = OutputOptions()
    attributes: AttributeOptions = AttributeOptions()
    names: NameOptions = NameOptions()

    def with_seed(self, seed: int) -> GrammarOptions:
        """The same with another seed."""
        return self._deriving(seed=seed)

    def starting_with(self, start: str | None) -> GrammarOptions:
        """The same with another start rule."""
        return self._deriving(start=start)

    def _deriving(self, **changed: int | str | None) -> GrammarOptions:
        return self.model_copy(update={"derive": self.derive.model_copy(update=changed)})
