"""Photos of a walk along a street, with the faults that a day's photos have."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime, timedelta
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from veduta.synthetic.camera import Camera
from veduta.synthetic.lens import Distortion
from veduta.synthetic.light import Light
from veduta.synthetic.photo import Lens, develop
from veduta.synthetic.render import render
from veduta.synthetic.scene import RayScene
from veduta.synthetic.seeds import stream
from veduta.synthetic.streets.shot import ShotTags, shot_jpeg

LensKind = Literal["pinhole", "simple-radial", "radial", "opencv"]
LENSES: Mapping[LensKind, Distortion] = {
    "pinhole": Distortion(),
    "simple-radial": Distortion(k1=-0.07),
    "radial": Distortion(k1=-0.12, k2=0.06),
    "opencv": Distortion(k1=-0.08, k2=0.04, p1=0.002, p2=-0.0015, aspect=1.004),
}
FOCAL_STEPS = (1.0, 1.12, 0.92)
"""Focal lengths of several cameras over that of the first."""
LENS_STEPS = (1.0, 0.6, 1.3)
"""And how much they bend."""
EXPOSURE_STOPS = 0.3
TINT = 0.03
SECONDS_APART = 9.0
_START = datetime(2024, 5, 17, 9, 30)


@dataclass(frozen=True)
class Kit:
    """What one takes the photos with: a kind of lens, one camera or three in turn."""

    lens: LensKind = "radial"
    cameras: Literal[1, 3] = 1

    @property
    def distortions(self) -> tuple[Distortion, ...]:
        """Of each camera."""
        return tuple(_times(LENSES[self.lens], step) for step in LENS_STEPS[: self.cameras])

    @property
    def focal_steps(self) -> tuple[float, ...]:
        """Of each camera, over that of the first."""
        return FOCAL_STEPS[: self.cameras]

    def model(self, row: int) -> str:
        """The name in EXIF of the camera that took a photo."""
        return f"Synthetic {'ABC'[row % self.cameras]}"


def _times(lens: Distortion, step: float) -> Distortion:
    return Distortion(
        lens.k1 * step,
        lens.k2 * step,
        lens.p1 * step,
        lens.p2 * step,
        1.0 + (lens.aspect - 1.0) * step,
    )


def photos_of(
    scene: RayScene,
    light: Light,
    cameras: Sequence[Camera],
    kit: Kit,
    gps_deg: NDArray[np.float64] | None,
    seed: int,
    samples: int = 2,
    threads: int = 2,
) -> Iterator[tuple[bytes, NDArray[np.uint8]]]:
    """The JPEG file and the pixels of each photo, one after the other.

    gps_deg: (n, 3) latitude, longitude and height of each, None without a receiver.
    """
    for row, camera in enumerate(cameras):
        rng = stream(seed, f"photo {row}")
        tint = 1.0 + TINT * rng.standard_normal(3)
        lens = Lens(
            exposure=float(np.clip(EXPOSURE_STOPS * rng.standard_normal(), -0.8, 0.6)),
            tint=(float(tint[0]), float(tint[1]), float(tint[2])),
            noise=0.008,
        )
        number = int(rng.integers(2**31))
        pixels = develop(render(scene, camera, light, samples, number, threads), lens, number)
        gps = None
        if gps_deg is not None:
            gps = (float(gps_deg[row, 0]), float(gps_deg[row, 1]), float(gps_deg[row, 2]))
        time = _START + timedelta(seconds=SECONDS_APART * row)
        tags = ShotTags(kit.model(row), time, camera.focal_mm35, gps)
        yield shot_jpeg(pixels, tags, lens.quality), pixels
