"""What the report says of textures: how much of the model photos show, how finely; a picture."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.photos.report_pictures import jpeg
from veduta.photos.texture.compose import FaceTexture
from veduta.photos.texture.part import TexturedBuilding
from veduta.run.page import Picture, Table

Cell = float | int | str | None
SHEET_PX, TALLEST_PX, MOST_SHOWN = 1200, 320, 12
GAP_PX = 8
MARK = (214, 60, 160)
"""The colour of what is invented, hatched over it."""


@dataclass
class TextureTold:
    """What is told of textured buildings, one by one: numbers, rows of tables, small pictures.

    photos: their names. gains: (photos, 3).
    """

    photos: Sequence[str]
    gains: NDArray[np.float64]
    buildings: int = 0
    faces: int = 0
    textured: int = 0
    area_m2: float = 0.0
    whole_m2: float = 0.0
    seen_m2: float = 0.0
    texel: float = 0.0
    views: set[int] = field(default_factory=set)
    rows: list[tuple[int, list[Cell]]] = field(default_factory=list)
    tiles: list[tuple[float, NDArray[np.uint8]]] = field(default_factory=list)

    def take(self, building: TexturedBuilding) -> None:
        """Take one building."""
        made = [(face, texture) for face, texture in building.faces if texture is not None]
        whole = sum(face.area_m2 for face, _ in made)
        seen = sum(face.area_m2 * texture.seen_share for face, texture in made)
        self.buildings += 1
        self.faces += len(building.faces)
        self.textured += len(made)
        self.area_m2 += sum(face.area_m2 for face, _ in building.faces)
        self.whole_m2 += whole
        self.seen_m2 += seen
        self.texel += sum(face.area_m2 * texture.texel_m for face, texture in made)
        self.views |= {view for _, texture in made for view in texture.views}
        texel = float(np.median([texture.texel_m for _, texture in made]))
        row: list[Cell] = [building.id, len(building.faces), len(made)]
        self.rows.append((building.row, [*row, round(seen / whole, 3), round(100 * texel, 2)]))
        for face, texture in made:
            rank = face.area_m2 * texture.seen_share
            if len(self.tiles) < MOST_SHOWN or rank > self.tiles[-1][0]:
                self.tiles.append((rank, _tile(texture)))
                self.tiles.sort(key=lambda one: -one[0])
                del self.tiles[MOST_SHOWN:]

    def measures(self, plain: int) -> dict[str, Any]:
        """The textures in numbers; shares by area. plain: buildings that no photo shows."""
        return {
            "buildings_textured": self.buildings,
            "buildings_plain": plain,
            "faces": self.faces,
            "faces_textured": self.textured,
            "texture_seen_share": round(self.seen_m2 / max(self.area_m2, 1e-9), 4),
            "texture_seen_share_of_textured": round(self.seen_m2 / max(self.whole_m2, 1e-9), 4),
            "texel_mean_m": round(self.texel / max(self.whole_m2, 1e-9), 4),
            "texture_photos": len(self.views),
        }

    def tables(self) -> list[Table]:
        """Per building what is textured; per photo what its light was multiplied with."""
        columns = ("building", "faces", "textured", "share of them seen", "texel cm")
        note = "What photos do not show is filled with a plain colour and white in the masks."
        gains: list[list[Cell]] = [
            [name, *(round(float(value), 3) for value in gain)]
            for name, gain in zip(self.photos, self.gains, strict=True)
        ]
        light = "What the linear light of each photo was multiplied with, so that all agree."
        rows = [row for _, row in sorted(self.rows, key=lambda one: one[0])]
        return [
            Table("Textures", columns, rows, note=note),
            Table("Light", ("photo", "red", "green", "blue"), gains, note=light, for_experts=True),
        ]

    def picture(self) -> Picture:
        """The largest textures side by side; hatched where nothing was seen."""
        rows: list[list[NDArray[np.uint8]]] = [[]]
        for _, tile in self.tiles:
            used = sum(one.shape[1] + GAP_PX for one in rows[-1])
            if rows[-1] and used + tile.shape[1] > SHEET_PX:
                rows.append([])
            rows[-1].append(tile)
        note = "The faces that photos show most of; hatched is what none shows, and was made up."
        return Picture("Textures", note, jpeg(_sheet(rows)), "image/jpeg")


def texture_line(measures: dict[str, Any]) -> str:
    """For a person."""
    plain = measures["buildings_plain"]
    return (
        f"{measures['faces_textured']} of {measures['faces']} faces of"
        f" {measures['buildings_textured']} buildings textured by"
        f" {measures['texture_photos']} photos, {measures['texel_mean_m'] * 100:.1f} cm per texel;"
        f" photos show {measures['texture_seen_share_of_textured']:.0%} of them"
        + (f"; no photo shows {plain} other buildings, which are plain" if plain else "")
    )


def _sheet(rows: Sequence[Sequence[NDArray[np.uint8]]]) -> NDArray[np.uint8]:
    """Rows of tiles below each other on white."""
    heights = [max(tile.shape[0] for tile in row) for row in rows]
    sheet = np.full((sum(heights) + GAP_PX * len(rows), SHEET_PX, 3), 255, dtype=np.uint8)
    top = 0
    for row, height in zip(rows, heights, strict=True):
        left = 0
        for tile in row:
            sheet[top : top + tile.shape[0], left : left + tile.shape[1]] = tile
            left += tile.shape[1] + GAP_PX
        top += height + GAP_PX
    return sheet


def _tile(texture: FaceTexture) -> NDArray[np.uint8]:
    pixels = texture.pixels.copy()
    y, x = np.indices(texture.invented.shape)
    pixels[texture.invented & ((x + y) % 16 < 3)] = MARK
    height, width = pixels.shape[:2]
    scale = min(1.0, TALLEST_PX / height, SHEET_PX / width)
    size = (max(1, round(scale * width)), max(1, round(scale * height)))
    return np.asarray(cv2.resize(pixels, size, interpolation=cv2.INTER_AREA), dtype=np.uint8)
