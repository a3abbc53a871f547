"""Where metres come from, and what is said about a facade that cannot have such a size."""

from __future__ import annotations

import pytest

from veduta.facade.document import FacadeBox, Rectification
from veduta.facade.options import ScaleOptions
from veduta.facade.scale import is_possible, metres, require_possible, scale_notes
from veduta.run.errors import InputError, NotFoundError


def box(width_m: float, height_m: float) -> FacadeBox:
    sizes = {"width_px": 400.0, "height_px": 300.0, "width_m": width_m, "height_m": height_m}
    return FacadeBox(x_px=0.0, y_px=0.0, **sizes)


def rectified(aspect: str) -> Rectification:
    return Rectification.model_validate(
        {
            "method": "corners",
            "width_px": 400,
            "height_px": 300,
            "rectified_from_source": [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
            "aspect": aspect,
        }
    )


@pytest.mark.parametrize("size", [(20.0, 15.0), (0.5, 0.5), (1000.0, 1000.0)])
def test_possible(size: tuple[float, float]) -> None:
    require_possible(box(*size), rectified("given"))


@pytest.mark.parametrize("height_m", [0.4, 1001.0])
def test_a_height_is_the_options_fault(height_m: float) -> None:
    assert not is_possible(height_m)
    with pytest.raises(InputError, match=f"{height_m:g} m high") as caught:
        require_possible(box(20.0, height_m), rectified("given"))
    assert caught.value.subject == "--height-m"


@pytest.mark.parametrize("width_m", [0.4, 1001.0])
@pytest.mark.parametrize(
    ("aspect", "remedy"),
    [("given", "as wide"), ("focal-length", "Check .*--focal-mm35"), ("assumed", "Give .*--focal")],
)
def test_a_width_is_that_of_the_proportions(width_m: float, aspect: str, remedy: str) -> None:
    with pytest.raises(NotFoundError, match=remedy) as caught:
        require_possible(box(width_m, 15.0), rectified(aspect))
    assert f"{width_m:.3g} m wide and 15 m high" in caught.value.evidence


def test_a_width_gives_the_scale_where_nothing_else_does() -> None:
    rows, bottom = [100.0, 160.0, 220.0], 300.0
    wide = metres(rows, bottom, ScaleOptions(width_m=12.0), width_px=240.0)
    assert (wide.basis, wide.metres_per_px) == ("width", 0.05)
    both = ScaleOptions(width_m=12.0, storey_m=3.6)
    scale = metres(rows, bottom, both, width_px=240.0)
    assert (scale.basis, scale.metres_per_px) == ("storey", 3.6 / 60.0)
    assert scale_notes(scale, both) == [
        "scale: --storey-m decides; --width-m beside it is not used"
    ]
    with pytest.raises(InputError, match="1001 m high") as caught:
        require_possible(box(20.0, 1001.0), rectified("given"), "width")
    assert caught.value.subject == "--width-m"
