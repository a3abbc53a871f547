"""What is read of an options model for messages and tables."""

from __future__ import annotations

from pydantic import Field

from veduta.run.options import Options, declared_options


class Sizes(Options):
    """One option of each form."""

    side_px: int = Field(default=5, ge=2, description="longest side (px)")
    height_m: float | None = Field(default=None, gt=0, description="height (m)")
    corner: tuple[float, float] | None = Field(default=None, description="corner: x y")
    bare: str


def test_every_field_with_the_value_that_it_takes() -> None:
    side, height, corner, bare = declared_options(Sizes)
    assert [option.flag for option in (side, height)] == ["--side-px", "--height-m"]
    assert (side.default, side.description) == (5, "longest side (px)")
    assert (side.value["type"], side.value["minimum"]) == ("integer", 2)
    assert (height.default, height.value) == (None, {"type": "number", "exclusiveMinimum": 0})
    assert (corner.value["type"], corner.value["minItems"]) == ("array", 2)
    assert (bare.default, bare.description, bare.value["type"]) == (None, "", "string")
