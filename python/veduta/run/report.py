"""What every verb tells about its work: steps, times, measures, and what failed and why."""

from __future__ import annotations

import platform
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field

import veduta
from veduta.run.names import given_names

Count = float | int | str
FailureKind = Literal["input", "not-found", "output", "crash", "bug"]


@dataclass
class StepRecord:
    """One step: its wall time, what it counted, and what it threw away with the reason."""

    name: str
    seconds: float = 0.0
    counts: dict[str, Count] = field(default_factory=dict)
    rejected: list[str] = field(default_factory=list)


@contextmanager
def timed_step(steps: list[StepRecord], name: str) -> Iterator[StepRecord]:
    """Append a record for `name` to `steps` and set its seconds when the block ends."""
    record = StepRecord(name)
    steps.append(record)
    start = time.perf_counter()
    try:
        yield record
    finally:
        record.seconds = time.perf_counter() - start


class _Record(BaseModel):
    model_config = ConfigDict(extra="forbid")


class Failure(_Record):
    """One input that gave no result."""

    subject: str = Field(description="the input, as the user named it")
    kind: FailureKind
    reason: str


class Report(_Record):
    """The content of `report.json`."""

    schema_: Literal["veduta/report"] = Field(default="veduta/report", alias="schema")
    version: Literal[1] = 1
    verb: str
    subject: str = Field(description="what the report is about: an image, or the whole call")
    state: Literal["done", "failed"]
    options: dict[str, Any] = Field(description="the effective options")
    steps: list[StepRecord] = Field(default=[], description="in the order in which they ran")
    measures: dict[str, Any] = Field(default={}, description="what was measured in the result")
    notes: list[str] = Field(default=[], description="what was assumed or left out, and why")
    failures: list[Failure] = []
    versions: dict[str, str] = Field(default_factory=lambda: versions())

    def to_json(self) -> bytes:
        """The report as UTF-8 JSON, ending in a newline."""
        return (given_names(self.model_dump_json(by_alias=True, indent=2)) + "\n").encode()


def versions() -> dict[str, str]:
    """The versions of what took part in making a result."""
    return {"veduta": veduta.__version__, "python": platform.python_version()}


def counted(count: int, thing: str) -> str:
    """`1 window`, `2 windows`."""
    return f"{count} {thing}" if count == 1 else f"{count} {thing}s"
