"""The texture of a surface whose colour is known."""

from __future__ import annotations

import numpy as np
import pytest
from surfaces.painted_relief import camera_at, colour_of, painted, relief, ring_of_views, two_sided

from veduta.place.mesh import Mesh
from veduta.surfaces import SurfaceView, TextureOptions, texture_mesh
from veduta.surfaces.texturing.charts import TooLargeError
from veduta.surfaces.texturing.sight import colours_at

INNER = np.array([[0.34, 0.33, 0.33], [0.6, 0.2, 0.2], [0.15, 0.7, 0.15], [0.1, 0.3, 0.6]])


def errors(mesh: Mesh, rows: np.ndarray) -> np.ndarray:
    """(n,) how far the texture is from the truth at places of some triangles."""
    texture = mesh.materials[0].texture
    assert texture is not None
    assert mesh.uv is not None
    height, width = texture.pixels.shape[:2]
    found = []
    for weights in INNER:
        uv = np.einsum("c,kcd->kd", weights, mesh.uv[mesh.triangles[rows]].astype(float))
        places = np.einsum(
            "c,kcd->kd", weights, mesh.positions_m[mesh.triangles[rows]].astype(float)
        )
        shown = colours_at(texture.pixels, uv * [width, height])
        found.append(np.abs(shown - colour_of(places)).max(axis=1))
    return np.concatenate(found)


def test_the_texture_is_what_was_painted() -> None:
    mesh = relief()
    made = texture_mesh(mesh, ring_of_views(mesh, (1.0, 1.0, 1.0)))
    assert made.seen_share == 1.0
    assert set(np.unique(made.view_of)) <= {0, 1, 2}
    off = errors(made.mesh, np.arange(len(mesh.triangles)))
    assert np.median(off) < 1.5
    assert np.quantile(off, 0.99) < 5.0
    assert len(made.mesh.triangles) == len(mesh.triangles)
    np.testing.assert_allclose(
        made.mesh.positions_m[made.mesh.triangles], mesh.positions_m[mesh.triangles]
    )


def test_views_of_other_brightness_are_levelled() -> None:
    mesh = relief()
    made = texture_mesh(mesh, ring_of_views(mesh, (0.9, 1.1, 0.95, 1.05)))
    assert made.charts >= 2
    assert made.seam_before > 8.0
    assert made.seam_after < 0.2 * made.seam_before
    assert np.median(errors(made.mesh, np.arange(len(mesh.triangles)))) < 12.0


def test_what_is_behind_is_not_textured_through() -> None:
    mesh = two_sided()
    half = len(mesh.triangles) // 2
    views = [painted(mesh, camera_at("a", (0.4, -4.0, 0.2)))]
    made = texture_mesh(mesh, views)
    assert (made.view_of[:half] == 0).mean() > 0.97
    assert (made.view_of[half:] == -1).all()
    texture = made.mesh.materials[0].texture
    assert texture is not None
    assert made.mesh.uv is not None
    height, width = texture.invented.shape
    px = (made.mesh.uv[made.mesh.triangles].mean(axis=1) * [width, height]).astype(int)
    invented = texture.invented[px[:, 1], px[:, 0]]
    np.testing.assert_array_equal(invented, made.view_of == -1)


def test_what_passes_by_is_voted_out() -> None:
    mesh = relief()
    views = ring_of_views(mesh, (1.0,) * 5)
    pixels = views[2].read().copy()
    pixels[50:110, 80:120] = (255, 0, 255)
    views[2] = SurfaceView(views[2].camera, lambda: pixels)
    made = texture_mesh(mesh, views)
    off = errors(made.mesh, np.arange(len(mesh.triangles)))
    assert (off > 60.0).mean() < 0.01


def test_a_mask_is_respected() -> None:
    mesh = relief()
    first, second = ring_of_views(mesh, (1.0, 1.0))
    mask = np.ones((160, 200), dtype=bool)
    masked = SurfaceView(first.camera, first.read, lambda: mask)
    made = texture_mesh(mesh, [masked, second])
    assert not (made.view_of == 0).any()


def test_the_unseen_takes_the_colours_around() -> None:
    mesh = relief()
    mask = np.zeros((160, 200), dtype=bool)
    mask[70:90, 90:110] = True
    view = painted(mesh, camera_at("a", (0.2, -4.0, 0.1)))
    made = texture_mesh(mesh, [SurfaceView(view.camera, view.read, lambda: mask)])
    hidden = np.flatnonzero(made.view_of == -1)
    assert 10 < len(hidden) < 200
    assert np.median(errors(made.mesh, hidden)) < 30.0


def test_the_atlas_is_made_coarser_until_it_fits() -> None:
    mesh = relief()
    views = ring_of_views(mesh, (1.0, 1.0))
    fine = texture_mesh(mesh, views)
    coarse = texture_mesh(mesh, views, TextureOptions(largest_px=96))
    texture = coarse.mesh.materials[0].texture
    assert texture is not None
    assert max(texture.pixels.shape) <= 96
    assert coarse.texel_m > 1.5 * fine.texel_m
    with pytest.raises(TooLargeError):
        texture_mesh(mesh, views, TextureOptions(largest_px=4))


def test_no_view_and_no_triangle() -> None:
    mesh = relief(4)
    made = texture_mesh(mesh, [])
    assert made.seen_share == 0.0
    texture = made.mesh.materials[0].texture
    assert texture is not None
    assert texture.invented.all()
    empty = Mesh.simple("none", np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64))
    with pytest.raises(ValueError, match="no triangle"):
        texture_mesh(empty, [])


def test_the_same_comes_out_twice() -> None:
    mesh = relief(12)
    views = ring_of_views(mesh, (1.0, 0.9, 1.1))
    one, two = texture_mesh(mesh, views), texture_mesh(mesh, views)
    np.testing.assert_array_equal(one.view_of, two.view_of)
    first, second = one.mesh.materials[0].texture, two.mesh.materials[0].texture
    assert first is not None
    assert second is not None
    np.testing.assert_array_equal(first.pixels, second.pixels)
