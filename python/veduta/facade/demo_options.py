"""What `veduta demo` may be told of its street."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from veduta.run.options import Options


class DemoOptions(Options):
    """Which street is made, and what its photographer is taken to know about it."""

    seed: Annotated[int, Field(ge=0, lt=2**31)] = Field(
        default=2, description="another seed is another house, street and light"
    )
    corners: bool = Field(
        default=False,
        description="name the wall's corners in the photo, to a pixel, with `--corners`",
    )
    unmeasured: bool = Field(
        default=False,
        description="leave out `--height-m` (the wall's height to 0.1 m): a storey is then 3.0 m",
    )
