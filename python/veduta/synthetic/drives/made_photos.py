"""Photographs of made streets, and the same without what stands before the houses.

Light comes from an overcast sky, so that no tree throws a shadow onto a front that stays when the
tree is taken away.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from veduta.imaging.srgb import srgb_of_linear
from veduta.synthetic.camera import Camera
from veduta.synthetic.drives.made_street import MadeStreet
from veduta.synthetic.drives.photograph import StreetCamera, StreetPhoto
from veduta.synthetic.drives.street import Kind
from veduta.synthetic.light import Light, daylight
from veduta.synthetic.render import measure, render

Floats = NDArray[np.float64]
_GAIN = 0.85
"""Of the exposure: the same in all images, but for what the camera strays by."""
_NEARER = 0.01
"""Share of its distance by which something stands before a front."""


def overcast(seed: int) -> Light:
    """The light of such a day."""
    return daylight(seed, False, 1.0, 0.8)


def photograph_made(
    street: MadeStreet,
    camera: StreetCamera,
    world_from_vehicle: Floats,
    light: Light,
    random: np.random.Generator,
    samples: int = 1,
) -> StreetPhoto:
    """One image from a vehicle's pose (3, 4). samples: rays of a pixel along both of its axes."""
    pinhole = pinhole_of(camera, world_from_vehicle)
    seed = int(random.integers(2**31))
    taken = render(street.scene, pinhole, light, samples, seed).astype(np.float64)
    behind = render(street.bare, pinhole, light, samples, seed).astype(np.float64)
    seen, plain = measure(street.scene, pinhole), measure(street.bare, pinhole)
    met = plain.feature >= 0
    front = met & (street.bare_kinds[np.maximum(plain.feature, 0)] == Kind.WALL)
    own = street.kinds[np.maximum(seen.feature, 0)]
    before = (seen.feature >= 0) & (own == Kind.OBJECT)
    with np.errstate(invalid="ignore"):
        before &= ~(seen.depth_m > plain.depth_m * (1.0 - _NEARER))
    gain = _GAIN * (1.0 + camera.exposure * random.normal())
    noise = camera.noise * random.normal(size=taken.shape)
    return StreetPhoto(_bytes(gain * taken, noise), _bytes(_GAIN * behind), before, front)


def pinhole_of(camera: StreetCamera, world_from_vehicle: Floats) -> Camera:
    """As the renderer takes it, from a vehicle's pose (3, 4)."""
    pose = np.vstack([camera.world_from_cam(world_from_vehicle), [0.0, 0.0, 0.0, 1.0]])
    middle = (camera.width_px / 2, camera.height_px / 2)
    return Camera(
        camera.width_px, camera.height_px, camera.focal_px, middle, np.linalg.inv(pose)
    )  # fmt: skip


def _bytes(radiance: Floats, noise: Floats | float = 0.0) -> NDArray[np.uint8]:
    shown = 255.0 * srgb_of_linear(np.clip(radiance, 0.0, 1.0)) + noise
    return np.clip(np.rint(shown), 0, 255).astype(np.uint8)
