"""The private Rust extension, typed by hand."""

import numpy as np
from numpy.typing import NDArray

# polygons.rs
class PolygonFault(ValueError): ...
class BadOffsetsError(PolygonFault): ...
class NotFiniteError(PolygonFault): ...
class RingTooShortError(PolygonFault): ...
class RepeatedVertexError(PolygonFault): ...
class NoAreaError(PolygonFault): ...
class NotPlanarError(PolygonFault): ...
class SelfCrossingError(PolygonFault): ...

def triangulate_polygons(
    positions_m: NDArray[np.float64],
    ring_offsets: NDArray[np.int64],
    polygon_offsets: NDArray[np.int64],
    tolerance_m: float,
) -> tuple[NDArray[np.uint32], NDArray[np.uint32], NDArray[np.float64], NDArray[np.float64]]: ...

# chain.rs
class ChainFault(ValueError): ...
class ChainSizeError(ChainFault): ...
class ChainLabelsError(ChainFault): ...

def skyline_chain(unary: NDArray[np.float32], slope: float, jump: float) -> list[int]: ...
def floor_chain(
    distance: NDArray[np.float32],
    scales: list[
        tuple[list[int], float, NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]
    ],
    similarity: float,
    height_change: float,
    max_floors: int,
) -> list[list[tuple[float, list[int]] | None]]: ...
def column_chain(
    distance: NDArray[np.float32],
    evidence: NDArray[np.float64],
    jamb: NDArray[np.float64],
    widths: list[int],
    *,
    step: int,
    gap_min: int,
    gap_max: int,
    jamb_weight: float,
    similarity: float,
    width_change: float,
    gap_symmetry: float,
    neutral: float,
) -> tuple[float, list[tuple[int, int]]]: ...
