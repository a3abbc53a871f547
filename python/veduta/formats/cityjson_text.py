"""CityJSON 2.0 and CityJSONSeq of derived buildings, from the texts of their geometry.

https://www.cityjson.org/specs/2.0.1/ and https://www.cityjson.org/cityjsonseq/ - each building is a
line of its own (`CityJSONFeature`) with its own vertices; a CityJSON file (`cityjson_joined`) is
all of them with shared vertices. What rules leave is mostly open surfaces: a MultiSurface; what
closes is a Solid. A building seen from afar gives closed volumes, which stand beside it as LoD 1.2
and 2.2. Faces have their colours as materials, and their pictures where rules give them one.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.formats import cityjson_frame as frame
from veduta.place.semantics import CITYJSON_SURFACE, DRAWN_ONLY, Provenance, SemanticClass

FORM = re.compile(r'\{"type":"(Solid|MultiSurface)","lod":"([0-9.]+)"')
GRID_M = 1e-3
"""Vertices are whole millimetres."""
INSTALLATIONS = frozenset({SemanticClass.BALCONY, SemanticClass.CORNICE, SemanticClass.CHIMNEY})
CLASSES = [f"{one.value} (drawn only)" if one in DRAWN_ONLY else one.value for one in SemanticClass]
"""As rules name them: what is drawn only they cannot make."""
KINDS = ["" if one in INSTALLATIONS else CITYJSON_SURFACE[one] for one in SemanticClass]

Tint = tuple[int, int, int]
"""sRGB, of 255: what a picture is multiplied by."""
Looks = tuple[list[tuple[int, Tint]], str, str]
"""The pictures (number and tint) that geometries count, `materials`, `vertices-texture`."""
Geometry = tuple[str, list[tuple[int, str, str, str]], str, Looks]
"""Of the building, of its installations (class, rule, colour, geometry), vertices, looks."""
Images = Callable[[int, Tint], str]
"""The path of a picture in a tint, seen from the file."""
THEME = "rules"
"""The theme of materials and textures that geometries name."""


def feature_line(
    building: str, attributes: Mapping[str, Any], geometry: Geometry, images: Images
) -> str | None:
    """The line of a building; None where it has no surface."""
    body, installations, vertices, looks = geometry
    if not body and not installations:
        return None
    children = [f"{building}/{number}" for number in range(len(installations))]
    objects = [
        _object(
            building,
            {"type": "Building", "attributes": dict(attributes)}
            | ({"children": children} if children else {}),
            body,
        )
    ]
    for name, (code, rule, colour, text) in zip(children, installations, strict=True):
        about = {"class": CLASSES[code], "rule": rule, "colour": colour}
        more = {"type": "BuildingInstallation", "parents": [building], "attributes": about}
        objects.append(_object(name, more, text))
    return (
        f'{{"type":"CityJSONFeature","id":{json.dumps(building)},'
        f'"CityObjects":{{{",".join(objects)}}},{_appearance(looks, images)}"vertices":{vertices}}}'
    )


def _appearance(looks: Looks, images: Images) -> str:
    pictures, materials, corners = looks
    told = {"default-theme-material": THEME}
    text = json.dumps(told | ({"default-theme-texture": THEME} if pictures else {}))[1:-1]
    text += f',"materials":{materials}'
    if pictures:
        shown = [texture(images(number, tint)) for number, tint in pictures]
        text += f',"textures":{json.dumps(shown)},"vertices-texture":{corners}'
    return f'"appearance":{{{text}}},'


def texture(image: str) -> dict[str, str]:
    """What CityJSON says of a picture that repeats."""
    return frame.texture(image, "wrap", "typical")


def relief_line(name: str, points_m: NDArray[np.float64], triangles: NDArray[np.int32]) -> str:
    """The line of invented ground: (n, 3) points about the origin and (m, 3) triangles.

    Corners that fall into one on the grid are one; a triangle without area is left out.
    """
    used = points_m[triangles].reshape(-1, 3)
    vertices, corners = frame.shared_vertices(used, np.zeros(3), GRID_M)
    faces = corners.reshape(-1, 3)
    a, b, c = (faces[:, k] for k in range(3))
    faces = faces[(a != b) & (b != c) & (c != a)]
    surface = {"type": "CompositeSurface", "lod": "1", "boundaries": faces[:, None].tolist()}
    about = {"type": "TINRelief", "attributes": {"provenance": Provenance.INVENTED.value}}
    text = _object(name, about, json.dumps(surface, separators=(",", ":")))
    return (
        f'{{"type":"CityJSONFeature","id":{json.dumps(name)},"CityObjects":{{{text}}},'
        f'"vertices":{json.dumps(vertices, separators=(",", ":"))}}}'
    )


def forms_of(geometry: Geometry) -> list[str]:
    """What the geometries of a building itself are: `MultiSurface 3`, `Solid 2.2`."""
    return [f"{kind} {lod}" for kind, lod in FORM.findall(geometry[0])]


def _object(name: str, record: Mapping[str, Any], geometry: str) -> str:
    text = json.dumps(record, separators=(",", ":"), allow_nan=False)
    shape = f',"geometry":[{geometry}]' if geometry else ""
    return f"{json.dumps(name)}:{text[:-1]}{shape}}}"


def header(title: str, crs: str | None, origin_m: Sequence[float]) -> dict[str, Any]:
    """The first line of a sequence: the frame of all features."""
    return frame.document(GRID_M, origin_m, title=title, crs=crs)


def write_sequence(path: Path, first: Mapping[str, Any], pieces: Iterable[Path]) -> None:
    """Write CityJSONSeq from files of lines, a line at a time in memory."""
    with path.open("w", encoding="utf-8", newline="\n") as out:
        out.write(frame.encoded(first).decode() + "\n")
        for piece in pieces:
            with piece.open(encoding="utf-8") as lines:
                out.writelines(lines)
