"""Meshes of files as assets: cleaned, and bounded."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.formats.dae_read import read_dae_mesh
from veduta.formats.glb_mesh import read_glb_mesh
from veduta.formats.obj_read import ReadMesh, read_obj
from veduta.grammar.assets.asset import Asset, Slot
from veduta.run.errors import InputError

SUFFIXES = (".obj", ".glb", ".dae")
WELD = 1e-6
"""Points nearer than this share of the mesh's extent are one."""


def read_asset(name: str, path: Path) -> Asset:
    """The asset of a file, by the name that rules have for it; InputError says what is wrong."""
    asset = _cleaned(name, _pictured(_mesh(path)))
    if asset is None:
        raise InputError(path, "has no face with an area", "Check it in the program it comes from.")
    return asset


def _mesh(path: Path) -> ReadMesh:
    match path.suffix.lower():
        case ".obj":
            return read_obj(path, path.parent)
        case ".dae":
            return read_dae_mesh(path)
        case _:
            return read_glb_mesh(path)


def _pictured(mesh: ReadMesh) -> ReadMesh:
    """Without the pictures on which no corner has a place."""
    if mesh.uv is None:
        return mesh
    has_place = np.isfinite(mesh.uv).all(axis=1)
    row = np.repeat(mesh.face_material, np.diff(mesh.offsets))
    laid = np.unique(row[has_place]).tolist()
    pictures, notes = list(mesh.pictures), list(mesh.notes)
    for number, (label, _) in enumerate(mesh.materials):
        if pictures[number] is not None and number not in laid:
            pictures[number] = None
            told = f"the faces of its material {label[:200]} have no places on its picture"
            notes.append(f"{told}: the colour alone is shown")
    return replace(mesh, pictures=tuple(pictures), notes=tuple(notes))


def _cleaned(name: str, mesh: ReadMesh) -> Asset | None:
    """Points that coincide joined, faces without an area left out, warped ones in triangles.

    Corners at joined points stay apart on pictures.
    """
    corners, offsets, material = _welded(mesh)
    group, places = mesh.face_group, np.arange(len(corners))
    for triangles in (False, True):
        faces = [places[a:b] for a, b in zip(offsets[:-1], offsets[1:], strict=True)]
        kept = [row for row, face in enumerate(faces) if _has_area(mesh.points[corners[face]])]
        if not kept:
            return None
        own = [faces[row] for row in kept]
        shown = np.concatenate(own)
        asset = Asset(
            name=name,
            points_m=mesh.points,
            corners=corners[shown].astype(np.uint32),
            offsets=np.concatenate([[0], np.cumsum([len(face) for face in own])]).astype(np.int64),
            face_slot=material[kept],
            slots=tuple(
                Slot(label or "surface", colour, picture=picture)
                for (label, colour), picture in zip(mesh.materials, mesh.pictures, strict=True)
            ),
            face_group=group[kept],
            groups=mesh.groups,
            uv=None if mesh.uv is None else np.nan_to_num(mesh.uv[shown], nan=0.0),
            notes=mesh.notes,
        )
        asset = _flattened(_compact(asset))
        try:
            _ = asset.triangles
        except _core.PolygonFault:
            if triangles:
                raise
            counts = [len(face) - 2 for face in faces]
            places, offsets = _fans(faces)
            material, group = np.repeat(material, counts), np.repeat(group, counts)
            continue
        return asset
    return None


def _flattened(asset: Asset) -> Asset:
    """Flat where it is thinner than `WELD` of its extent: a file's last digits are no thickness,
    and a scope that is filled would stretch them to its own size.
    """
    extent = np.ptp(asset.points_m, axis=0)
    thin = extent < WELD * float(extent.max())
    if not thin.any():
        return asset
    points = asset.points_m.copy()
    points[:, thin] = points[:, thin].mean(axis=0)
    return replace(asset, points_m=points)


def _welded(mesh: ReadMesh) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int32]]:
    extent = float(np.ptp(mesh.points, axis=0).max()) or 1.0
    steps = np.round(mesh.points / (WELD * extent)).astype(np.int64)
    _, first, number = np.unique(steps, axis=0, return_index=True, return_inverse=True)
    joined = first[number.reshape(-1)][mesh.corners].astype(np.int64)
    return joined, mesh.offsets, mesh.face_material


def _has_area(points: NDArray[np.float64]) -> bool:
    if len(points) < 3:
        return False
    crossed = np.cross(points[1:-1] - points[0], points[2:] - points[0]).sum(axis=0)
    longest = float(np.abs(points - points[0]).max())
    return float(np.linalg.norm(crossed)) > 1e-9 * longest * longest > 0.0


def _fans(faces: list[NDArray[np.int64]]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Each face as triangles about its first corner."""
    triangles = [(face[0], face[k], face[k + 1]) for face in faces for k in range(1, len(face) - 1)]
    corners = np.array(triangles, dtype=np.int64).reshape(-1)
    return corners, np.arange(0, len(corners) + 1, 3)


def _compact(asset: Asset) -> Asset:
    """Without points that no face uses: they would widen the box."""
    used, corners = np.unique(asset.corners, return_inverse=True)
    return replace(
        asset, points_m=asset.points_m[used], corners=corners.reshape(-1).astype(np.uint32)
    )
