"""What to do with a file of lots whose format is not read: the program that converts it."""

from __future__ import annotations

import shlex
from collections.abc import Sequence
from pathlib import Path

_OGR = "`ogr2ogr -f GPKG lots.gpkg {path}` converts it."
_REMEDIES = {
    ".parquet": "`ogr2ogr -f GPKG lots.gpkg {path}` converts it (GDAL with Parquet), as QGIS does.",
    ".dwg": "Save it as DXF of closed lines; its maker's program or ODA File Converter do that.",
    ".dgn": _OGR,
    ".gpx": "It has ways and points; give polygons.",
    ".xlsx": "Save it as CSV with a column of WKT.",
    ".skp": "Export it as COLLADA or OBJ from SketchUp.",
    ".ifc": "Export the outlines of its building as GeoJSON or DXF.",
    ".cga": "It has rules: name it before --lots, and a file of lots after it.",
    ".shx": "Name the .shp beside it.",
    ".dbf": "Name the .shp beside it.",
    ".prj": "Name the .shp beside it.",
    ".sqlite": _OGR,
    ".mbtiles": _OGR,
    ".bz2": "Unpack it: `bunzip2 --keep {path}`.",
    ".gz": "Unpack it: `gunzip --keep {path}`.",
    ".7z": "Unpack it.",
    ".rar": "Unpack it.",
}
_REMEDIES[".geoparquet"] = _REMEDIES[".parquet"]
_REMEDIES[".db"] = _REMEDIES[".sqlite"]


def remedy_for(path: Path, read: Sequence[str]) -> str:
    """What turns a file of this name into one that is read. read: the endings that are read."""
    known, own = _REMEDIES.get(path.suffix.lower()), shlex.quote(path.name)
    if known is not None:
        return known.format(path=own)
    also = f"Read are GeoJSON, GeoPackage, CityJSON, OBJ and {', '.join(read)};"
    return f"{also} `ogr2ogr -f GPKG lots.gpkg {own}` converts most others."
