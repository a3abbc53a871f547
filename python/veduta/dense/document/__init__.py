"""What `read` finds and `build` takes: views, their depth maps, walls, and a city model."""

from veduta.dense.document.city_mesh import CityMesh
from veduta.dense.document.depth_map import DepthMap
from veduta.dense.document.elevation import Elevation
from veduta.dense.document.views import Views, camera_row

__all__ = ["CityMesh", "DepthMap", "Elevation", "Views", "camera_row"]
