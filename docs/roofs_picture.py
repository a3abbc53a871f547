"""Makes the picture of docs/roofs.md, every type on two outlines: part of `make pictures`."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import trimesh
from numpy.typing import NDArray
from PIL import Image, ImageDraw

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "benchmarks" / "measuring"))

from roof_checks import TYPES, Outline, outline, solid  # noqa: E402

from veduta import _core  # noqa: E402

OUT = ROOT / "docs" / "images" / "roofs.png"
COLUMNS = 6
CELL_PX = (300, 210)
LABEL_PX = 22
SUPERSAMPLED = 3
WALL_M = 3.0
VIEW_RAD = (np.radians(-52.0), np.radians(38.0))
"""Where the camera stands: turned from south to west, and above the horizon."""
COLOURS = {"slope": (186, 92, 64), "upright": (226, 205, 170), "wall": (205, 200, 190)}
INK = (60, 50, 45)
SHOWN: dict[str, tuple[float, dict[str, float]]] = {
    "shed": (0.3, {"edge": 5}),
    "skillion": (0.3, {"direction_rad": -1.9}),
    "ridge": (0.6, {}),
    "mansard": (2.5, {"knee_m": 2.2}),
    "gambrel": (2.0, {"knee_m": 2.2}),
    "butterfly": (0.35, {}),
    "sawtooth": (0.7, {}),
    "cross-gable": (0.7, {}),
    "onion": (1.0, {"height_m": 9.0}),
}
"""Slope and numbers with which a type shows what it is; the others as in the checks."""


def outlines() -> tuple[Outline, Outline]:
    """An L, and a house with a court, a round end, a bay and walls that are no right angles."""
    wings = [[(0, 0), (16, 0), (16, 7), (7, 7), (7, 14), (0, 14)]]
    turn = np.linspace(-np.pi / 2, np.pi / 2, 9)[1:-1]
    round_end = [(19 + 5 * np.cos(a), 5 + 5 * np.sin(a)) for a in turn]
    outer = [(0, 0), (6, 0), (6.8, -1.2), (9.2, -1.2), (10, 0), (19, 0), *round_end]
    outer += [(19, 10), (16, 10), (18, 19), (9, 20), (8.5, 15.5), (1, 16)]
    court = [(5, 5), (5, 11), (12, 11.5), (12, 5)]
    return outline("L", wings), outline("difficult", [outer, court])


def walls(over: Outline) -> trimesh.Trimesh:
    """Below the roof, with a lid."""
    points = np.column_stack([over.points_m, np.zeros(len(over.points_m))])
    lower = points - [0, 0, WALL_M]
    faces = []
    for first, end in zip(over.ring_offsets, over.ring_offsets[1:], strict=False):
        ring = np.arange(first, end)
        after = np.roll(ring, -1)
        count = len(points)
        faces += [np.column_stack([ring + count, after + count, after])]
        faces += [np.column_stack([ring + count, after, ring])]
    polygon = np.array([0, len(over.ring_offsets) - 1])
    faces.append(_core.triangulate_polygons(points, over.ring_offsets, polygon, 1e-6)[0])
    return trimesh.Trimesh(np.concatenate([points, lower]), np.concatenate(faces), process=False)


def drawn(kind: str, over: Outline) -> Image.Image:
    """The roof over its walls, in parallel projection."""
    slope, numbers = SHOWN.get(kind, (0.9, {}))
    roof, base = solid(kind, over, slope, numbers), walls(over)
    points = np.concatenate([roof.vertices, base.vertices])
    faces = np.concatenate([roof.faces, base.faces + len(roof.vertices)])
    scene = trimesh.Trimesh(points, faces, process=False)
    turn, up = VIEW_RAD
    right = np.array([np.cos(turn), np.sin(turn), 0.0])
    towards = np.array([np.sin(turn) * np.cos(up), -np.cos(turn) * np.cos(up), np.sin(up)])
    above = np.cross(towards, right)
    frame = np.stack([right, above, towards])
    width, height = (SUPERSAMPLED * size for size in CELL_PX)
    spread = np.vstack([scene.vertices, [[0, 0, 6.0]]]) @ frame.T
    low, high = spread.min(axis=0), spread.max(axis=0)
    scale = max((high[0] - low[0]) / width, (high[1] - low[1]) / height) * 1.06
    middle = 0.5 * (low + high)
    columns, rows = np.meshgrid(np.arange(width), np.arange(height))
    x = middle[0] + (columns.ravel() + 0.5 - width / 2) * scale
    y = middle[1] - (rows.ravel() + 0.5 - height / 2) * scale
    starts = np.column_stack([x, y, np.full(x.size, high[2] + 1.0)]) @ frame
    hit, ray = _hits(scene, starts, -towards)
    normals = scene.face_normals[hit]
    light = np.array([-0.35, -0.5, 0.8])
    lit = 0.55 + 0.45 * np.clip(normals @ (light / np.linalg.norm(light)), 0, 1)
    upright = np.abs(scene.face_normals[:, 2]) < 1e-6
    names = np.where(np.arange(len(scene.faces)) >= len(roof.faces), 2, upright.astype(int))
    palette = np.array([COLOURS["slope"], COLOURS["upright"], COLOURS["wall"]], dtype=np.float64)
    pixels = np.full((height * width, 3), 255.0)
    pixels[ray] = palette[names[hit]] * lit[:, None]
    _ink(pixels, scene, hit, ray, (height, width))
    image = Image.fromarray(pixels.reshape(height, width, 3).astype(np.uint8))
    return image.resize(CELL_PX, Image.Resampling.LANCZOS)


def _hits(
    scene: trimesh.Trimesh, starts: NDArray[np.float64], way: NDArray[np.float64]
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """The first triangle that each ray meets, and the rays that meet one."""
    from embreex.mesh_construction import TriangleMesh
    from embreex.rtcore_scene import EmbreeScene

    tracer = EmbreeScene()
    TriangleMesh(tracer, scene.triangles.astype(np.float32))
    ways = np.tile(way.astype(np.float32), (len(starts), 1))
    found = np.asarray(tracer.run(starts.astype(np.float32), ways))
    ray = np.flatnonzero(found >= 0)
    return found[ray].astype(np.int64), ray


def _ink(
    pixels: NDArray[np.float64],
    scene: trimesh.Trimesh,
    hit: NDArray[np.int64],
    ray: NDArray[np.int64],
    shape: tuple[int, int],
) -> None:
    """Lines where neighbouring pixels lie in different planes."""
    planes = np.full((*shape, 4), np.inf)
    normals = scene.face_normals[hit]
    offsets = (normals * scene.triangles[hit, 0]).sum(axis=1)
    planes.reshape(-1, 4)[ray] = np.column_stack([normals, 0.2 * offsets])
    edge = np.zeros(shape, dtype=bool)
    for axis in (0, 1):
        one, other = np.delete(planes, -1, axis), np.delete(planes, 0, axis)
        with np.errstate(invalid="ignore"):
            differ = np.abs(one - other).max(axis=2) > 0.02
        both_empty = np.isinf(one[..., 0]) & np.isinf(other[..., 0])
        part = differ & ~both_empty
        edge |= np.pad(part, [(0, int(axis == 0)), (0, int(axis == 1))])
    pixels.reshape(*shape, 3)[edge] = INK


def main() -> None:
    """All types, each on both outlines."""
    pairs = -(-len(TYPES) // COLUMNS)
    cell_width, cell_height = CELL_PX
    pair_height = 2 * cell_height + LABEL_PX
    sheet = Image.new("RGB", (COLUMNS * cell_width, pairs * pair_height), "white")
    pen = ImageDraw.Draw(sheet)
    for index, kind in enumerate(TYPES):
        left, top = index % COLUMNS * cell_width, index // COLUMNS * pair_height
        pen.text((left + cell_width / 2, top + LABEL_PX / 2), kind, fill=INK, anchor="mm")
        for row, over in enumerate(outlines()):
            try:
                picture = drawn(kind, over)
            except ValueError as fault:
                at = (left + cell_width / 2, top + LABEL_PX + (row + 0.5) * cell_height)
                pen.text(
                    at, "does not apply:\nno place in sight\nof all edges", fill=INK, anchor="mm"
                )
                print(f"{kind} over {over.name}: {fault}")
                continue
            sheet.paste(picture, (left, top + LABEL_PX + row * cell_height))
    OUT.parent.mkdir(exist_ok=True)
    sheet.quantize(128).save(OUT, optimize=True)
    print(f"{OUT}: {OUT.stat().st_size} bytes")


if __name__ == "__main__":
    main()
