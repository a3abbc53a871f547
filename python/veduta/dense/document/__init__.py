"""What `read` finds and `build` takes: views and their depth maps."""

from veduta.dense.document.depth_map import DepthMap
from veduta.dense.document.views import Views, camera_row

__all__ = ["DepthMap", "Views", "camera_row"]
