"""The base of all option objects: each option is declared once, here or in a verb."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict


class Options(BaseModel):
    """Frozen options; an unknown name is an error.

    Every field has a default (or is required), a range where one applies, and a
    one-line description with its unit. Command line, JSON schema and docs derive from it.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")
