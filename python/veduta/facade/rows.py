"""The rows of the facade as the vertical split sees them: on a grid of about 10 cm."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.facade.bays import bay_width
from veduta.facade.dissimilarity import of_pairs
from veduta.facade.evidence import Evidence, Float, blur
from veduta.facade.extent import RowHistograms, Skyline

_GRID = 300
# Weights of the rows' channels: lightness against its surroundings, vertical, horizontal edges.
_CHANNELS = (1.0, 1.0, 0.5)


@dataclass(frozen=True)
class Rows:
    """Grid rows of `step` analysis pixels each; `ridge` is the grid row where the roof begins.

    `distance` (n, n) is the mean squared difference of two rows, 1 for two at random, `edges` (n,)
    the mean strength of vertical edges, `histograms` are those of the analysis rows; `bay` is the
    distance (in grid rows) at which the facade repeats sideways, where it does.
    """

    step: int
    ridge: int
    distance: Float
    edges: Float
    histograms: RowHistograms
    bay: int | None = None

    @property
    def count(self) -> int:
        """Number of grid rows."""
        return len(self.edges)

    def parting(self, half: int) -> NDArray[np.float64]:
        """Earth mover's distance between `half` grid rows above and below each (n + 1,)."""
        return self.histograms.parting(half * self.step, self.step)[: self.count + 1]


def gather_rows(evidence: Evidence, skyline: Skyline, histograms: RowHistograms) -> Rows:
    """Bring the image to the grid.

    Rows are compared by lightness against their surroundings and by their gradients, so that a
    shadow across a floor does not make it another floor (equation 6 on these channels). Mean
    chroma as a further channel lost two storey counts in sixty: floors painted or lit in another
    tone part, while the eaves have their own term.
    """
    step = max(1, round(evidence.height / _GRID))
    count = evidence.height // step
    building = (np.arange(evidence.height)[:, None] >= skyline.rows[None]) & evidence.valid
    ridge = skyline.level // step
    details = _detail(evidence, building)
    channels = [
        _standard(_grid(channel, step, count), ridge) * np.sqrt(weight)
        for channel, weight in zip(details, _CHANNELS, strict=True)
    ]
    across = [
        _standard(channel[skyline.level :], 0) * np.sqrt(weight)
        for channel, weight in zip(details, _CHANNELS, strict=True)
    ]
    stacked = np.concatenate(channels, axis=1)
    distance = of_pairs(stacked)
    body = distance[ridge:, ridge:]
    apart = np.abs(np.subtract.outer(np.arange(len(body)), np.arange(len(body)))) > count / 25
    distance = np.asarray(distance / max(float(body[apart].mean()), 1e-6), np.float32)
    edges = _grid((np.abs(evidence.gx) * building).mean(1, keepdims=True), step, count)
    return Rows(step, ridge, distance, edges.ravel(), histograms, bay_width(across, step))


def _grid(values: Float, step: int, count: int) -> Float:
    whole = values[: step * count].reshape(count, step, values.shape[1])
    return np.asarray(whole.mean(1), np.float32)


def _standard(values: Float, ridge: int) -> Float:
    return np.asarray(values / (float(values[ridge:].std()) + 1e-6), np.float32)


def _detail(evidence: Evidence, building: NDArray[np.bool_]) -> list[Float]:
    rows = evidence.height
    lightness = evidence.lab[:, :, 0]
    local = lightness - blur(lightness, rows / 40, rows / 40)
    local /= np.sqrt(blur(local * local, rows / 20, rows / 20)) + 4
    edges = [blur(np.minimum(np.abs(g), 25), 1.5, 1.0) for g in (evidence.gx, evidence.gy)]
    return [blur(c * building, 1.0, 1.0) for c in (local, *edges)]
