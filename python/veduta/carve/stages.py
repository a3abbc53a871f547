"""What a killed run goes on from: silhouettes, and the turns of a table."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydantic import JsonValue

from veduta.carve.options import CarveOptions
from veduta.carve.read.turning import Table
from veduta.carve.read.turntable import Found
from veduta.carve.read.views import Silhouettes
from veduta.run.work import Work


@dataclass(frozen=True)
class Stages:
    """work: that keeps them. inputs: digests of photos, cameras and masks."""

    work: Work
    inputs: JsonValue
    options: CarveOptions

    def silhouettes(self, make: Callable[[], Silhouettes]) -> Silhouettes:
        """Those that are on disk, or made now and kept."""
        kept = self.work.kept_arrays("silhouettes", self._key(), lambda: _packed(make()))
        bits, start, masks = np.unpackbits(kept["bits"]), 0, []
        for height, width in kept["sizes"].tolist():
            masks.append(bits[start : start + height * width].reshape(height, width) > 0)
            start += height * width
        return masks, float(kept["threshold"])

    def turns(self, make: Callable[[], Found]) -> Found:
        """The table that is on disk, or found now and kept."""
        kept = self.work.kept_arrays("turns", self._key(), lambda: _numbers(make()))
        focal_px, tilt, roll, aside, miss_px = kept["numbers"].tolist()
        table = Table(focal_px, tilt, roll, aside, kept["angles"])
        return Found(table, kept["deviations"], miss_px)

    def _key(self) -> JsonValue:
        told = self.options.model_dump(mode="json", include={"poses", "silhouettes", "scale"})
        return [self.inputs, told]


def _packed(made: Silhouettes) -> dict[str, NDArray[Any]]:
    masks, threshold = made
    return {
        "sizes": np.array([mask.shape for mask in masks]),
        "bits": np.packbits(np.concatenate([mask.ravel() for mask in masks])),
        "threshold": np.array(threshold),
    }


def _numbers(found: Found) -> dict[str, NDArray[Any]]:
    table = found.table
    numbers = [table.focal_px, table.tilt, table.roll, table.aside, found.miss_px]
    return {
        "numbers": np.array(numbers),
        "angles": table.angles,
        "deviations": found.deviations,
    }
