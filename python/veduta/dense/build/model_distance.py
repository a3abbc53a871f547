"""How far the cloud lies from a city model, and the colours that show it."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.dense.document import CityMesh
from veduta.surfaces import distances_from_mesh

Colours = NDArray[np.uint8]
FAR: tuple[int, int, int] = (120, 120, 120)
"""Points that belong to nothing of the model."""
STOPS = np.linspace(-1.0, 1.0, 5)
RAMP = np.array([[33, 60, 190], [90, 160, 235], [245, 245, 225], [245, 150, 60], [185, 20, 35]])
"""sRGB from behind the model's surface over on it to before it."""
NICE_M = (0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0)
BINS = 20


@dataclass(frozen=True)
class DistanceParameters:
    """shown: the share of the compared points for which the colours differ."""

    shown: float = 0.95


@dataclass(frozen=True, eq=False)
class ModelDistance:
    """distances_m: (n,) float64 of each point, above 0 outside of the model's bodies. compared:
    (n,) those no farther than `reach_m`. range_m: at which distance the colours end. colours:
    (n, 3) uint8 sRGB.
    """

    distances_m: NDArray[np.float64]
    compared: NDArray[np.bool_]
    reach_m: float
    range_m: float
    colours: Colours

    def figures(self) -> dict[str, float]:
        """Share of the points that are compared (0 to 1), and of these in metres: the median with
        its sign, the median and the 90 % quantile of the lengths. Without any: the share alone.
        """
        found = {"compared_share": round(float(self.compared.mean()), 4)}
        near = self.distances_m[self.compared]
        if len(near):
            middle, half = float(np.median(near)), float(np.median(np.abs(near)))
            most = float(np.quantile(np.abs(near), 0.9))
            found |= {
                "signed_median_m": round(middle, 4),
                "median_m": round(half, 4),
                "p90_m": round(most, 4),
            }
        return found


def model_distance(
    points_m: NDArray[np.float64], model: CityMesh, reach_m: float, parameters: DistanceParameters
) -> ModelDistance:
    """The signed distance of each (n, 3) point from the model, as `distances_from_mesh` has it.

    Points farther off than `reach_m` are no building's: the street, trees, houses that the model
    has not.
    """
    distances, _ = distances_from_mesh(points_m, model.positions_m, model.triangles)
    compared = np.abs(distances) <= reach_m
    lengths = np.abs(distances[compared])
    wanted = float(np.quantile(lengths, parameters.shown)) if len(lengths) else 0.0
    shown = min(next((one for one in NICE_M if one >= wanted), wanted), reach_m)
    colours = np.where(compared[:, None], distance_colours(distances, shown), FAR)
    return ModelDistance(distances, compared, reach_m, shown, colours.astype(np.uint8))


def distance_colours(distances_m: NDArray[np.float64], range_m: float) -> Colours:
    """(n, 3) uint8: blue behind the model's surface, pale on it, red before it."""
    share = np.clip(distances_m / range_m, -1.0, 1.0)
    bands = [np.interp(share, STOPS, RAMP[:, band]) for band in range(3)]
    return np.round(np.stack(bands, axis=-1)).astype(np.uint8)


def histogram(found: ModelDistance) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Edges (b + 1,) between -range_m and range_m, and the share of the compared points (b,)
    between them, in per cent; what lies beyond is in the outermost.
    """
    edges = np.linspace(-found.range_m, found.range_m, BINS + 1)
    near = np.clip(found.distances_m[found.compared], -found.range_m, found.range_m)
    counts, _ = np.histogram(near, edges)
    return edges, 100.0 * counts / max(1, len(near))


def legend_picture(found: ModelDistance) -> Colours:
    """(h, w, 3) uint8: the histogram, each bar in the colour of its distances, and the metres below."""
    edges, shares = histogram(found)
    width, height, foot, side = 46, 260, 44, 40
    page = np.full((height + foot + 16, side * 2 + width * BINS, 3), 255, dtype=np.uint8)
    tall = np.round(height * shares / max(float(shares.max()), 1e-9)).astype(int)
    tints = distance_colours((edges[:-1] + edges[1:]) / 2.0, found.range_m)
    base = height + 12
    for number in range(BINS):
        left = side + number * width
        box = (left + 2, base - int(tall[number])), (left + width - 3, base)
        cv2.rectangle(page, *box, tints[number].tolist(), cv2.FILLED)
        cv2.rectangle(page, *box, (90, 90, 90), 1)
    for number in range(0, BINS + 1, BINS // 4):
        label = f"{edges[number]:+.3g} m" if abs(edges[number]) > 1e-12 else "0"
        _write(page, label, (side + number * width, base + 28))
    return page


def _write(page: Colours, text: str, middle: tuple[int, int]) -> None:
    (width, _), _ = cv2.getTextSize(text, cv2.FONT_HERSHEY_SIMPLEX, 0.6, 1)
    at = (max(0, middle[0] - width // 2), middle[1])
    cv2.putText(page, text, at, cv2.FONT_HERSHEY_SIMPLEX, 0.6, (40, 40, 40), 1, cv2.LINE_AA)
