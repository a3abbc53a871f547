"""Attributes of the edges of lots: from properties of files to what the engine takes.

A property `/edgeattr/NAME` has an element for each edge of the outline and of its holes, in the
order of their corners in the file: a list, or a text with semicolons between its elements. Lots
carry them as such texts. A semicolon behind the last element ends it, so that an empty last element
has one of its own; files may leave that out where the number of edges tells it.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

PREFIX = "/edgeattr/"
"""What their names begin with for the engine."""
STREET = f"{PREFIX}streetWidth"
_NAME = re.compile(r"/?edgeattr[/._](?P<name>.+)", re.IGNORECASE)
"""As files write it: columns of tables can have no slashes."""
MOST_EDGES = 100_000
Attribute = bool | float | str
EdgeList = Sequence[float] | Sequence[bool] | Sequence[str]


def edge_texts(properties: Mapping[str, Any]) -> dict[str, str]:
    """The attributes of edges among the properties of a file, as texts."""
    found: dict[str, str] = {}
    for name, value in properties.items():
        known = _NAME.fullmatch(str(name))
        if known is None:
            continue
        if isinstance(value, list) and len(value) <= MOST_EDGES:
            value = _joined([_text(one) for one in value])
        if isinstance(value, str):
            found[f"{PREFIX}{known['name']}"] = value
    return found


def without_edges(attributes: dict[str, Attribute]) -> dict[str, Attribute]:
    """The attributes of a lot as a whole."""
    return {name: value for name, value in attributes.items() if not _NAME.fullmatch(name)}


def edges_of_ring(
    attributes: dict[str, Attribute],
    given: Sequence[NDArray[np.float64]],
    own: Sequence[NDArray[np.float64]],
) -> dict[str, Attribute]:
    """The attributes with those of edges in the order of the lot's own rings.

    given: rings of (n, 2) as the file has them, in the same frame; own: those of the lot, which
    may run the other way, begin elsewhere, and lack corners that part nothing. An attribute with
    another number of elements than the file's rings have edges is left out.
    """
    names = [name for name in attributes if name.startswith(PREFIX)]
    if not names:
        return attributes
    start, end = _edges([_open(ring) for ring in given])
    to = _nearest(start, end, *_edges(own))
    found = without_edges(attributes)
    for name in names:
        values = _elements(str(attributes[name]), len(start))
        if len(values) == len(start):
            found[name] = _joined([values[row] for row in to])
    return found


def edge_lists(attributes: Mapping[str, Attribute]) -> dict[str, EdgeList]:
    """What the engine is given: numbers, truth values, or texts where an element is neither."""
    found: dict[str, EdgeList] = {}
    for name, text in attributes.items():
        if name.startswith(PREFIX):
            found[name] = _list(_elements(str(text)))
    return found


def _list(values: list[str]) -> EdgeList:
    if all(value in ("true", "false") for value in values):
        return [value == "true" for value in values]
    try:
        numbers = [float(value) for value in values]
    except ValueError:
        return values
    return numbers if np.isfinite(numbers).all() else values


def _text(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    return "" if value is None else str(value).replace(";", ",")


def _joined(values: list[str]) -> str:
    """The text of which `_elements` makes these values."""
    return ";".join(values) + (";" if values and not values[-1] else "")


def _elements(text: str, count: int | None = None) -> list[str]:
    """Between semicolons; one behind the last element ends it, if they are not `count` with it."""
    values = [one.strip() for one in text.split(";")]
    ends = len(values) > 1 and not values[-1] and len(values) != count
    return values[:-1] if ends else values


def _open(ring: NDArray[np.float64]) -> NDArray[np.float64]:
    """Without a last corner that is the first again."""
    return ring[:-1] if len(ring) > 1 and np.array_equal(ring[0], ring[-1]) else ring


def _edges(
    rings: Sequence[NDArray[np.float64]],
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """(e, 2) each: where the edges of all rings begin and end."""
    return np.concatenate(rings), np.concatenate([np.roll(ring, -1, axis=0) for ring in rings])


def _nearest(
    start: NDArray[np.float64],
    end: NDArray[np.float64],
    own_start: NDArray[np.float64],
    own_end: NDArray[np.float64],
) -> list[int]:
    """For each own edge the given one that its middle lies on, or nearest to."""
    middle = (own_start + own_end) / 2
    along = end - start
    squared = np.maximum((along**2).sum(axis=1), 1e-18)
    away = middle[:, None, :] - start[None]
    share = np.clip((away * along[None]).sum(axis=2) / squared, 0.0, 1.0)
    apart = np.linalg.norm(away - share[..., None] * along[None], axis=2)
    rows: list[int] = apart.argmin(axis=1).tolist()
    return rows
