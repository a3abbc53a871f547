"""A limbless animal for tests: its document."""

from __future__ import annotations

import numpy as np

from veduta.fauna.document.schema import Animal, Body, Length, Motion, Source
from veduta.fauna.motion.angles import coefficients
from veduta.fauna.read.usual import usual_slices


def sample_animal(kind: str = "fish") -> Animal:
    """A swimmer of half a metre whose wave runs at 2 Hz."""
    along, times = np.linspace(0.0, 1.0, 100), np.arange(60) * 0.02
    wave = np.sin(2.0 * np.pi * (2.0 * times[:, None] - along))
    states = coefficients((0.1 + 0.4 * along) * wave)
    return Animal(
        name="eel",
        kind=kind,  # type: ignore[arg-type]
        source=Source(file="eel.csv", sha256="", frames=60, used=60),
        length=Length(metres=0.5, provenance="measured", score=1.0),
        body=Body(slices=usual_slices("fish"), widths="invented", heights="invented", score=0.0),
        motion=Motion(
            frame_s=0.02,
            states=np.stack([states.real, states.imag], axis=-1).tolist(),
            frame=list(range(60)),
            provenance="measured",
            score=1.0,
            speed=1.0,
            speed_provenance="measured",
        ),
    )
