"""The points of a path that the user gives, as GeoJSON in the place's own metres."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np

from veduta.fauna.motion.angles import Floats
from veduta.run.errors import InputError
from veduta.run.inputs import require_file

_MOST_BYTES = 50_000_000
_REMEDY = "Give GeoJSON with a LineString, or with points in their order, in metres of the place."


def read_path(path: Path) -> Floats:
    """(k, 2) x, y in metres; InputError where the file holds no such points."""
    try:
        require_file(path, _MOST_BYTES)
        content = json.loads(path.read_text("utf-8"))
    except OSError as error:
        raise InputError(path, f"cannot be read ({error.strerror})", _REMEDY) from error
    except (UnicodeDecodeError, json.JSONDecodeError) as error:
        raise InputError(path, "is no JSON", _REMEDY) from error
    points = [point for geometry in _geometries(content) for point in _points(geometry)]
    try:
        found = np.array([point[:2] for point in points], dtype=np.float64).reshape(-1, 2)
    except (TypeError, ValueError) as error:
        raise InputError(path, "has coordinates that are no numbers", _REMEDY) from error
    if len(found) < 2:
        raise InputError(path, f"has {len(found)} points", "Give two points at least.")
    if not np.isfinite(found).all():
        raise InputError(path, "has coordinates that are no numbers", _REMEDY)
    return found


def _geometries(content: Any) -> list[dict[str, Any]]:
    if not isinstance(content, dict):
        return []
    if content.get("type") == "FeatureCollection":
        features = content.get("features")
        listed = features if isinstance(features, list) else []
        return [shape for feature in listed for shape in _geometries(feature)]
    if content.get("type") == "Feature":
        return _geometries(content.get("geometry"))
    return [content]


def _points(geometry: dict[str, Any]) -> list[Any]:
    coordinates = geometry.get("coordinates")
    if not isinstance(coordinates, list):
        return []
    if geometry.get("type") == "Point":
        return [coordinates]
    if geometry.get("type") in {"LineString", "MultiPoint"}:
        return [point for point in coordinates if isinstance(point, list)]
    return []
