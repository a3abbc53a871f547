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
def sound_polygons(
    positions_m: NDArray[np.float64],
    ring_offsets: NDArray[np.int64],
    polygon_offsets: NDArray[np.int64],
    tolerance_m: float,
) -> NDArray[np.bool_]: ...

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

# rules.rs
def grammar_imports(main: str, name: str, text: str) -> list[str]: ...
def grammar_check(files: list[tuple[str, str]]) -> tuple[str, int, int, str]: ...
def grammar_format(name: str, text: str) -> str: ...
def grammar_operations() -> list[str]: ...

# grammar.rs
class GrammarFault(ValueError): ...

class GrammarRules:
    def __new__(cls, files: list[tuple[str, str]]) -> GrammarRules: ...
    @property
    def starts(self) -> list[str]: ...
    @property
    def attributes(self) -> list[tuple[str, str]]: ...
    def derive(
        self,
        lots: list[list[list[tuple[float, float, float]]]],
        seeds: list[int],
        *,
        start: str | None = None,
        attributes: list[dict[str, bool | float | str]] | None = None,
        seconds: float = 60.0,
        shapes: int = 5_000_000,
    ) -> list[DerivedLot | str]: ...

class DerivedLot:
    positions_m: NDArray[np.float64]
    uv: NDArray[np.float32]
    ring_offsets: NDArray[np.int64]
    polygon_offsets: NDArray[np.int64]
    polygon_feature: NDArray[np.int32]
    polygon_look: NDArray[np.int32]
    feature_name: list[str]
    feature_class: list[str]
    feature_size_m: NDArray[np.float64]
    looks: list[tuple[float, float, float, float, str | None, str]]
    log_prior: float
    messages: list[str]

# derived_lots.rs
class DerivedLots:
    def __len__(self) -> int: ...
    def fault(self, lot: int) -> str | None: ...
    def messages(self, lot: int) -> list[str]: ...
    def extent(
        self, lot: int
    ) -> tuple[tuple[float, float, float], tuple[float, float, float], int] | None: ...
    def colour(self, lot: int, class_: str) -> tuple[float, float, float] | None: ...
    def city(
        self,
        lot: int,
        place: tuple[float, float, float],
        classes: list[str],
        kinds: list[str],
    ) -> tuple[str, list[tuple[int, str, str]], str]: ...
    def tile(
        self,
        lots: list[int],
        places: list[tuple[float, float, float]],
        classes: list[str],
    ) -> TileBuffers: ...

# tiles.rs
class TileBuffers:
    bounds: tuple[tuple[float, float, float], tuple[float, float, float]] | None
    grid: tuple[tuple[float, float, float], tuple[float, float, float]]
    step_m: float
    triangles: int
    dropped: int
    materials: list[tuple[int, tuple[float, float, float]]]
    counts: list[list[int]]
    rules: list[str]
    surfaces: list[bytes]
    merged: list[tuple[int, bytes, bytes, bytes, list[int], list[int]]]
    repeated: list[tuple[int, bytes, bytes, list[int], list[int], bytes, bytes, bytes]]

def derive_lots(
    rules: GrammarRules,
    lots: list[list[list[tuple[float, float, float]]]],
    seeds: list[int],
    *,
    start: str | None = None,
    attributes: list[dict[str, bool | float | str]],
    seconds: float = 60.0,
    shapes: int = 5_000_000,
) -> DerivedLots: ...
def compress_attributes(data: bytes, stride: int) -> bytes: ...
def compress_indices(data: bytes, stride: int) -> bytes: ...
