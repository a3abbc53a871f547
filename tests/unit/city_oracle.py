"""What ISO 19107 asks of faces and solids, as val3dity checks it, by shapely, scipy and edges."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterator
from itertools import pairwise
from typing import Any

import numpy as np
import trimesh
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from shapely.geometry import Polygon
from shapely.validation import explain_validity

from veduta import _core

PLANE_M = 0.01
"""val3dity's own tolerance of planes."""
Faces = list[list[list[int]]]


def solids_of(geometry: dict[str, Any]) -> Iterator[Faces]:
    """The outer shells of a geometry; none of a MultiSurface."""
    if geometry["type"] == "Solid":
        yield geometry["boundaries"][0]
    elif geometry["type"] == "MultiSolid":
        yield from (solid[0] for solid in geometry["boundaries"])


def points_of(city: dict[str, Any]) -> np.ndarray:
    """(n, 3) the vertices in metres."""
    scale, move = (np.array(city["transform"][name]) for name in ("scale", "translate"))
    points: np.ndarray = np.array(city["vertices"]) * scale + move
    return points


def faults(faces: Faces, points: np.ndarray) -> list[str]:
    """What is wrong with a shell: faces that are no polygons, edges that do not pair."""
    found = []
    edges: Counter[tuple[int, int]] = Counter()
    for number, face in enumerate(faces):
        for ring in face:
            edges.update(pairwise([*ring, ring[0]]))
        outline = points[face[0]]
        about = outline - outline.mean(axis=0)
        normal = np.cross(about, np.roll(about, -1, axis=0)).sum(axis=0)
        if np.linalg.norm(normal) < 1e-9:
            found.append(f"face {number} has no area")
            continue
        normal /= np.linalg.norm(normal)
        off = max(np.abs((points[ring] - outline.mean(axis=0)) @ normal).max() for ring in face)
        if off > PLANE_M:
            found.append(f"face {number} is {off:.3f} m off its plane")
        right = np.cross(normal, np.eye(3)[np.abs(normal).argmin()])
        right /= np.linalg.norm(right)
        flat = np.stack([right, np.cross(normal, right)])
        shape = Polygon(points[face[0]] @ flat.T, [points[ring] @ flat.T for ring in face[1:]])
        if not shape.is_valid:
            found.append(f"face {number}: {explain_validity(shape)}")
    unpaired = [edge for edge, count in edges.items() if count != 1 or edges[edge[::-1]] != 1]
    found += [f"{len(unpaired)} edges do not pair"] if unpaired else []
    bodies = _bodies(faces)
    return found + ([f"{bodies} bodies in one shell"] if bodies > 1 else [])


def _bodies(faces: Faces) -> int:
    """How many groups of faces a shell has that have no edge in common."""
    owners: dict[tuple[int, ...], list[int]] = {}
    for number, face in enumerate(faces):
        for ring in face:
            for edge in pairwise([*ring, ring[0]]):
                owners.setdefault(tuple(sorted(edge)), []).append(number)
    pairs = np.array([pair for one in owners.values() for pair in pairwise(one)]).reshape(-1, 2)
    graph = coo_array((np.ones(len(pairs)), pairs.T), shape=(len(faces), len(faces)))
    return int(connected_components(graph, directed=False)[0])


def mesh_of(faces: Faces, points: np.ndarray) -> trimesh.Trimesh:
    """A shell as triangles."""
    rings = [points[ring] for face in faces for ring in face]
    triangles, *_ = _core.triangulate_polygons(
        np.concatenate(rings),
        np.cumsum([0, *(len(ring) for ring in rings)]).astype(np.int64),
        np.cumsum([0, *(len(face) for face in faces)]).astype(np.int64),
        PLANE_M,
    )
    numbers = np.concatenate([ring for face in faces for ring in face])
    return trimesh.Trimesh(points, numbers[triangles], process=False)


def loaded(content: bytes) -> dict[str, Any]:
    """The file read by json alone."""
    city: dict[str, Any] = json.loads(content)
    return city
