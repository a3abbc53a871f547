"""Veduta turns records of real places into measured, semantic, walkable 3D.

    >>> import veduta
    >>> house = veduta.read_facade("photo.jpg", height_m=18.0)
    >>> house.write("house.obj")

What is here is brought when it is first asked for: `import veduta` costs nothing.
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from veduta.run.late import on_demand

if TYPE_CHECKING:
    from veduta import grammar
    from veduta.carve.door import carve_photos
    from veduta.dense.door import measure_photos
    from veduta.drive.door import read_drive
    from veduta.facade.door import read_facade
    from veduta.fauna.door import read_animal
    from veduta.grammar.door import derive
    from veduta.photos.door import locate_photos
    from veduta.place.load import load
    from veduta.place.mesh import Mesh
    from veduta.place.part import Part
    from veduta.place.place import Cloud, ModelFile, Place, Standing
    from veduta.place.semantics import Provenance, SemanticClass
    from veduta.plan.door import read_plan
    from veduta.walk.door import read_walk

__version__ = "0.1.0"

# onnxruntime tells its makers of each first use, and keeps an id of the machine: not from here. It
# reads this when it is imported, and every process of Veduta's begins with this file.
os.environ["ORT_DISABLE_TELEMETRY"] = "1"
# GDAL tells formats by their content: these read what else a file names, here or over the network.
os.environ["GDAL_SKIP"] = (
    "OGR_VRT GDALG ADBC AmigoCloud CSW Carto EEDA Elasticsearch GPSBabel HTTP NGW OAPIF OGCAPI"
    " PLSCENES WFS"
)
os.environ["CPL_VSIL_CURL_ALLOWED_EXTENSIONS"] = ".none"

__all__ = [
    "Cloud",
    "Mesh",
    "ModelFile",
    "Part",
    "Place",
    "Provenance",
    "SemanticClass",
    "Standing",
    "__version__",
    "carve_photos",
    "derive",
    "grammar",
    "load",
    "locate_photos",
    "measure_photos",
    "read_animal",
    "read_drive",
    "read_facade",
    "read_plan",
    "read_walk",
]

_LATE = {
    "Cloud": "place.place",
    "Mesh": "place.mesh",
    "Part": "place.part",
    "Place": "place.place",
    "Provenance": "place.semantics",
    "SemanticClass": "place.semantics",
    "ModelFile": "place.place",
    "Standing": "place.place",
    "carve_photos": "carve.door",
    "measure_photos": "dense.door",
    "read_animal": "fauna.door",
    "read_drive": "drive.door",
    "read_walk": "walk.door",
    "derive": "grammar.door",
    "grammar": "",
    "load": "place.load",
    "locate_photos": "photos.door",
    "read_facade": "facade.door",
    "read_plan": "plan.door",
}


def __getattr__(name: str) -> Any:
    """What `_LATE` names."""
    return on_demand(__name__, name, _LATE)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
