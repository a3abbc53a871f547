"""The moving picture of `docs/fauna.md`: an animal read from a drawn film walks over a hill.

`python docs/fauna_picture.py` writes `docs/images/fauna.webp`. The film is made by code
(`veduta.synthetic.animals`); the frames are drawn by casting rays.
"""

from __future__ import annotations

import tempfile
from pathlib import Path

import cv2
import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from numpy.typing import NDArray
from PIL import Image
from scipy.spatial.transform import Rotation

from veduta.fauna.build.limbed import build_limbed
from veduta.fauna.build.walker import limbed_walker
from veduta.fauna.command import run_fauna
from veduta.fauna.document.coat import load_coat
from veduta.fauna.document.limbed import LimbedAnimal
from veduta.fauna.document.load import load_animal
from veduta.fauna.motion.carried import composed
from veduta.fauna.motion.transfer import TransferLooks, walked
from veduta.fauna.options import AnimalOptions, FaunaOptions
from veduta.fauna.recipe import Record
from veduta.place.material import Texture
from veduta.place.mesh import Mesh
from veduta.place.skin import Clip, Skin
from veduta.run.progress import Progress
from veduta.synthetic.animals import film_quadruped

PICTURE = Path(__file__).parent / "images" / "fauna.webp"
SIZE = (270, 480)
EVERY, MS = 3, 100
"""Keys of the clip between two pictures, and how long each is shown."""
SUN = np.array([-0.45, -0.55, 0.7])
Floats = NDArray[np.float64]


def main() -> None:
    """Film, read, walk, and write the frames."""
    with tempfile.TemporaryDirectory() as name:
        animal, coat = _animal(Path(name))
    built = build_limbed(animal, coat)
    walker = limbed_walker(built)
    if walker is None or built.mesh.skin is None:
        raise SystemExit("the film holds no gait")
    x = np.linspace(-3.2, 3.2, 90)
    flat = np.column_stack([x, 0.9 * np.sin(0.75 * x)])
    path = np.column_stack([flat, _hill(flat)])
    done = walked(walker, path, _hill, closed=False, looks=TransferLooks())
    scene = _Ground()
    rows = range(0, len(done.clip.times_s), EVERY)
    pictures = [scene.picture(built.mesh, _skinned(built.mesh, built.mesh.skin, done.clip, row))
                for row in rows]  # fmt: skip
    frames = [Image.fromarray(picture) for picture in pictures]
    frames[0].save(
        PICTURE, save_all=True, append_images=frames[1:], duration=MS, loop=0, quality=60, method=4
    )
    print(f"{len(frames)} pictures, {PICTURE.stat().st_size / 1e6:.2f} MB,"
          f" feet slide {done.slides_m:.4f} m and sink {done.sinks_m:.4f} m")  # fmt: skip


def _animal(folder: Path) -> tuple[LimbedAnimal, Texture | None]:
    filmed = film_quadruped(100, frames=22, cycle=16.0)
    frames = folder / "quadruped"
    frames.mkdir()
    for row, frame in enumerate(filmed.frames):
        cv2.imwrite(str(frames / f"{row:03d}.png"), frame[..., ::-1])
    options = FaunaOptions(animal=AnimalOptions(kind="quadruped", length_m=1.1))
    run_fauna(Record(frames), folder / "out", options, Progress(quiet=True))
    animal = load_animal(folder / "out" / "animal.json")
    if not isinstance(animal, LimbedAnimal):
        raise SystemExit("the film holds no animal with legs")
    return animal, load_coat(folder / "out" / "coat.png")


def _hill(places: Floats) -> Floats:
    x, y = places[:, 0], places[:, 1]
    rough = 0.03 * np.sin(5.1 * x + 1.0) * np.cos(4.3 * y) + 0.02 * np.sin(9.0 * x - 6.0 * y)
    return np.asarray(0.55 * np.exp(-((x - 0.3) ** 2 + (0.7 * y) ** 2) / 1.6) + rough)


def _skinned(mesh: Mesh, skin: Skin, clip: Clip, row: int) -> Floats:
    """(v, 3) the vertices at a key."""
    turns = Rotation.from_quat(clip.rotations_xyzw[row]).as_matrix()[None]
    joints = composed(skin, turns, clip.translations_m[row][None])
    points = mesh.positions_m.astype(np.float64)
    found = np.zeros_like(points)
    for slot in range(4):
        own = skin.joints[:, slot]
        away = points - skin.rest[own, :3, 3]
        moved = np.einsum("vij,vj->vi", joints.turns[0][own], away) + joints.places[0][own]
        found += skin.weights[:, slot, None] * moved
    return found


class _Ground:
    """The hill, and a camera that looks at it."""

    def __init__(self) -> None:
        side = np.linspace(-9.0, 9.0, 361)
        grid = np.stack(np.meshgrid(side, side), axis=-1).reshape(-1, 2)
        self.points = np.column_stack([grid, _hill(grid)])
        number = np.arange(361 * 361).reshape(361, 361)
        a, b, c, d = number[:-1, :-1], number[:-1, 1:], number[1:, :-1], number[1:, 1:]
        self.faces = np.concatenate(
            [np.stack(t, axis=-1).reshape(-1, 3) for t in ((a, b, d), (a, d, c))]
        )
        eye, target = np.array([0.6, -5.6, 2.1]), np.array([0.0, 0.0, 0.35])
        ahead = (target - eye) / np.linalg.norm(target - eye)
        right = np.cross(ahead, [0.0, 0.0, 1.0])
        right /= np.linalg.norm(right)
        down = np.cross(ahead, right)
        height, width = SIZE
        u, v = np.meshgrid(np.arange(2 * width) + 0.5, np.arange(2 * height) + 0.5)
        x, y = (u / (2 * width) - 0.5) * 1.25, (v / (2 * height) - 0.5) * 1.25 * height / width
        rays = ahead + x[..., None] * right + y[..., None] * down
        self.rays = (rays / np.linalg.norm(rays, axis=-1, keepdims=True)).reshape(-1, 3)
        self.eye = eye

    def picture(self, mesh: Mesh, animal: Floats) -> NDArray[np.uint8]:
        """(h, w, 3) with a sun, its shadow, and the animal's coat."""
        faces = mesh.triangles.astype(np.int64)
        points = np.concatenate([self.points, animal])
        corners = points[np.concatenate([self.faces, faces + len(self.points)])]
        scene = EmbreeScene()
        TriangleMesh(scene, corners.astype(np.float32))
        eyes = np.tile(self.eye, (len(self.rays), 1))
        hit = scene.run(eyes.astype(np.float32), self.rays.astype(np.float32), output=1)
        which, far = hit["primID"].astype(np.int64), hit["tfar"].astype(np.float64)
        seen = which >= 0
        where = self.eye + self.rays * np.where(seen, far, 0.0)[:, None]
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-12)
        facing = normal[which] * -np.sign((normal[which] * self.rays).sum(axis=1))[:, None]
        sun = SUN / np.linalg.norm(SUN)
        away = np.tile(sun, (len(where), 1)).astype(np.float32)
        begin = where + 2e-3 * facing
        dark = scene.run(begin.astype(np.float32), away, output=1)["primID"] >= 0
        light = 0.45 + 0.6 * np.maximum(facing @ sun, 0.0) * ~dark
        colour = self._colours(mesh, which, hit, where)
        sky = np.array([198.0, 214.0, 232.0]) - 60.0 * np.clip(self.rays[:, 2:], 0.0, 1.0)
        fog = np.clip(far / 16.0, 0.0, 1.0)[:, None] ** 2
        lit = np.where(seen[:, None], colour * light[:, None] * (1.0 - fog) + sky * fog, sky)
        large = np.clip(lit, 0.0, 255.0).reshape(2 * SIZE[0], 2 * SIZE[1], 3).astype(np.uint8)
        return np.asarray(cv2.resize(large, SIZE[::-1], interpolation=cv2.INTER_AREA))

    def _colours(
        self, mesh: Mesh, which: NDArray[np.int64], hit: dict[str, NDArray[np.float32]],
        where: Floats,
    ) -> Floats:  # fmt: skip
        grass = np.array([112.0, 130.0, 78.0])
        grain = np.sin(23.0 * where[:, 0]) * np.sin(19.0 * where[:, 1] + 2.0 * where[:, 0])
        colour = grass + 9.0 * grain[:, None] * np.array([1.0, 1.0, 0.6])
        own = which >= len(self.faces)
        texture = mesh.materials[0].texture
        if texture is None or mesh.uv is None or not own.any():
            return np.asarray(colour)
        corners = mesh.uv[mesh.triangles[which[own] - len(self.faces)]]
        u, v = hit["u"][own, None], hit["v"][own, None]
        uv = corners[:, 0] * (1.0 - u - v) + corners[:, 1] * u + corners[:, 2] * v
        height, width = texture.pixels.shape[:2]
        column = np.clip((uv[:, 0] * width).astype(int), 0, width - 1)
        row = np.clip((uv[:, 1] * height).astype(int), 0, height - 1)
        colour[own] = texture.pixels[row, column]
        return np.asarray(colour)


if __name__ == "__main__":
    main()
