"""What CityJSON says of the looks of faces: colours, and pictures with where corners lie on them.

https://www.cityjson.org/specs/2.0.1/ section "Appearance Object" - texture vertices count from the
lower left. Of several themes that which the file calls its default is taken, else the first. A look
that cannot be used is none: the face stands without it.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.formats.building_faces import FaceLook
from veduta.place.material import Colour


class Appearance:
    """The `appearance` of a file or of a line."""

    def __init__(self, told: Any) -> None:
        own = told if isinstance(told, dict) else {}
        self._themes = {
            kind: str(own.get(f"default-theme-{kind}")) for kind in ("material", "texture")
        }
        self._materials = [_material(one) for one in _list(own.get("materials"))]
        self._pictures = [_image(one) for one in _list(own.get("textures"))]
        self._corners = _corners(own.get("vertices-texture"))

    def values(self, geometry: dict[str, Any], kind: str) -> Any:
        """What a geometry says of its faces, nested as its boundaries; or one number for all."""
        themes = geometry.get(kind)
        if not isinstance(themes, dict) or not themes:
            return None
        theme = themes.get(self._themes[kind], next(iter(themes.values())))
        if not isinstance(theme, dict):
            return None
        return theme.get("values", theme.get("value"))

    def look(self, material: Any, texture: Any, sizes: tuple[int, ...]) -> FaceLook | None:
        """The look of a face whose rings have so many corners."""
        colour, opacity = (None, 1.0)
        if isinstance(material, int) and 0 <= material < len(self._materials):
            colour, opacity = self._materials[material]
        picture, corners = self._mapped(texture, sizes)
        if colour is None and picture is None:
            return None
        return FaceLook(colour, opacity, picture, corners)

    def _mapped(
        self, texture: Any, sizes: tuple[int, ...]
    ) -> tuple[str | None, tuple[NDArray[np.float64], ...]]:
        try:
            rows = [np.array(ring) for ring in texture]
        except (TypeError, ValueError, OverflowError):
            return None, ()
        if any(ring.ndim != 1 or ring.dtype.kind != "i" for ring in rows):
            return None, ()
        if tuple(len(ring) - 1 for ring in rows) != sizes:
            return None, ()
        numbers = [ring[1:] for ring in rows]
        picture = int(rows[0][0])
        if not 0 <= picture < len(self._pictures) or any(
            len(ring) and not 0 <= ring.min() <= ring.max() < len(self._corners) for ring in numbers
        ):
            return None, ()
        corners = tuple(self._corners[ring] for ring in numbers)
        if not all(np.isfinite(ring).all() for ring in corners):
            return None, ()
        return self._pictures[picture], corners


def _list(told: Any) -> Iterator[dict[str, Any]]:
    for one in told if isinstance(told, list) else ():
        yield one if isinstance(one, dict) else {}


def _material(told: dict[str, Any]) -> tuple[Colour | None, float]:
    clear = _share(told.get("transparency", 0.0))
    shares = told.get("diffuseColor")
    found = [_share(one) for one in shares] if isinstance(shares, list) else []
    colour = None
    if len(found) == 3 and None not in found:
        red, green, blue = (one or 0.0 for one in found)
        colour = (red, green, blue)
    return colour, 1.0 - (clear or 0.0)


def _share(told: Any) -> float | None:
    """Between 0 and 1; None for what is no number."""
    if isinstance(told, bool) or not isinstance(told, int | float):
        return None
    return float(min(max(told, 0), 1))


def _image(told: dict[str, Any]) -> str | None:
    image = told.get("image")
    return image[:1000] if isinstance(image, str) and image else None


def _corners(told: Any) -> NDArray[np.float64]:
    """(n, 2); none where they are no pairs of numbers."""
    try:
        corners = np.array(told if isinstance(told, list) else [], dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        return np.zeros((0, 2))
    return corners if corners.ndim == 2 and corners.shape[1] == 2 else np.zeros((0, 2))
