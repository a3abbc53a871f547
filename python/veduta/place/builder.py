"""Collects polygons and features and packs them into the columns of a part."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from veduta.place.lamp import Lamp
from veduta.place.material import Material
from veduta.place.mover import Mover
from veduta.place.part import NO_PARENT, Features, Part
from veduta.place.semantics import Provenance, SemanticClass

# Maps (n, 3) metres to (n, 2) UV.
UvMap = Callable[[NDArray[np.float64]], NDArray[np.float64]]
Rect = tuple[float, float, float, float]
_NO_RECT: Rect = (np.nan, np.nan, np.nan, np.nan)


class PartBuilder:
    """Grows the columns of one part; `build` packs them."""

    def __init__(self, part_id: str) -> None:
        self.part_id = part_id
        self.attributes: dict[str, str | int | float] = {}
        self.notes: list[str] = []
        self._materials: list[Material] = []
        self._rings: list[NDArray[np.float64]] = []
        self._ring_uv: list[NDArray[np.float64]] = []
        self._polygon_rings: list[int] = []
        self._polygon_feature: list[int] = []
        self._polygon_material: list[int] = []
        self._rows: list[tuple[str, str, int, int, int, int, float, float, Rect, float]] = []
        self._counts: Counter[SemanticClass] = Counter()
        self._shells = 1
        self._movers: list[Mover] = []
        self._lamps: list[Lamp] = []

    @property
    def polygon_count(self) -> int:
        """How many polygons there are already."""
        return len(self._polygon_rings)

    def mover(self, mover: Mover) -> None:
        """Have polygons that were added move together."""
        self._movers.append(mover)

    def lamp(self, lamp: Lamp) -> None:
        """Add a point that shines."""
        self._lamps.append(lamp)

    def material(self, material: Material) -> int:
        """Register a material; returns its number."""
        self._materials.append(material)
        return len(self._materials) - 1

    def new_shell(self) -> int:
        """Open another closed surface beside the body (which is 0)."""
        self._shells += 1
        return self._shells - 1

    def feature(
        self,
        semantic: SemanticClass,
        provenance: Provenance,
        name: str,
        *,
        parent: int = NO_PARENT,
        shell: int = 0,
        size_m: tuple[float, float] = (np.nan, np.nan),
        photo_px: Rect = _NO_RECT,
        seen_height_m: float = np.nan,
    ) -> int:
        """Add a row to the feature table; returns its number.

        The name must be the only one of its kind in the part: the stable id derives from it.
        """
        row = len(self._rows)
        self._counts[semantic] += 1
        self._rows.append(
            (
                f"{self.part_id}/{name.replace(' ', '-')}",
                name,
                semantic.code,
                provenance.code,
                parent,
                shell,
                size_m[0],
                size_m[1],
                photo_px,
                seen_height_m,
            )
        )
        return row

    def count(self, semantic: SemanticClass) -> int:
        """How many features of this class there are already."""
        return self._counts[semantic]

    def polygon(
        self,
        rings_m: Sequence[ArrayLike],
        feature: int,
        material: int,
        uv: UvMap | None = None,
    ) -> None:
        """Add a polygon: outline counter-clockwise seen from outside, holes clockwise."""
        for ring in rings_m:
            points = np.asarray(ring, dtype=np.float64)
            self._rings.append(points)
            self._ring_uv.append(np.zeros((len(points), 2)) if uv is None else uv(points))
        self._polygon_rings.append(len(rings_m))
        self._polygon_feature.append(feature)
        self._polygon_material.append(material)

    def build(self) -> Part:
        """Pack everything that was added."""
        if len({row[0] for row in self._rows}) < len(self._rows):
            raise ValueError(f"part {self.part_id!r} has two features of one name")
        ring_sizes = [len(ring) for ring in self._rings]
        ids, names, classes, provenances, parents, shells, widths, heights, rects, seen = zip(
            *self._rows, strict=True
        )
        return Part(
            id=self.part_id,
            positions_m=np.concatenate(self._rings).astype(np.float32),
            uv=np.concatenate(self._ring_uv).astype(np.float32),
            ring_offsets=np.concatenate([[0], np.cumsum(ring_sizes)]).astype(np.int64),
            polygon_offsets=np.concatenate([[0], np.cumsum(self._polygon_rings)]).astype(np.int64),
            polygon_feature=np.array(self._polygon_feature, dtype=np.int32),
            polygon_material=np.array(self._polygon_material, dtype=np.int32),
            features=Features(
                id=ids,
                name=names,
                class_code=np.array(classes, dtype=np.uint8),
                provenance_code=np.array(provenances, dtype=np.uint8),
                parent=np.array(parents, dtype=np.int32),
                shell=np.array(shells, dtype=np.int32),
                width_m=np.array(widths, dtype=np.float64),
                height_m=np.array(heights, dtype=np.float64),
                photo_px=np.array(rects, dtype=np.float64).reshape(-1, 4),
                seen_height_m=np.array(seen, dtype=np.float64),
                score=np.full(len(ids), np.nan),
            ),
            materials=tuple(self._materials),
            attributes=dict(self.attributes),
            notes=tuple(self.notes),
            movers=tuple(self._movers),
            lamps=tuple(self._lamps),
        )
