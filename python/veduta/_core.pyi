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
def dissolve_polygons(
    positions_m: NDArray[np.float64],
    uv: NDArray[np.float64],
    ring_offsets: NDArray[np.int64],
    polygon_offsets: NDArray[np.int64],
    group: NDArray[np.uint32],
    solid: NDArray[np.uint32],
    near_m: float,
) -> tuple[
    NDArray[np.float64],
    NDArray[np.float64],
    NDArray[np.int64],
    NDArray[np.int64],
    NDArray[np.uint32],
]: ...
def sound_polygons(
    positions_m: NDArray[np.float64],
    ring_offsets: NDArray[np.int64],
    polygon_offsets: NDArray[np.int64],
    tolerance_m: float,
) -> NDArray[np.bool_]: ...

# roofs.rs
class RoofFault(ValueError): ...

def roof_types() -> list[str]: ...
def roof_solid(
    kind: str,
    points_m: NDArray[np.float64],
    ring_offsets: NDArray[np.int64],
    slope: float,
    *,
    overhang_m: float = 0.0,
    gable_overhang_m: float = 0.0,
    numbers: dict[str, float] | None = None,
) -> tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.int64], NDArray[np.uint32]]: ...

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
class AssetWanted(GrammarFault): ...

_Value = bool | float | str
_Edit = tuple[list[int], str | None, bool, list[int | None], list[tuple[str, _Value]]]

class GrammarRules:
    def __new__(cls, files: list[tuple[str, str]], style: str | None = None) -> GrammarRules: ...
    @property
    def styles(self) -> list[str]: ...
    @property
    def starts(self) -> list[str]: ...
    @property
    def attributes(self) -> list[tuple[str, str]]: ...
    @property
    def asset_names(self) -> tuple[list[str], bool]: ...
    def add_asset(
        self,
        name: str,
        points: NDArray[np.float64],
        corners: NDArray[np.uint32],
        offsets: NDArray[np.int64],
        box_m: NDArray[np.float64],
        face_slot: NDArray[np.int32] | None = None,
        slots: list[tuple[tuple[float, float, float] | None, tuple[float, float, float]]]
        | None = None,
    ) -> None: ...
    def add_textures(self, sizes_m: dict[str, tuple[float, float]]) -> None: ...
    def derive(
        self,
        lots: list[list[list[tuple[float, float, float]]]],
        seeds: list[int],
        *,
        start: str | None = None,
        attributes: list[dict[str, bool | float | str]] | None = None,
        edits: list[list[_Edit]] | None = None,
        seconds: float = 60.0,
        shapes: int = 5_000_000,
    ) -> list[DerivedLot | MissingAsset | str]: ...
    def pace(
        self,
        lots: list[list[list[tuple[float, float, float]]]],
        seeds: list[int],
        cores: int,
        *,
        start: str | None = None,
    ) -> tuple[int, int, float]: ...

class MissingAsset:
    name: str
    why: str

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
    feature_surface: list[str]
    feature_within: list[str]
    feature_solid: list[str]
    feature_provenance: list[str]
    looks: list[tuple[float, float, float, float, str | None, str]]
    instance_feature: NDArray[np.int32]
    instance_look: NDArray[np.int32]
    instance_asset: NDArray[np.int32]
    instance_transform: NDArray[np.float64]
    asset_names: list[str]
    log_prior: float
    messages: list[str]
    edit_faults: list[tuple[list[int], str]]

# derivation.rs
class Derivation:
    def __new__(
        cls,
        rules: GrammarRules,
        lot: list[list[tuple[float, float, float]]],
        seed: int,
        *,
        start: str | None = None,
        attributes: dict[str, _Value] | None = None,
        edits: list[_Edit] | None = None,
        seconds: float = 60.0,
        shapes: int = 5_000_000,
    ) -> Derivation: ...
    def rederive(self, path: list[int], edits: list[_Edit]) -> bool: ...
    def __len__(self) -> int: ...
    @property
    def log_prior(self) -> float: ...
    @property
    def values(self) -> list[tuple[str, bool, _Value]]: ...
    @property
    def reports(self) -> list[tuple[str, _Value]]: ...
    @property
    def messages(self) -> list[str]: ...
    @property
    def edit_faults(self) -> list[tuple[list[int], str]]: ...
    def find(self, path: list[int]) -> int | None: ...
    def path(self, shape: int) -> list[int]: ...
    def parent(self, shape: int) -> int | None: ...
    def children(self, shape: int) -> tuple[int, int]: ...
    def name(self, shape: int) -> str: ...
    def is_leaf(self, shape: int) -> bool: ...
    def parameters(self, shape: int) -> list[tuple[str, _Value]]: ...
    def choices(self, shape: int) -> list[tuple[int, int, float]]: ...
    def surface_class(self, shape: int) -> str: ...
    def colour(self, shape: int) -> list[float]: ...
    def size_m(self, shape: int) -> list[float]: ...
    def origin_m(self, shape: int) -> list[float]: ...
    def polygons(
        self, shape: int
    ) -> tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.int64]]: ...
    def columns(self) -> DerivedLot: ...

# derived_lots.rs
class DerivedLots:
    def __len__(self) -> int: ...
    def fault(self, lot: int) -> str | None: ...
    def columns(self, lot: int) -> DerivedLot: ...
    def missing_asset(self, lot: int) -> str | None: ...
    def edit_faults(self, lot: int) -> list[tuple[list[int], str]]: ...
    def messages(self, lot: int) -> list[str]: ...
    def extent(
        self, lot: int
    ) -> tuple[tuple[float, float, float], tuple[float, float, float], int] | None: ...
    def colour(self, lot: int, kind: str) -> tuple[float, float, float] | None: ...
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
    repeated: list[tuple[int, bytes, bytes, list[int], list[int], bytes, bytes, bytes, bytes]]

def derive_lots(
    rules: GrammarRules,
    lots: list[list[list[tuple[float, float, float]]]],
    seeds: list[int],
    *,
    start: str | None = None,
    attributes: list[dict[str, bool | float | str]],
    edits: list[list[_Edit]],
    seconds: float = 60.0,
    shapes: int = 5_000_000,
) -> DerivedLots: ...
def compress_attributes(data: bytes, stride: int) -> bytes: ...
def compress_indices(data: bytes, stride: int) -> bytes: ...
