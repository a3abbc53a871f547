"""The options of `veduta view`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from pydantic import Field

from veduta.run.options import Options


class ViewOptions(Options):
    """How a place is served."""

    out: Path = Field(description="folder with a place.json, as `veduta facade -o OUT` writes it")
    host: str = Field(
        default="127.0.0.1",
        description="address to listen on; any but this machine's own asks visitors for a token",
    )
    port: Annotated[int, Field(ge=0, le=65535)] = Field(
        default=0, description="port to listen on; 0 takes a free one"
    )
    at: str | None = Field(
        default=None,
        description="a view of the place: the address of a page that shows it, or its part after #",
    )
    no_browser: bool = Field(default=False, description="print the address, open no browser")
