"""Textures of plainer surfaces and of pieces, against a relief whose colour is known everywhere."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray
from surfaces.painted_relief import camera_at, colour_of, painted, relief, ring_of_views, two_sided

from veduta.place.mesh import Mesh
from veduta.surfaces import carry_texture, own_texture, simplify, texture_mesh
from veduta.surfaces.texturing.charts import TooLargeError
from veduta.surfaces.texturing.sight import colours_at

INNER = np.array([[0.34, 0.33, 0.33], [0.6, 0.2, 0.2], [0.15, 0.7, 0.15], [0.1, 0.3, 0.6]])


def _textured() -> Mesh:
    mesh = relief(48)
    return texture_mesh(mesh, ring_of_views(mesh, (1.0, 1.0, 1.0))).mesh


def _shown(mesh: Mesh) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Places on the triangles, and the colours that the texture has there.

    Not along the wall's border: the photos are black beside it, and soft pixels have both.
    """
    texture = mesh.materials[0].texture
    assert texture is not None
    assert mesh.uv is not None
    height, width = texture.pixels.shape[:2]
    uv = np.einsum("sc,mcd->smd", INNER, mesh.uv[mesh.triangles].astype(float)).reshape(-1, 2)
    corners = mesh.positions_m[mesh.triangles].astype(float)
    places = np.einsum("sc,mcd->smd", INNER, corners).reshape(-1, 3)
    within = (np.abs(places[:, 0]) < 1.7) & (np.abs(places[:, 2]) < 1.2)
    return places[within], colours_at(texture.pixels, uv[within] * [width, height]).astype(float)


@pytest.mark.parametrize(("share", "median", "most"), [(1.0, 2.0, 12.0), (0.25, 6.0, 30.0)])
def test_a_picture_of_its_own_shows_the_same(share: float, median: float, most: float) -> None:
    mesh = _textured()
    chosen = np.flatnonzero(mesh.positions_m[mesh.triangles, 0].mean(axis=1) > 0.7)
    used, corners = np.unique(mesh.triangles[chosen], return_inverse=True)
    assert mesh.uv is not None
    piece = Mesh.simple(
        "piece",
        mesh.positions_m[used],
        corners.reshape(-1, 3),
        uv=mesh.uv[used],
        material=mesh.materials[0],
    )
    own = own_texture(piece, share, 4096)
    before, after = mesh.materials[0].texture, own.materials[0].texture
    assert before is not None
    assert after is not None
    assert after.pixels.size < (0.6 * share**2 + 0.05) * before.pixels.size
    places, colours = _shown(own)
    off = np.abs(colours - colour_of(places)).max(axis=1)
    assert np.median(off) < median
    assert np.quantile(off, 0.99) < most


def test_a_plainer_surface_shows_what_was_painted() -> None:
    mesh = _textured()
    plain = simplify(*_welded(mesh), most=300)
    carried = carry_texture(mesh, plain.positions, plain.triangles)
    corners = carried.positions_m[carried.triangles].astype(float)
    assert np.allclose(corners, plain.positions[plain.triangles], atol=1e-6)
    places, colours = _shown(carried)
    off = np.abs(colours - colour_of(places)).max(axis=1)
    assert np.median(off) < 5.0
    assert np.quantile(off, 0.99) < 30.0
    # What colours of its vertices would show is much worse.
    at_corners = colour_of(carried.positions_m.astype(float))
    even = np.einsum("sc,mcd->smd", INNER, at_corners[carried.triangles]).reshape(-1, 3)
    at = np.einsum("sc,mcd->smd", INNER, corners).reshape(-1, 3)
    assert np.median(np.abs(even - colour_of(at)).max(axis=1)) > 1.5 * np.median(off)


def test_the_unseen_stays_marked_on_a_plainer_surface() -> None:
    mesh = two_sided()
    made = texture_mesh(mesh, [painted(mesh, camera_at("a", (0.4, -4.0, 0.2)))]).mesh
    plain = simplify(*_welded(made), most=400)
    carried = own_texture(carry_texture(made, plain.positions, plain.triangles), 1.0, 512)
    texture = carried.materials[0].texture
    assert texture is not None
    assert carried.uv is not None
    assert max(texture.pixels.shape) <= 512
    height, width = texture.invented.shape
    px = (carried.uv[carried.triangles].mean(axis=1) * [width, height]).astype(int)
    invented = texture.invented[px[:, 1], px[:, 0]]
    behind = carried.positions_m[carried.triangles, 1].mean(axis=1) > 0.25
    assert (invented == behind).mean() > 0.95


def _welded(mesh: Mesh) -> tuple[NDArray[np.float64], NDArray[np.uint32]]:
    points, place = np.unique(mesh.positions_m, axis=0, return_inverse=True)
    return points.astype(np.float64), place.reshape(-1)[mesh.triangles].astype(np.uint32)


def test_a_mesh_without_a_texture_and_too_many_islands_are_refused() -> None:
    with pytest.raises(ValueError, match="has no texture"):
        own_texture(relief(), 1.0, 512)
    with pytest.raises(ValueError, match="has no texture"):
        carry_texture(relief(), np.zeros((3, 3)), np.array([[0, 1, 2]]))
    mesh = _textured()
    with pytest.raises(ValueError, match="no triangle"):
        carry_texture(mesh, np.zeros((3, 3)), np.zeros((0, 3), dtype=int))
    with pytest.raises(TooLargeError, match="do not fit"):
        own_texture(replace(mesh), 1.0, 4)
