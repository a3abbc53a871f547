"""What an unmoved picture is compared as, where two mosaics are not of one size."""

from __future__ import annotations

import numpy as np

from veduta.walk.build.judge import laid_over, psnr
from veduta.walk.build.screen import Screen


def test_a_picture_is_laid_upon_the_rays_of_another_screen() -> None:
    whole = np.random.default_rng(4).integers(0, 255, (40, 60, 3)).astype(np.uint8)
    own = Screen(60, 37, (50.0, 50.0), (30.0, 18.0), round=True)
    other = Screen(60, 38, (50.0, 50.0), (30.0, 20.0), round=True)
    # Row 2 of the one is row 0 of the other: they show the same rows of a whole.
    laid = laid_over(whole[2:39], own, other)
    assert laid.shape == (38, 60, 3)
    assert np.array_equal(laid[2:], whole[2:38])
    assert psnr(laid[2:], whole[2:38]) > 80.0
    assert laid_over(whole[:37], own, own) is not None
    assert np.array_equal(laid_over(whole[:37], own, own), whole[:37])
