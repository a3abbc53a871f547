"""What a place is called and by whom it is, as somebody gives it who publishes it."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from veduta.run.options import Options

Line = Annotated[str, Field(min_length=1, max_length=10_000)]


class AboutOptions(Options):
    """The words of a place; what is not given stays as `place.json` has it."""

    title: Line | None = Field(default=None, description="what the place is called")
    description: Line | None = Field(
        default=None, description="what it shows, in a sentence or a few"
    )
    author: Line | None = Field(default=None, description="who made it")
    licence: Line | None = Field(
        default=None, description="an SPDX expression such as CC-BY-4.0, or plain words"
    )

    def given(self) -> dict[str, str]:
        """Those that are given, by the fields of the place."""
        return {name: words for name, words in self if words is not None}
