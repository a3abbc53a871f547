"""From a depth map to the depths of a front's elements (`--depth-map`)."""

from veduta.facade.measured.apply import with_depths
from veduta.facade.measured.elevation import metres_per_px, of_photo

__all__ = ["metres_per_px", "of_photo", "with_depths"]
