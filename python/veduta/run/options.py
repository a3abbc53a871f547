"""The base of all option objects: each option is declared once, here or in a verb."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from pydantic import BaseModel, ConfigDict


class Options(BaseModel):
    """Frozen options; an unknown name is an error.

    Every field has a default (or is required), a range where one applies, and a
    one-line description with its unit. Command line, JSON schema and docs derive from it.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")


@dataclass(frozen=True)
class DeclaredOption:
    """A field of an options model, as its JSON schema has it."""

    name: str
    value: dict[str, Any]
    """The schema of a value that is given; that an option may be left out is not in it."""
    default: Any
    """None where there is none."""
    description: str

    @property
    def flag(self) -> str:
        """The option on the command line."""
        return flag(self.name)


def declared_options(model: type[BaseModel]) -> list[DeclaredOption]:
    """All options of a model, in their order."""
    found = []
    for name, schema in model.model_json_schema()["properties"].items():
        values = [part for part in schema.get("anyOf", [schema]) if part.get("type") != "null"]
        default, description = schema.get("default"), schema.get("description", "")
        found.append(DeclaredOption(name, values[0], default, description))
    return found


def flag(name: str) -> str:
    """What a field is called on the command line."""
    return f"--{name.replace('_', '-')}"
