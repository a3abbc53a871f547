"""A relief and a box behind it, whose colour is known everywhere, as cameras see it."""

from __future__ import annotations

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from numpy.typing import NDArray

from veduta.cameras import Camera
from veduta.place.mesh import Mesh
from veduta.surfaces import SurfaceView

Floats = NDArray[np.float64]


def colour_of(places: Floats) -> Floats:
    """(n, 3) colour, 40 to 215, of (n, 3) places: waves along all axes."""
    x, y, z = places.T
    waves = np.stack(
        [np.sin(3.0 * x + z), np.sin(2.5 * z - x + 1.0), np.sin(2.0 * x + 2.0 * z + y)], axis=1
    )
    return 127.5 + 87.0 * waves


def relief(cells: int = 24) -> Mesh:
    """A wall 4 x 3 units in the plane y = 0 that faces -y, with waves; counter-clockwise."""
    x, z = np.meshgrid(np.linspace(-2, 2, cells + 1), np.linspace(-1.5, 1.5, cells + 1))
    y = 0.15 * np.sin(2.5 * x) * np.cos(2.0 * z)
    places = np.stack([x.ravel(), y.ravel(), z.ravel()], axis=1)
    row, column = np.meshgrid(np.arange(cells), np.arange(cells), indexing="ij")
    first = (row * (cells + 1) + column).ravel()
    right, up = first + 1, first + cells + 1
    lower = np.stack([first, right, up + 1], axis=1)
    upper = np.stack([first, up + 1, up], axis=1)
    return Mesh.simple("relief", places, np.concatenate([lower, upper]))


def two_sided(cells: int = 24) -> Mesh:
    """The relief, and the same turned round half a unit behind: nobody sees that one."""
    front = relief(cells)
    behind = front.positions_m + np.array([0.0, 0.5, 0.0], dtype=np.float32)
    count = len(front.positions_m)
    back = front.triangles[:, ::-1] + np.uint32(count)
    return Mesh.simple(
        "both",
        np.concatenate([front.positions_m, behind]),
        np.concatenate([front.triangles, back]),
    )


def camera_at(name: str, centre: tuple[float, float, float], focal_px: float = 170.0) -> Camera:
    """It looks at the middle of the wall, upright, 200 x 160 px."""
    place = np.array(centre)
    forward = -place / np.linalg.norm(place)
    right = np.cross(forward, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    turn = np.array([right, np.cross(forward, right), forward])
    pose = np.column_stack([turn, -turn @ place])
    return Camera(name, 200, 160, (focal_px, focal_px), (100.0, 80.0), pose)


def painted(mesh: Mesh, camera: Camera, gain: float = 1.0, offset: float = 0.0) -> SurfaceView:
    """What the camera sees of the mesh, brighter by a gain and an offset; black beside it."""
    scene = EmbreeScene()
    TriangleMesh(scene, mesh.positions_m, mesh.triangles.astype(np.int32))
    x, y = np.meshgrid(np.arange(camera.width_px) + 0.5, np.arange(camera.height_px) + 0.5)
    origin, rays = camera.rays(np.stack([x.ravel(), y.ravel()], axis=1))
    start = np.repeat(origin[None].astype(np.float32), len(rays), axis=0)
    far = scene.run(start, rays.astype(np.float32), query="DISTANCE").astype(np.float64)
    hit = far < 1e3
    colours = np.zeros((len(rays), 3))
    colours[hit] = colour_of(origin + rays[hit] * far[hit, None]) * gain + offset
    shape = (camera.height_px, camera.width_px, 3)
    pixels = np.clip(np.rint(colours), 0, 255).astype(np.uint8).reshape(shape)
    return SurfaceView(camera, lambda: pixels)


def ring_of_views(mesh: Mesh, gains: tuple[float, ...]) -> list[SurfaceView]:
    """Views before the wall, from left to right, each with its own brightness."""
    middle = 0.5 * (len(gains) - 1)
    return [
        painted(mesh, camera_at(f"v{n}", (1.3 * (n - middle), -4.0, 0.3 * (n % 2))), gain)
        for n, gain in enumerate(gains)
    ]
