"""What all CityJSON files of Veduta's have alike: the document, vertices, surfaces, pictures.

https://www.cityjson.org/specs/2.0.1/ - sections 3 (geometry), 3.3 (semantics), 4 (transform), 5
(metadata), 6 (appearance). Vertices are whole steps of a grid; corners on pictures count from the
lower left. The order of members is always the same, so that equal content gives equal bytes.
"""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

Vertex = tuple[int, int, int]


def document(
    grid_m: float,
    origin_m: Sequence[float],
    *,
    title: str | None = None,
    extent_m: Sequence[float] | None = None,
    crs: str | None = None,
    objects: Mapping[str, Any] | None = None,
    vertices: Sequence[Sequence[int]] = (),
) -> dict[str, Any]:
    """The CityJSON object: its frame, its objects and their vertices.

    origin_m: (3,) where the vertices count from, in the CRS (such as "EPSG:25832"). extent_m: (6,)
    the lower and the upper corner of everything.
    """
    metadata: dict[str, Any] = {}
    if title is not None:
        metadata["title"] = title
    if extent_m is not None:
        metadata["geographicalExtent"] = list(extent_m)
    if crs is not None:
        metadata["referenceSystem"] = reference_system(crs)
    return {
        "type": "CityJSON",
        "version": "2.0",
        "metadata": metadata,
        "transform": {"scale": [grid_m] * 3, "translate": list(origin_m)},
        "CityObjects": {} if objects is None else objects,
        "vertices": list(vertices),
    }


def encoded(whole: Mapping[str, Any]) -> bytes:
    """The content of a file; ValueError where a number is none."""
    return json.dumps(whole, separators=(",", ":"), allow_nan=False).encode()


def reference_system(crs: str) -> str:
    """The address of a CRS ("EPSG:25832") that the standard asks for (section 5)."""
    authority, _, code = crs.rpartition(":")
    return f"https://www.opengis.net/def/crs/{authority or 'EPSG'}/0/{code}"


def steps_of(
    points_m: NDArray[np.float64], origin_m: NDArray[np.float64], grid_m: float
) -> NDArray[np.int64]:
    """(n, 3) points as whole steps of the grid from its origin."""
    return np.round((points_m - origin_m) / grid_m).astype(np.int64)


def shared_vertices(
    points_m: NDArray[np.float64], origin_m: NDArray[np.float64], grid_m: float
) -> tuple[list[list[int]], NDArray[np.int64]]:
    """The distinct vertices of (n, 3) points, in order, and the number of that of each point."""
    steps = steps_of(points_m, origin_m, grid_m)
    vertices, vertex_of = np.unique(steps, axis=0, return_inverse=True)
    return vertices.tolist(), vertex_of.reshape(-1)


class Vertices:
    """Vertices that surfaces share, each once, in the order in which they come."""

    def __init__(self) -> None:
        self._number_of: dict[Vertex, int] = {}

    def __len__(self) -> int:
        """How many there are."""
        return len(self._number_of)

    def numbers(self, ring: Iterable[Sequence[int]]) -> list[int]:
        """The numbers of a ring's vertices, which are steps of the grid."""
        known = self._number_of
        return [known.setdefault((x, y, z), len(known)) for x, y, z in ring]

    def told(self) -> list[list[int]]:
        """The member of the file."""
        return [list(vertex) for vertex in self._number_of]


def closes_volume(faces: Iterable[Iterable[Sequence[Hashable]]]) -> bool:
    """Whether each edge of the faces' rings is there once to and once fro."""
    edges: Counter[tuple[Hashable, Hashable]] = Counter()
    for rings in faces:
        for ring in rings:
            edges.update(pairwise([*ring, ring[0]]))
    return bool(edges) and all(
        count == 1 and edges.get((end, start)) == 1 for (start, end), count in edges.items()
    )


def geometry(
    lod: str,
    boundaries: list[Any],
    surfaces: list[dict[str, Any]],
    values: list[int],
    *,
    closed: bool,
    looks: Mapping[str, tuple[str, list[Any]]],
) -> dict[str, Any]:
    """A Solid of one shell, or a MultiSurface of what is not closed.

    values: of each face its semantic surface. looks: the theme of the materials and of the textures
    ("material", "texture") and what each face has of it.
    """

    def nested(of_faces: list[Any]) -> list[Any]:
        return [of_faces] if closed else of_faces

    shape: dict[str, Any] = {
        "type": "Solid" if closed else "MultiSurface",
        "lod": lod,
        "boundaries": nested(boundaries),
        "semantics": {"surfaces": surfaces, "values": nested(values)},
    }
    for kind, (theme, of_faces) in looks.items():
        shape[kind] = {theme: {"values": nested(of_faces)}}
    return shape


def has_pictures(textures: Iterable[Iterable[Sequence[int | None]]]) -> bool:
    """Whether any ring of the faces shows a picture."""
    return any(list(ring) != [None] for rings in textures for ring in rings)


def surface(kind: str, id: str, name: str, semantic: str, provenance: str) -> dict[str, Any]:
    """What is said of every semantic surface; kind: CityJSON's word for it."""
    return {"type": kind, "id": id, "name": name, "class": semantic, "provenance": provenance}


def link(surfaces: Sequence[dict[str, Any]], row: int, parent: int) -> None:
    """Say that a surface (a window) is part of another one (its wall), in both of them."""
    surfaces[row]["parent"] = parent
    surfaces[parent].setdefault("children", []).append(row)


def texture(image: str, wrap: str, kind: str | None = None) -> dict[str, str]:
    """A picture by its path; wrap: how it goes on at its borders, kind: its `textureType`."""
    form = "PNG" if image.lower().endswith(".png") else "JPG"
    told = {"type": form, "image": image, "wrapMode": wrap}
    return told if kind is None else told | {"textureType": kind}


def corners_on_picture(uv: NDArray[np.floating]) -> list[list[float]]:
    """(n, 2) texture coordinates, which count from the upper left, as the file has them."""
    given = uv.astype(np.float64)
    corners: list[list[float]] = np.round(
        np.column_stack([given[:, 0], 1.0 - given[:, 1]]), 6
    ).tolist()
    return corners


@dataclass
class Shown:
    """The pictures that faces show, and the corners on them, each once, as they come."""

    images: dict[str, int] = field(default_factory=dict)
    corners: dict[tuple[float, float], int] = field(default_factory=dict)

    def ring(self, image: str | None, uv: NDArray[np.floating]) -> list[int | None]:
        """What a ring shows: the number of the picture and of each of its corners; or nothing."""
        return [None] if image is None else self.shown(image, corners_on_picture(uv))

    def shown(self, image: str, corners: Sequence[Sequence[float]]) -> list[int | None]:
        """The same of a ring whose corners are on the picture already (`corners_on_picture`)."""
        known = self.corners
        return [
            self.images.setdefault(image, len(self.images)),
            *[known.setdefault((u, v), len(known)) for u, v in corners],
        ]

    def told(self, theme: str) -> dict[str, Any]:
        """What `appearance` says of pictures, which repeat; nothing where nothing shows one."""
        if not self.images:
            return {}
        pictures = [texture(image, "wrap") for image in self.images]
        return textures(theme, pictures, [list(corner) for corner in self.corners])


def textures(
    theme: str, pictures: Sequence[Mapping[str, str]], corners: Sequence[Sequence[float]]
) -> dict[str, Any]:
    """The members of `appearance` for pictures and the corners on them."""
    told = {"textures": list(pictures), "vertices-texture": list(corners)}
    return {"default-theme-texture": theme, **told}
