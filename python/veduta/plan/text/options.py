"""Options of reading text."""

from __future__ import annotations

from pydantic import Field

from veduta.run.options import Options


class TextOptions(Options):
    """How text is looked for and read."""

    overview_px: int = Field(
        default=1600, ge=320, le=4000, description="long side at which the whole sheet is searched"
    )
    enlarge: float = Field(
        default=2.0, ge=1.0, le=4.0, description="by how much a small sheet is enlarged at most"
    )
    tile_px: int = Field(
        default=1280, ge=320, le=2048, description="side of a tile of a large sheet"
    )
    tiles: int = Field(
        default=8, ge=0, le=200, description="how many tiles are searched for small text at most"
    )
    regions: int = Field(
        default=250, ge=1, le=5000, description="how many pieces of text are read at most"
    )
    score: float = Field(
        default=0.5, ge=0.0, le=1.0, description="below this, what was read is dropped"
    )
    threads: int = Field(default=2, ge=1, le=64, description="threads of the recognition")
