"""A known length gives the scale."""

from __future__ import annotations

import numpy as np
import pytest

from veduta.cameras import Camera, CameraSet, ScaleOptions, in_metres
from veduta.run.errors import InputError


def _set(scale: str) -> CameraSet:
    pose = np.column_stack([np.eye(3), [1.0, 2.0, 3.0]])
    camera = Camera("a", 64, 48, (50.0, 50.0), (32.0, 24.0), pose)
    points = np.array([[0.3, -0.1, 4.0]])
    return CameraSet((camera,), points=points, scale="metres" if scale == "metres" else "unknown")


def test_lengths_grow_and_pixels_stay() -> None:
    old = _set("unknown")
    new = in_metres(old, ScaleOptions(metres_per_unit=2.5))
    assert new.scale == "metres"
    assert old.points is not None
    assert new.points is not None
    np.testing.assert_allclose(new.points, 2.5 * old.points)
    np.testing.assert_allclose(new.centres, 2.5 * old.centres)
    seen = [one.cameras[0].project(one.points)[0] for one in (old, new)]
    np.testing.assert_allclose(seen[0], seen[1])
    assert in_metres(old, ScaleOptions()) is old


def test_metres_are_not_scaled_again() -> None:
    with pytest.raises(InputError, match="in metres already"):
        in_metres(_set("metres"), ScaleOptions(metres_per_unit=2.0))
