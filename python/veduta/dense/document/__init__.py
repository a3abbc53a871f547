"""What `read` finds and `build` takes: views, their depth maps, and walls."""

from veduta.dense.document.depth_map import DepthMap
from veduta.dense.document.elevation import Elevation
from veduta.dense.document.views import Views, camera_row

__all__ = ["DepthMap", "Elevation", "Views", "camera_row"]
