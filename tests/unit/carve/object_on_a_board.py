"""A small body on a printed board, on a table: photos with known cameras, in metres."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import trimesh
from numpy.typing import NDArray
from turned_object import body

from veduta import _core
from veduta.cameras import Board, Camera
from veduta.carve.views import camera_rows

SIZE, FOCAL, AWAY_M = (800, 600), 1000.0, 0.5
DOTS_PER_M = 8000.0


def small_body() -> trimesh.Trimesh:
    """The body, 4 cm wide, standing on the sheet."""
    mesh = body()
    mesh.apply_scale(0.2)
    mesh.apply_translation([0.0, 0.0, -mesh.bounds[0, 2]])
    return mesh


def cameras_around(count: int) -> list[Camera]:
    """Cameras about the sheet's normal, by turns higher and lower, that look at its middle."""
    cameras = []
    for number in range(count):
        angle, height = 2.0 * np.pi * number / count, (0.9, 0.6)[number % 2]
        back = np.array(
            [np.cos(angle) * np.cos(height), np.sin(angle) * np.cos(height), np.sin(height)]
        )
        right = np.array([-np.sin(angle), np.cos(angle), 0.0])
        turn = np.array([right, np.cross(-back, right), -back])
        shift = -turn @ (AWAY_M * back + [0.0, 0.0, 0.02])
        half = (SIZE[0] / 2.0, SIZE[1] / 2.0)
        pose = np.column_stack([turn, shift])
        cameras.append(Camera(f"seen{number:02d}.png", *SIZE, (FOCAL, FOCAL), half, pose))
    return cameras


def photo_of(
    camera: Camera, board: Board, mesh: trimesh.Trimesh
) -> tuple[NDArray[np.uint8], NDArray[np.bool_]]:
    """(h, w, 3) BGR, and where the body is in it."""
    width, height = board.size_m
    sheet = board.drawn(DOTS_PER_M)
    metres = np.array(
        [[1.0, 0.0, -width * DOTS_PER_M / 2.0], [0.0, -1.0, height * DOTS_PER_M / 2.0]]
    )
    on_plane = np.vstack([metres / DOTS_PER_M, [0.0, 0.0, 1.0]])
    plane = camera.projection()[:, [0, 1, 3]] @ on_plane
    half = np.array([[1.0, 0.0, -0.5], [0.0, 1.0, -0.5], [0.0, 0.0, 1.0]])
    warp = half @ plane @ np.linalg.inv(half)
    table = np.full((*SIZE[::-1], 3), (70, 110, 150), np.uint8)
    coloured = cv2.merge([sheet, sheet, sheet])
    shown = cv2.warpPerspective(coloured, warp, SIZE, flags=cv2.INTER_AREA)
    inside = cv2.warpPerspective(np.full_like(sheet, 255), warp, SIZE) > 127
    photo = np.where(inside[..., None], shown, table)
    seen = _core.seen_triangles(
        camera_rows([camera]),
        [SIZE],
        np.asarray(mesh.vertices, dtype=np.float64),
        np.asarray(mesh.faces, dtype=np.uint32),
    )[0]
    normals = np.asarray(mesh.face_normals)
    colours = (np.array([40.0, 60.0, 190.0]) * (0.75 + 0.25 * normals[:, 2:3])).astype(np.uint8)
    photo = np.where((seen >= 0)[..., None], colours[seen.clip(0)], photo)
    noise = np.random.default_rng(5).normal(0.0, 2.0, photo.shape)
    return (cv2.GaussianBlur(photo, (0, 0), 0.6) + noise).clip(0, 255).astype(np.uint8), seen >= 0


def write_photos(folder: Path, count: int, board: Board, *, masks: bool) -> list[Camera]:
    """A folder of them, with masks where they are wanted."""
    folder.mkdir(parents=True)
    mesh = small_body()
    for camera in cameras_around(count):
        photo, mask = photo_of(camera, board, mesh)
        cv2.imwrite(str(folder / camera.name), photo)
        if masks:
            (folder / "masks").mkdir(exist_ok=True)
            cv2.imwrite(str(folder / "masks" / camera.name), mask.astype(np.uint8) * 255)
    return cameras_around(count)
