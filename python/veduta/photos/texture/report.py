"""What the report says of textures: how much of the model photos show, how finely; a picture."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Sequence
from typing import Any

import cv2
import numpy as np

from veduta.photos.report_pictures import jpeg
from veduta.photos.texture.compose import FaceTexture
from veduta.photos.texture.faces import Face
from veduta.photos.texture.recipe import TexturedModel
from veduta.run.page import Picture, Table

SHEET_PX, TALLEST_PX, MOST_SHOWN = 1200, 320, 12
GAP_PX = 8
MARK = (214, 60, 160)
"""The colour of what is invented, hatched over it."""


def texture_measures(model: TexturedModel) -> dict[str, Any]:
    """The textures in numbers; shares by area."""
    made = _made(model)
    area = sum(face.area_m2 for face in model.faces)
    seen = sum(face.area_m2 * texture.seen_share for face, texture in made)
    whole = sum(face.area_m2 for face, _ in made)
    texel = sum(face.area_m2 * texture.texel_m for face, texture in made)
    return {
        "faces": len(model.faces),
        "faces_textured": len(made),
        "texture_seen_share": round(seen / max(area, 1e-9), 4),
        "texture_seen_share_of_textured": round(seen / max(whole, 1e-9), 4),
        "texel_mean_m": round(texel / max(whole, 1e-9), 4),
        "texture_photos": len({view for _, texture in made for view in texture.views}),
    }


def texture_line(measures: dict[str, Any]) -> str:
    """For a person."""
    return (
        f"{measures['faces_textured']} of {measures['faces']} faces textured by"
        f" {measures['texture_photos']} photos, {measures['texel_mean_m'] * 100:.1f} cm per texel;"
        f" photos show {measures['texture_seen_share_of_textured']:.0%} of them"
    )


def texture_tables(model: TexturedModel, names: Sequence[str]) -> list[Table]:
    """Per building what is textured; per photo what its light was multiplied with."""
    rows: list[list[float | int | str | None]] = []
    faces = Counter(face.building for face in model.faces)
    textured: dict[int, list[tuple[Face, FaceTexture]]] = defaultdict(list)
    for face, texture in _made(model):
        textured[face.building].append((face, texture))
    for number, own in sorted(textured.items()):
        building = model.buildings[number]
        area = sum(face.area_m2 for face, _ in own)
        seen = sum(face.area_m2 * texture.seen_share for face, texture in own)
        texel = float(np.median([texture.texel_m for _, texture in own]))
        rows.append(
            [building.id, faces[number], len(own), round(seen / area, 3), round(100 * texel, 2)]
        )
    columns = ("building", "faces", "textured", "share of them seen", "texel cm")
    note = "What photos do not show is filled with a plain colour and white in the masks."
    gains: list[list[float | int | str | None]] = [
        [name, *(round(float(value), 3) for value in gain)]
        for name, gain in zip(names, model.gains, strict=True)
    ]
    light = "What the linear light of each photo was multiplied with, so that all agree."
    return [
        Table("Textures", columns, rows, note=note),
        Table("Light", ("photo", "red", "green", "blue"), gains, note=light, for_experts=True),
    ]


def texture_picture(model: TexturedModel) -> Picture:
    """The largest textures side by side; hatched where nothing was seen."""
    largest = sorted(_made(model), key=lambda one: -one[0].area_m2 * one[1].seen_share)
    rows: list[list[np.ndarray]] = [[]]
    for _, texture in largest[:MOST_SHOWN]:
        tile = _tile(texture)
        used = sum(one.shape[1] + GAP_PX for one in rows[-1])
        if rows[-1] and used + tile.shape[1] > SHEET_PX:
            rows.append([])
        rows[-1].append(tile)
    heights = [max(tile.shape[0] for tile in row) for row in rows]
    sheet = np.full((sum(heights) + GAP_PX * len(rows), SHEET_PX, 3), 255, dtype=np.uint8)
    top = 0
    for row, height in zip(rows, heights, strict=True):
        left = 0
        for tile in row:
            sheet[top : top + tile.shape[0], left : left + tile.shape[1]] = tile
            left += tile.shape[1] + GAP_PX
        top += height + GAP_PX
    note = "The faces that photos show most of; hatched is what none shows, and was made up."
    return Picture("Textures", note, jpeg(sheet), "image/jpeg")


def _tile(texture: FaceTexture) -> np.ndarray:
    pixels = texture.pixels.copy()
    y, x = np.indices(texture.invented.shape)
    pixels[texture.invented & ((x + y) % 16 < 3)] = MARK
    height, width = pixels.shape[:2]
    scale = min(1.0, TALLEST_PX / height, SHEET_PX / width)
    size = (max(1, round(scale * width)), max(1, round(scale * height)))
    return np.asarray(cv2.resize(pixels, size, interpolation=cv2.INTER_AREA), dtype=np.uint8)


def _made(model: TexturedModel) -> list[tuple[Face, FaceTexture]]:
    return [
        (face, texture)
        for face, texture in zip(model.faces, model.textures, strict=True)
        if texture is not None
    ]
