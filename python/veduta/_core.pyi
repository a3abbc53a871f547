"""The private Rust extension. Generated from its sources by `make stubs`: do not edit."""

from collections.abc import Sequence
from typing import TypeVar

import numpy as np

_T = TypeVar("_T", bound=np.generic)
_Array1 = np.ndarray[tuple[int], np.dtype[_T]]
_Array2 = np.ndarray[tuple[int, int], np.dtype[_T]]
_Array3 = np.ndarray[tuple[int, int, int], np.dtype[_T]]

# assets.rs
class MissingAsset:
    """An asset that a lot's rules want and that is not known yet: add it and derive again."""
    @property
    def name(self) -> str: ...
    @property
    def why(self) -> str:
        """What the lot's failure is where there is no such asset."""
    def __repr__(self) -> str: ...

# cards.rs
class GpuFault(RuntimeError): ...

class GraphicsCard:
    """A graphics card. GpuFault says why there is none, or that it vanished."""
    def __new__(cls, *, software: bool = False) -> GraphicsCard:
        """The fastest one. software: adapters that compute on the processor, too, for tests."""
    def name(self) -> str:
        """As its maker calls it."""
    def destroy(self) -> None:
        """Gives it back: whoever still uses it is told that it vanished."""
    def carve_hull(
        self,
        cameras: _Array2[np.float64],
        distances: Sequence[_Array2[np.float32]],
        corners: _Array2[np.float64],
        low_m: tuple[float, float, float],
        side_m: float,
        levels: int,
    ) -> CarvedVolume:
        """As `carve_hull` does."""
    def sweep_colours(
        self,
        cameras: _Array2[np.float64],
        photos: Sequence[_Array3[np.uint8]],
        distances: Sequence[_Array2[np.float32]],
        corners: _Array2[np.float64],
        solid: _Array3[np.bool_],
        low_m: tuple[float, float, float],
        side_m: float,
        rule: SweepRule,
    ) -> tuple[_Array3[np.bool_], list[int], _Array1[np.float32]]:
        """As `sweep_colours` does."""
    def match_planes(
        self,
        image: _Array2[np.uint8],
        camera: _Array1[np.float64],
        neighbours: Sequence[_Array2[np.uint8]],
        cameras: _Array2[np.float64],
        depths: Sequence[_Array2[np.float32] | None],
        start: _Array2[np.float32] | None,
        start_shape: tuple[int, int],
        rule: SearchRule,
    ) -> _Array2[np.float32]:
        """As `match_planes` does."""
    def match_pair(
        self,
        here: _Array3[np.uint8],
        there: _Array3[np.uint8],
        shown_here: _Array2[np.bool_],
        shown_there: _Array2[np.bool_],
        rule: PairRule,
    ) -> _Array2[np.float32]:
        """As `match_pair` does."""
    def link_views(
        self,
        camera: _Array1[np.float64],
        width: int,
        height: int,
        chains: Sequence[
            Sequence[
                tuple[
                    _Array1[np.float64],
                    _Array2[np.float64],
                    _Array2[np.float64],
                    _Array2[np.float32],
                ]
            ]
        ],
        rule: LinkRule,
    ) -> tuple[_Array1[np.float32], _Array1[np.float32], _Array1[np.uint8]]:
        """As `link_views` does."""

# carve.rs
class CarveFault(ValueError): ...

class CarvedVolume:
    """What silhouettes left of a cube: signed evidence, less than zero inside."""
    def inside(self) -> int:
        """Voxels whose centres are inside."""
    def counts(self) -> list[list[int]]:
        """Cubes of each level of the octree that are outside, inside and on a boundary."""
    def size(self) -> int:
        """Bytes that the evidence takes."""
    def solid(self) -> _Array3[np.bool_]:
        """Of each voxel (x, y, z), whether its centre is inside."""
    def deepened(self, field: _Array3[np.float32]) -> CarvedVolume:
        """The volume without what `field` carves: signed evidence (m, less than zero where nothing is
        carved) over the same cube, 2^n values along each edge.
        """
    def surface(self) -> tuple[_Array2[np.float64], _Array2[np.uint32]]:
        """Vertices (v, 3) in voxels, from the centre of the first one, and triangles (m, 3),
        counter-clockwise seen from outside.
        """

def carve_hull(
    cameras: _Array2[np.float64],
    distances: Sequence[_Array2[np.float32]],
    corners: _Array2[np.float64],
    low_m: tuple[float, float, float],
    side_m: float,
    levels: int,
) -> CarvedVolume:
    """Carves a cube at `low_m`, 2^levels voxels along each edge. cameras: a row of 16 numbers for each
    view (the projection to pixels row by row, the focal length, the centre). distances: of each view,
    to the silhouette's outline (px), less than zero inside. corners: where in the picture they begin.
    """

def vertex_colours(
    cameras: _Array2[np.float64],
    photos: Sequence[_Array3[np.uint8]],
    positions: _Array2[np.float64],
    normals: _Array2[np.float64],
    triangles: _Array2[np.uint32],
    *,
    spacing_m: float,
    least_cosine: float,
    power: float,
    views: int,
) -> tuple[_Array2[np.uint8], _Array1[np.uint16]]:
    """Colours (v, 3) of vertices with unit normals, blended from the best views that see them, and how
    many views do. Those that none sees take the colours around them. cameras: as in `carve_hull`.
    """

def seen_triangles(
    cameras: _Array2[np.float64],
    sizes: Sequence[tuple[int, int]],
    positions: _Array2[np.float64],
    triangles: _Array2[np.uint32],
) -> list[_Array2[np.int32]]:
    """The triangle that each camera sees in the middle of each pixel, (h, w), -1 where there is none.
    sizes: (width, height) of each camera.
    """

# chain.rs
class ChainFault(ValueError): ...
class ChainSizeError(ChainFault): ...
class ChainLabelsError(ChainFault): ...

def skyline_chain(unary: _Array2[np.float32], slope: float, jump: float) -> list[int]:
    """One row per image column that minimises unary plus truncated linear costs, exactly."""

def floor_chain(
    distance: _Array2[np.float32],
    scales: Sequence[
        tuple[Sequence[int], float, _Array1[np.float64], _Array1[np.float64], _Array1[np.float64]]
    ],
    similarity: float,
    height_change: float,
    max_floors: int,
) -> list[list[tuple[float, list[int]] | None]]:
    """The best chain of floors for every scale `(heights, neutral, eaves, boundary, ground)` and every count."""

def column_chain(
    distance: _Array2[np.float32],
    evidence: _Array1[np.float64],
    jamb: _Array1[np.float64],
    widths: Sequence[int],
    *,
    step: int,
    gap_min: int,
    gap_max: int,
    jamb_weight: float,
    similarity: float,
    width_change: float,
    gap_symmetry: float,
    neutral: float,
) -> tuple[float, list[tuple[int, int]]]:
    """The best chain of window stripes: its energy and `(position, width)` of each."""

# compress.rs
def compress_attributes(data: bytes, stride: int) -> bytes:
    """A column as EXT_meshopt_compression has it, mode ATTRIBUTES; `stride` in bytes."""

def compress_indices(data: bytes, stride: int) -> bytes:
    """The same for whole numbers of `stride` bytes (2 or 4), mode INDICES."""

# depth_maps.rs
class DepthVolume:
    """Signed distances to what depth maps show, near the surface alone."""
    def __new__(cls, voxel_m: float, truncation_voxels: float, most_blocks: int) -> DepthVolume:
        """voxel_m: side of a voxel. truncation_voxels: how far behind and before a surface is measured.
        most_blocks: of 8 x 8 x 8 voxels (4 kB) that may be taken.
        """
    def add(
        self, depths: _Array2[np.float32], camera: _Array1[np.float64], weights: _Array2[np.float32]
    ) -> None:
        """Takes in a depth map, (h, w) in metres with NaN where unknown, each pixel with its weight."""
    def blocks(self) -> int:
        """Blocks that are taken."""
    def surface(self, least: float) -> tuple[_Array2[np.float64], _Array2[np.uint32]]:
        """Vertices (m, world) and triangles of the surface, where voxels have at least this weight."""

def agreeing_views(
    depths: Sequence[_Array2[np.float32]],
    cameras: _Array2[np.float64],
    *,
    most_px: float,
    most_share: float,
) -> _Array1[np.uint8]:
    """For each pixel of the first depth map, row by row, how many of the others agree with it. depths:
    (h, w) in metres, NaN where unknown; cameras: a row of 16 numbers for each.
    """

def fuse_depths(
    depths: Sequence[_Array2[np.float32]],
    cameras: _Array2[np.float64],
    normals: Sequence[_Array2[np.float32]],
    colours: Sequence[_Array2[np.uint8]],
    used: Sequence[_Array2[np.bool_]],
    *,
    most_px: float,
    most_share: float,
    least: int,
) -> tuple[
    _Array2[np.float64],
    _Array2[np.float32],
    _Array2[np.uint8],
    _Array1[np.uint8],
    list[_Array1[np.uint32]],
]:
    """Points (m, world), normals, colours and numbers of views of what the first view shows and no
    earlier one did, and the pixels of each view that went into them. normals (camera's frame) and
    colours: (pixels, 3) of each view. used: pixels that have a point already, one array per view.
    """

def add_point_colours(
    points: _Array2[np.float64],
    normals: _Array2[np.float32],
    depths: _Array2[np.float32],
    camera: _Array1[np.float64],
    colours: _Array2[np.uint8],
    within_m: float,
    sums: _Array2[np.float32],
) -> _Array2[np.float32]:
    """Adds what a view shows of each point to `sums`, (n, 5): red, green and blue times their weight,
    the weight, and the number of views. colours: (pixels, 3). within_m: how far the view's depth may
    lie from a point that it sees.
    """

# derivation.rs
class Derivation:
    """A derivation that stays: shapes are named by their number in the tree, which a later
    `rederive` may change.
    """
    def __new__(
        cls,
        rules: GrammarRules,
        lot: Sequence[Sequence[tuple[float, float, float]]],
        seed: int,
        *,
        start: str | None = None,
        attributes: dict[str, bool | float | str | Sequence[bool] | Sequence[float] | Sequence[str]]
        | None = None,
        edits: Sequence[
            tuple[
                Sequence[int],
                str | None,
                bool,
                Sequence[int | None],
                Sequence[
                    tuple[
                        str, bool | float | str | Sequence[bool] | Sequence[float] | Sequence[str]
                    ]
                ],
            ]
        ]
        | None = None,
        around: Surroundings | None = None,
        beside: Sequence[tuple[int, tuple[float, float, float]]] | None = None,
        limits: GrammarLimits | None = None,
    ) -> Derivation: ...
    def rederive(
        self,
        path: Sequence[int],
        edits: Sequence[
            tuple[
                Sequence[int],
                str | None,
                bool,
                Sequence[int | None],
                Sequence[
                    tuple[
                        str, bool | float | str | Sequence[bool] | Sequence[float] | Sequence[str]
                    ]
                ],
            ]
        ],
    ) -> bool:
        """Derives the shape at `path` anew with these edits of the whole tree, and leaves the rest.
        False where there is no such shape.
        """
    def copy(self) -> Derivation:
        """Another derivation with the same shapes, which a later `rederive` of this one leaves alone."""
    @property
    def random_shapes(self) -> list[int]:
        """The numbers of the shapes whose rules took random alternatives, in the order of the tree."""
    def __len__(self) -> int: ...
    def __repr__(self) -> str: ...
    @property
    def log_prior(self) -> float: ...
    @property
    def values(self) -> list[tuple[str, bool, bool | float | str]]:
        """Attributes (True) and constants that were needed or drawn by chance: name and value."""
    @property
    def reports(self) -> list[tuple[str, bool | float | str]]: ...
    @property
    def messages(self) -> list[str]: ...
    @property
    def edit_faults(self) -> list[tuple[list[int], str]]:
        """Path and fault of each edit that could not be done."""
    def find(self, path: Sequence[int]) -> int | None:
        """The number of the shape at a path; None where there is none."""
    def path(self, shape: int) -> list[int]: ...
    def parent(self, shape: int) -> int | None: ...
    def children(self, shape: int) -> tuple[int, int]:
        """The numbers of the shapes that were made from it: the first, and the one after the last."""
    def name(self, shape: int) -> str: ...
    def is_leaf(self, shape: int) -> bool:
        """Whether it stays: no rule was applied to it."""
    def parameters(self, shape: int) -> list[tuple[str, bool | float | str]]:
        """Name and value of what its rule was given."""
    def choices(self, shape: int) -> list[tuple[int, int, float]]:
        """The random alternatives of its rule: which one, of how many, and its chance."""
    def surface_class(self, shape: int) -> str:
        """What it is in the model; empty where the rules do not say it."""
    def colour(self, shape: int) -> list[float]:
        """sRGB, 0 to 1."""
    def size_m(self, shape: int) -> list[float]:
        """Size of its scope (m): along x and y of its face, and z out of it."""
    def origin_m(self, shape: int) -> list[float]:
        """Where its scope begins (m), in the frame of places: x east, y north, z up."""
    def polygons(
        self, shape: int
    ) -> tuple[_Array2[np.float64], _Array1[np.int64], _Array1[np.int64]]:
        """The polygons of one shape, in the frame of places: corners (n, 3) in metres, the first
        corner of each ring and the first ring of each polygon, each with the end.
        """
    def columns(self) -> DerivedLot:
        """The columns of all leaves."""

# derived_lot.rs
class DerivedLot:
    """The columns of one lot."""
    @property
    def positions_m(self) -> _Array2[np.float64]: ...
    @property
    def uv(self) -> _Array2[np.float32]: ...
    @property
    def ring_offsets(self) -> _Array1[np.int64]: ...
    @property
    def polygon_offsets(self) -> _Array1[np.int64]: ...
    @property
    def polygon_feature(self) -> _Array1[np.int32]:
        """The surface that each polygon belongs to."""
    @property
    def polygon_look(self) -> _Array1[np.int32]: ...
    @property
    def feature_name(self) -> list[str]: ...
    @property
    def feature_class(self) -> list[str]:
        """What each surface is, as the rules have it; empty where they do not say it."""
    @property
    def feature_size_m(self) -> _Array2[np.float64]: ...
    @property
    def feature_surface(self) -> list[str]:
        """What the rules say of each surface in the attributes `surface`, `solid` and `provenance`,
        and which `surface` it was made in; empty where they say nothing.
        """
    @property
    def feature_within(self) -> list[str]: ...
    @property
    def feature_solid(self) -> list[str]: ...
    @property
    def feature_provenance(self) -> list[str]: ...
    @property
    def looks(self) -> list[tuple[float, float, float, float, str | None, str]]:
        """Red, green, blue, opacity (0 to 1), texture and class of each look."""
    @property
    def instance_feature(self) -> _Array1[np.int32]:
        """The surface that each asset belongs to, its look, its place in `asset_names`, and where it
        stands: 3 x 4 by rows, from the asset's frame (m, z up) to the lot's.
        """
    @property
    def instance_look(self) -> _Array1[np.int32]: ...
    @property
    def instance_asset(self) -> _Array1[np.int32]: ...
    @property
    def instance_transform(self) -> _Array2[np.float64]: ...
    @property
    def asset_names(self) -> list[str]: ...
    @property
    def asset_views(self) -> list[tuple[bool, bool]]:
        """Of each asset, whether it is its own mirror image, and whether it is inside out."""
    @property
    def log_prior(self) -> float: ...
    @property
    def messages(self) -> list[str]: ...
    @property
    def edit_faults(self) -> list[tuple[list[int], str]]:
        """Path and fault of each edit that could not be done."""
    def __repr__(self) -> str: ...

# derived_lots.rs
class DerivedLots:
    """Lots that were derived and stay on this side: columns are made for what is asked."""
    def __len__(self) -> int: ...
    def __repr__(self) -> str: ...
    def fault(self, lot: int) -> str | None:
        """Why a lot has no shapes; None where it has."""
    def missing_asset(self, lot: int) -> str | None:
        """The asset that a lot's rules want and that is not known; None where nothing is wanted."""
    def edit_faults(self, lot: int) -> list[tuple[list[int], str]]:
        """Path and fault of each edit of a lot that could not be done."""
    def columns(self, lot: int) -> DerivedLot:
        """The columns of a lot."""
    def messages(self, lot: int) -> list[str]:
        """What the rules said of a lot."""
    def reports(self, lot: int) -> list[tuple[str, bool | float | str]]:
        """What the rules reported of a lot by its key: the sum of numbers, of all else the last."""
    def extent(
        self, lot: int
    ) -> tuple[tuple[float, float, float], tuple[float, float, float], int] | None:
        """Lower and upper corner (m, z up) about the lot's anchor, and how many polygons and assets
        there are; None where nothing is left.
        """
    def colour(
        self, lot: int, kind: str, textures: Sequence[tuple[str, tuple[float, float, float]]] = ...
    ) -> tuple[float, float, float] | None:
        """The sRGB colour that most leaves of a class have, with the mean colours of textures; None
        where there is no such class.
        """
    def city(
        self,
        lot: int,
        place: tuple[float, float, float],
        classes: Sequence[str],
        kinds: Sequence[str],
        textures: Sequence[tuple[str, tuple[float, float, float]]] = ...,
        volumes: DerivedLots | None = None,
    ) -> tuple[
        str,
        list[tuple[int, str, str, str]],
        str,
        tuple[list[tuple[int, tuple[int, int, int]]], str, str],
    ]:
        """Geometry, installations (class, rule, colour, geometry), vertices (mm) and looks (pictures with
        their tints, `materials`, `vertices-texture`) of a lot at its place, as texts of CityJSON; `kinds` has the semantic surface of each class, "" for installations.
        `textures` have their mean colours (sRGB). `volumes`: the same lots at their lowest level of detail, whose closed volumes become further
        geometries of LoD 1.2 and 2.2.
        """
    def tile(
        self,
        lots: Sequence[int],
        places: Sequence[tuple[float, float, float]],
        classes: Sequence[str],
        provenances: Sequence[str],
        textures: Sequence[tuple[str, tuple[float, float, float]]] = ...,
        *,
        mapped: bool = False,
        whole: bool = False,
    ) -> TileBuffers:
        """The buffers of a tile with these lots, each at its place (m, z up); `classes` and
        `provenances` are those that are known, the last of them for all others. `textures` have
        their mean colours (sRGB); a tile that is not `mapped` has these instead. In one that is
        `whole`, the cells of a surface are one face, without cracks between them.
        """

def derive_lots(
    rules: GrammarRules,
    lots: Sequence[Sequence[Sequence[tuple[float, float, float]]]],
    seeds: Sequence[int],
    *,
    start: str | None = None,
    attributes: Sequence[
        dict[str, bool | float | str | Sequence[bool] | Sequence[float] | Sequence[str]]
    ],
    edits: Sequence[
        Sequence[
            tuple[
                Sequence[int],
                str | None,
                bool,
                Sequence[int | None],
                Sequence[
                    tuple[
                        str, bool | float | str | Sequence[bool] | Sequence[float] | Sequence[str]
                    ]
                ],
            ]
        ]
    ],
    around: Surroundings | None = None,
    beside: Sequence[Sequence[tuple[int, tuple[float, float, float]]]] | None = None,
    limits: GrammarLimits | None = None,
) -> DerivedLots:
    """Derives lots as `GrammarRules.derive` does. `beside`: per lot, which lots of `around` stand beside
    it, and how far their frames lie from its own (m, z up).
    """

# foreground.rs
def flood_foreground(
    pixels: _Array3[np.uint8],
    misfit: _Array2[np.float32],
    seeds: _Array2[np.int64],
    depth_m: _Array1[np.float32],
    *,
    reach: int,
    colour: int,
    slack: float,
    least: float,
) -> _Array2[np.float32]:
    """(h, w) the depth of the nearest foreground whose flood reaches a pixel (m), infinity where none
    does. pixels: (h, w, 3). misfit: (h, w) correspondence error to the background (px), NaN where none
    is. seeds: (n, 2) columns and rows of foreground points, depth_m: (n,) how far each is. A flood keeps
    within `reach` pixels of its seed, to colours within `colour` of the seed's, and to pixels that fit
    the background at most `slack` better than the seed, and no better than `least`.
    """

# grammar.rs
class GrammarFault(ValueError): ...
class AssetWanted(GrammarFault): ...

class GrammarRules:
    """Checked rule files, ready to derive."""
    def __new__(
        cls, files: Sequence[tuple[str, str]], style: str | None = None, start: str | None = None
    ) -> GrammarRules:
        """`files` are name and text of each file, the main one first; the others are what it may
        import, under the names in its import statements.
        `style` is one of the main file's; `Default` where it is None. `start`: the rule that is
        derived with, where it is known; faults of rules that it does not reach are no faults.
        """
    def __repr__(self) -> str: ...
    @property
    def styles(self) -> list[str]:
        """The styles of the main file, `Default` first."""
    @property
    def starts(self) -> list[str]:
        """Names of the rules that need no arguments, the start rule first."""
    @property
    def attributes(self) -> list[tuple[str, str]]:
        """The attributes, with what each is where its value says so: `number`, `text`, `bool`, or ""."""
    @property
    def asks_beside(self) -> bool:
        """Whether they ask about shapes of other lots."""
    @property
    def asset_names(self) -> tuple[list[str], bool]:
        """The names of assets that stand in the rules, and whether there are others that are computed."""
    @property
    def notes(self) -> str:
        """What is built otherwise than the rules say, with its places; empty where nothing is."""
    @property
    def unreached(self) -> str:
        """What would be a fault where the start rule reached it, with its places."""
    @property
    def asks_place(self) -> bool:
        """Whether they ask where shapes lie on Earth."""
    @property
    def asks_files(self) -> tuple[bool, bool]:
        """Whether the rules ask which files there are, and whether they read some."""
    def add_files(
        self,
        names: Sequence[str],
        texts: dict[str, str],
        pictures: dict[str, tuple[float, float]],
        metadata: dict[
            str, dict[str, bool | float | str | Sequence[bool] | Sequence[float] | Sequence[str]]
        ] = ...,
    ) -> None:
        """Makes the files of a project known: their names, the content of those that are text, and the
        width and height of those that are pictures (px), and what assets say besides, by its keys.
        """
    def add_asset(
        self,
        name: str,
        points: _Array2[np.float64],
        corners: _Array1[np.uint32],
        offsets: _Array1[np.int64],
        box_m: _Array2[np.float64],
        face_slot: _Array1[np.int32] | None = None,
        slots: Sequence[
            tuple[
                tuple[float, float, float] | None,
                tuple[float, float, float],
                tuple[str, tuple[float, float] | None, tuple[float, float, float]] | None,
            ]
        ]
        | None = None,
        labels: tuple[Sequence[str], Sequence[int], Sequence[str]] | None = None,
        in_plane: bool = False,
        panel: bool = False,
        uv: _Array2[np.float32] | None = None,
    ) -> None:
        """Makes an asset known. `points`: (v, 3) metres, y up. `corners`: numbers of points, face by
        face, counter-clockwise seen from outside. `offsets`: (f + 1,) the first corner of each face.
        `box_m`: (2, 3) the corners of the box that fills a scope. `face_slot`: (f,) the slot of each
        face. `slots`: the colour of each (sRGB) or None for that of the shape, and the colour where
        the shape is white, and the texture or None: its name, its size in metres (None where it lies
        by `uv`), and its mean colour (sRGB).
        `labels`: the name of each slot's material, the group of each face, and the names of the groups.
        `in_plane`: whether z = 0 lies in the plane of a flat shape that it is put into; `panel`:
        whether it is thin there.
        `uv`: (c, 2) where each of `corners` lies on its slot's picture, from the lower left.
        """
    def add_textures(self, sizes_m: dict[str, tuple[float, float]]) -> None:
        """Makes textures known that cover so many metres to the right and up: they lie in metres where
        no rule says how they lie, and a name of a built-in one that is not among them is a fault.
        """
    def derive(
        self,
        lots: Sequence[Sequence[Sequence[tuple[float, float, float]]]],
        seeds: Sequence[int],
        *,
        start: str | None = None,
        attributes: Sequence[
            dict[str, bool | float | str | Sequence[bool] | Sequence[float] | Sequence[str]]
        ]
        | None = None,
        edits: Sequence[
            Sequence[
                tuple[
                    Sequence[int],
                    str | None,
                    bool,
                    Sequence[int | None],
                    Sequence[
                        tuple[
                            str,
                            bool | float | str | Sequence[bool] | Sequence[float] | Sequence[str],
                        ]
                    ],
                ]
            ]
        ]
        | None = None,
        limits: GrammarLimits | None = None,
    ) -> list[DerivedLot | MissingAsset | str]:
        """Derives each lot (rings of x, y, z in metres, the outline first) with the seed and the
        attributes beside it. Per lot: the columns of its leaves, or the text of why there are none.
        """
    def pace(
        self,
        lots: Sequence[Sequence[Sequence[tuple[float, float, float]]]],
        seeds: Sequence[int],
        cores: int,
        *,
        start: str | None = None,
    ) -> tuple[int, int, float]:
        """Derives and packs the lots on so many cores, and keeps nothing: how many leaves and polygons
        there were, and the seconds that it took. For benchmarks.
        """

# limits.rs
class GrammarLimits:
    """What a derivation may cost before it is stopped; see `veduta.grammar.LimitOptions`."""
    def __new__(
        cls,
        *,
        depth: int,
        shapes: int,
        faces: int,
        parts: int,
        seconds: float,
        work: int,
        memory: int,
    ) -> GrammarLimits:
        """`memory`: bytes. `work`: steps, each looking at one pair of faces, edges or corners."""
    def __repr__(self) -> str: ...

# linking.rs
def match_pair(
    here: _Array3[np.uint8],
    there: _Array3[np.uint8],
    shown_here: _Array2[np.bool_],
    shown_there: _Array2[np.bool_],
    rule: PairRule,
) -> _Array2[np.float32]:
    """The disparity of each pixel of a rectified picture, x there less x here (px), NaN where there is
    none. here, there: (h, w, 3) sRGB; shown: (h, w), where each has pixels.
    """

def confirm_pair(
    here: _Array2[np.float32], there: _Array2[np.float32], most_px: float
) -> _Array2[np.float32]:
    """The disparities that lead back from the other picture within so many pixels; NaN elsewhere."""

def link_views(
    camera: _Array1[np.float64],
    width: int,
    height: int,
    chains: Sequence[
        Sequence[
            tuple[
                _Array1[np.float64], _Array2[np.float64], _Array2[np.float64], _Array2[np.float32]
            ]
        ]
    ],
    rule: LinkRule,
) -> tuple[_Array1[np.float32], _Array1[np.float32], _Array1[np.uint8]]:
    """Depths of a view (m, NaN where unknown) row by row, their deviations (of the inverse depth), and
    the number of views that each was found from, by chains of links (3.3, 3.4). width, height: of the
    view. chains: up and down the sequence, for each step the next view's camera, rectified from this
    view's pixels, the next view's pixels from rectified ones, and the disparities.
    """

# localise.rs
class DriveFault(ValueError): ...

class VehicleParticles:
    """Poses that a vehicle may have in a map of edges (Monte-Carlo localisation)."""
    def __new__(
        cls,
        distance_m: _Array2[np.float32],
        low: tuple[float, float],
        cell_m: float,
        start: tuple[float, float, float],
        reach: tuple[float, float, float],
        *,
        particles: int,
        first_draws: int,
        seed: int,
        sigma_m: float,
        widest_sigma_m: float,
        spread_share: float,
        outlier: float,
        outside: float,
        blocked: float,
        worth: float,
        draw_below: float,
    ) -> VehicleParticles:
        """distance_m: (rows from the south, columns) m to the nearest edge, negative where something
        stands that a scan cannot look through, NaN where nothing is known;
        low: the outer corner of its first cell. start, reach: x, y (m) and heading (rad), and how far
        each may be off. sigma_m: how far points lie from edges; `spread_share` of the particles' spread
        while that is more, up to `widest_sigma_m`. outlier, outside: likelihoods of points on no edge
        and off the map, where one on an edge has 1; blocked: of one that a beam went through and where
        something stands. worth: beams that a scan counts as.
        """
    def step(
        self,
        motion: tuple[float, float, float],
        noise: tuple[float, float, float],
        points: _Array2[np.float64],
        free: _Array2[np.float64],
    ) -> tuple[list[float], list[float], float, float, float]:
        """After a motion (forward, left in m, turn in rad) with noise of these deviations, a scan's points
        (n, 2) in the vehicle's frame (m), and points (k, 2) that its beams went through: mean pose,
        covariance by rows, share of the points within two sigma of an edge, share of them on the map,
        share of the second ones where something stands.
        """

# occupancy.rs
class CoverFault(ValueError): ...

def capsules_cover(
    start: _Array1[np.int64],
    end: _Array1[np.int64],
    joints: _Array3[np.float32],
    deep: _Array1[np.float32],
    places: _Array2[np.float32],
    shares: _Array2[np.float32],
    weights: _Array1[np.float32],
    soft: float,
) -> tuple[_Array1[np.float64], _Array3[np.float64], _Array2[np.float64]]:
    """Soft occupancy of tapered capsules against silhouettes, with its gradients.

    start, end: (s,) joints of each segment. joints: (t, j, 2). deep: (j,) half of the thickness.
    places: (p, 2) looked at. shares: (t, p) how much of each place the silhouette has. weights: (p,)
    how much it counts. soft: how wide an edge is. All lengths are in one unit. The loss (t,) of each
    frame, and its gradients by joints (t, j, 2) and thicknesses (t, j).
    """

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
    positions_m: _Array2[np.float64],
    ring_offsets: _Array1[np.int64],
    polygon_offsets: _Array1[np.int64],
    tolerance_m: float,
) -> tuple[_Array2[np.uint32], _Array1[np.uint32], _Array2[np.float64], _Array1[np.float64]]:
    """Triangles, the polygon of each triangle, unit normals and areas (m2) of columnar polygons."""

def dissolve_polygons(
    positions_m: _Array2[np.float64],
    uv: _Array2[np.float64],
    ring_offsets: _Array1[np.int64],
    polygon_offsets: _Array1[np.int64],
    group: _Array1[np.uint32],
    solid: _Array1[np.uint32],
    near_m: float,
) -> tuple[
    _Array2[np.float64],
    _Array2[np.float64],
    _Array1[np.int64],
    _Array1[np.int64],
    _Array1[np.uint32],
]:
    """Polygons of one group that touch in one plane as one: positions, texture coordinates, offsets of
    rings and polygons, and the group of each. Polygons of one solid share their corners.
    """

def sound_polygons(
    positions_m: _Array2[np.float64],
    ring_offsets: _Array1[np.int64],
    polygon_offsets: _Array1[np.int64],
    tolerance_m: float,
) -> _Array1[np.bool_]:
    """Which of columnar polygons `triangulate_polygons` takes."""

# roofs.rs
class RoofFault(ValueError): ...

def roof_types() -> list[str]:
    """The names of the types of roof."""

def roof_solid(
    kind: str,
    points_m: _Array2[np.float64],
    ring_offsets: _Array1[np.int64],
    slope: float,
    *,
    overhang_m: float = 0.0,
    gable_overhang_m: float = 0.0,
    numbers: dict[str, float] | None = None,
) -> tuple[_Array2[np.float64], _Array1[np.int64], _Array1[np.int64], _Array1[np.uint32]]:
    """The closed solid between a polygon (x, y in metres; rings by their offsets, the outline first)
    and a roof over it: points, the first corner of each ring, the first ring of each face (both with
    the end), and the point of each corner. `slope` is a tangent.
    """

# rules.rs
def grammar_imports(text: str) -> list[str]:
    """The paths that the import statements of a text name, as they stand there."""

def grammar_check(
    files: Sequence[tuple[str, str]], start: str | None = None
) -> tuple[str, int, int, str]: ...
def grammar_format(name: str, text: str) -> str:
    """The text of a rule file in the house style; GrammarFault where it does not parse."""

def grammar_operations() -> list[str]:
    """The names of the operations that derive."""

# stereo.rs
class StereoFault(ValueError): ...

def match_planes(
    image: _Array2[np.uint8],
    camera: _Array1[np.float64],
    neighbours: Sequence[_Array2[np.uint8]],
    cameras: _Array2[np.float64],
    depths: Sequence[_Array2[np.float32] | None],
    start: _Array2[np.float32] | None,
    start_shape: tuple[int, int],
    rule: SearchRule,
) -> _Array2[np.float32]:
    """A plane for each pixel of a grey picture, by what its neighbours show: inverse depth (1/m), its
    slopes along x and y (1/m/px), and the cost, in (pixels, 4), row by row. cameras: a row of 16
    numbers for each neighbour (focal lengths, principal point, rotation, shift). depths: of each
    neighbour, (h, w) in metres, or None. start: planes of this view at another size (`start_shape`).
    """

# stereo_rules.rs
class SearchRule:
    """How `match_planes` looks for planes. near, far: the depths that are tried (m). views: of the
    neighbours, so many of least cost count. step_px, gamma_grey, gamma_px, noise_grey: of a window.
    consistency, most_px: the cost per pixel by which a neighbour's depth leads elsewhere, and the
    most. vary_depth, vary_normal: how far planes are varied at random.
    """
    def __new__(
        cls,
        *,
        near: float,
        far: float,
        sweeps: int,
        views: int,
        step_px: float,
        gamma_grey: float,
        gamma_px: float,
        noise_grey: float,
        consistency: float,
        most_px: float,
        vary_depth: float,
        vary_normal: float,
        seed: int,
    ) -> SearchRule: ...

class PairRule:
    """How `match_pair` matches. low, count: the disparities that are tried. rows, gamma_colour,
    gamma_px, most: of the costs (3.1, 3.2). path: what a step of one disparity along a row costs,
    and one of more; None takes the least cost of each pixel.
    """
    def __new__(
        cls,
        *,
        low: int,
        count: int,
        rows: int,
        gamma_colour: float,
        gamma_px: float,
        most: int,
        path: tuple[int, int] | None,
    ) -> PairRule: ...

class LinkRule:
    """When a chain of `link_views` goes on. deviation_px: of a link. most_deviations: an estimate that
    is farther off is an outlier. most_across_px: from the epipolar line. near, far: depths (m).
    """
    def __new__(
        cls,
        *,
        deviation_px: float,
        most_deviations: float,
        most_across_px: float,
        near: float,
        far: float,
    ) -> LinkRule: ...

# surface.rs
class SurfaceFault(ValueError): ...

def extract_surface(
    values: _Array3[np.float32], level: float, close: bool
) -> tuple[_Array2[np.float64], _Array2[np.uint32]]:
    """Vertices (v, 3) in samples and triangles (m, 3), counter-clockwise seen from outside, where the
    values (x, y, z) pass the level; less is inside, NaN is not known.
    """

def distances_from_mesh(
    points: _Array2[np.float64], positions: _Array2[np.float64], triangles: _Array2[np.uint32]
) -> tuple[_Array1[np.float64], _Array1[np.uint32]]:
    """Signed distances of points (n, 3) from a mesh, above 0 on the side from which its triangles (m, 3)
    run counter-clockwise, and the nearest triangle of each.
    """

def pieces_of_mesh(triangles: _Array2[np.uint32], vertices: int) -> _Array1[np.int32]:
    """The piece (v,) of each of so many vertices of triangles (m, 3): those of one triangle are of one."""

# surroundings.rs
class Surroundings:
    """The shapes that lots put in the way of others: those that the first of the two passes makes."""
    def __len__(self) -> int: ...
    def __repr__(self) -> str: ...
    def missing_asset(self, lot: int) -> str | None:
        """The asset that a lot's rules want and that is not known; None where nothing is wanted."""

def derive_surroundings(
    rules: GrammarRules,
    lots: Sequence[Sequence[Sequence[tuple[float, float, float]]]],
    seeds: Sequence[int],
    *,
    start: str | None = None,
    attributes: Sequence[
        dict[str, bool | float | str | Sequence[bool] | Sequence[float] | Sequence[str]]
    ],
    edits: Sequence[
        Sequence[
            tuple[
                Sequence[int],
                str | None,
                bool,
                Sequence[int | None],
                Sequence[
                    tuple[
                        str, bool | float | str | Sequence[bool] | Sequence[float] | Sequence[str]
                    ]
                ],
            ]
        ]
    ],
    limits: GrammarLimits | None = None,
) -> Surroundings:
    """Derives what lots put in the way of others, as `derive_lots` derives them. A lot that fails puts
    nothing there; that it takes long is no fault here.
    """

# sweeping.rs
class SweepRule:
    """When a voxel is carved: disagreement of colours (grey levels) that is too much; fewer views that see
    a voxel say nothing of it, more are not asked; the least cosine of the angle under which they do; what
    is so near to an outline (voxels) stays where nothing else holds it up; sweeps at most.
    """
    def __new__(
        cls,
        *,
        spread: float,
        least_views: int,
        most_views: int,
        least_cosine: float,
        rim_voxels: float,
        sweeps: int,
    ) -> SweepRule: ...

def sweep_colours(
    cameras: _Array2[np.float64],
    photos: Sequence[_Array3[np.uint8]],
    distances: Sequence[_Array2[np.float32]],
    corners: _Array2[np.float64],
    solid: _Array3[np.bool_],
    low_m: tuple[float, float, float],
    side_m: float,
    rule: SweepRule,
) -> tuple[_Array3[np.bool_], list[int], _Array1[np.float32]]:
    """What colours that disagree leave of the voxels of a cube: whether each is solid, how many each sweep
    carved, and the spreads (grey levels) of the hull's own voxels. With no sweeps it only measures.
    """

# texture.rs
class LabelFault(ValueError): ...

def label_cells(
    costs: _Array2[np.float32],
    colours: _Array2[np.float32],
    shape: tuple[int, int],
    *,
    base: float,
    slope: float,
    most: float,
    rounds: int,
) -> _Array2[np.uint32]:
    """The label of each of `rows` x `columns` cells. costs: a row per cell, a column per label.
    colours: a row per cell, three columns per label; NaN where it does not see the cell.
    A seam costs `base` and `slope` times the disagreement beside it, at most `most`.
    """

# tiles.rs
class TileBuffers:
    """The buffers of one tile."""
    def __repr__(self) -> str: ...
    @property
    def bounds(self) -> tuple[tuple[float, float, float], tuple[float, float, float]] | None:
        """Lower and upper corner (m, z up); None where there is nothing to draw."""
    @property
    def grid(self) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
        """Where merged positions count from, and their steps (m, y-up)."""
    @property
    def step_m(self) -> float:
        """Metres of a step of repeated positions."""
    @property
    def triangles(self) -> int: ...
    @property
    def dropped(self) -> dict[str, int]:
        """How many surfaces of each rule are none: too thin, or their lines cross."""
    @property
    def materials(self) -> list[tuple[int, int, list[float], float, int | None]]:
        """Class, provenance, sRGB colour, opacity and number of the texture of each material."""
    @property
    def uv_steps(self) -> dict[int, float]:
        """What a step of texture coordinates is, by material: shares of a texture."""
    @property
    def counts(self) -> list[list[int]]:
        """Surfaces of each class, by lot."""
    @property
    def rules(self) -> list[str]:
        """The names of the rules that surfaces come from."""
    @property
    def surfaces(self) -> list[bytes]:
        """Columns of the surfaces: class (u8), building, rule, width and height in mm (u16),
        provenance (u8).
        """
    @property
    def merged(self) -> list[tuple[int, bytes, bytes, bytes, list[int], list[int], bytes]]:
        """Positions are four u16 (the last is zero), features f32, indices u16 or else u32, texture
        coordinates two u16 or empty.
        """
    @property
    def repeated(
        self,
    ) -> list[tuple[int, bytes, bytes, list[int], list[int], bytes, bytes, bytes, bytes, bytes]]:
        """Positions are four i16, indices u16, translations three f32, rotations four i16, features
        u16 where all surfaces of the tile fit, or else f32, scales three f32 or empty, texture
        coordinates two u16 or empty.
        """

# two_views.rs
class MatchFault(ValueError): ...
class UnequalPointsError(MatchFault): ...
class PointNotFiniteError(MatchFault): ...
class TooFewMatchesError(MatchFault): ...
class DegenerateMatchesError(MatchFault): ...

def judge_pairs(
    first: _Array2[np.float64],
    second: _Array2[np.float64],
    offsets: _Array1[np.int64],
    seeds: _Array1[np.int64],
    *,
    draws: int,
    plane_draws: int,
    seven: bool,
    least_px: float,
    largest_px: float,
    least_sigma_px: float,
    min_matches: int,
    min_share: float,
) -> tuple[list[str], _Array2[np.float64], _Array2[np.float64], _Array1[np.bool_]]:
    """Judges pairs of photos: "general", "planar", "too-few" or "mostly-false" of each; F and H, row by
    row in 18 columns, NaN where there is none; sigma (px) and the scores of F and H; and whether
    each match is true. The matches of pair n are rows offsets[n] to offsets[n + 1]. The distances
    are of both photos together; with `seven`, seven matches are drawn instead of eight.
    """

def robust_fundamental(
    first: _Array2[np.float64],
    second: _Array2[np.float64],
    method: str,
    *,
    draws: int,
    seed: int,
    seven: bool,
    limit_px: float | None,
) -> tuple[_Array2[np.float64], float, _Array1[np.bool_]] | None:
    """F, sigma (px, of both photos together) and the matches that are taken to be true; None where no
    draw gives one. method: "ransac", "lmeds" (each with the linear fit over what it keeps) or
    "lmeds-m" (the M-estimator after it). limit_px: the distance up to which RANSAC counts a match;
    where there is none, each draw's own sigma says it (algorithm 3).
    """

def robust_homography(
    first: _Array2[np.float64], second: _Array2[np.float64], *, draws: int, seed: int
) -> tuple[_Array2[np.float64], float, _Array1[np.bool_]] | None:
    """H, sigma (px, of both photos together) and the matches that are taken to be true, by LMedS."""

def linear_fundamental(
    first: _Array2[np.float64], second: _Array2[np.float64], weights: _Array1[np.float64]
) -> _Array2[np.float64]:
    """The normalised eight points over eight or more matches, each with its weight: F of unit length."""

def weigh_models(
    first: _Array2[np.float64],
    second: _Array2[np.float64],
    fundamental: _Array2[np.float64],
    homography: _Array2[np.float64],
    of_fundamental: _Array1[np.bool_],
    of_homography: _Array1[np.bool_],
    least_sigma_px: float,
) -> tuple[bool, float, float]:
    """Whether a homography is taken before a fundamental matrix, and the scores (GRIC) of the latter and
    of the former. Each comes with the matches that it explains; the errors of the fundamental matrix
    are the noise, of `least_sigma_px` at least.
    """

# walk.rs
class WalkFault(ValueError): ...

def walk_label_costs(
    first: Sequence[_Array2[np.float32]],
    second: Sequence[_Array2[np.float32]],
    scales: Sequence[float],
    own: _Array2[np.float32],
    there: _Array2[np.float32],
    scale: _Array1[np.int32],
    lines: _Array2[np.float32],
    offsets: _Array2[np.float32],
    steps: _Array1[np.int32],
    *,
    radius: int,
    band_px: float,
    noise: float,
) -> _Array2[np.float32]:
    """The cost of each label (columns) at each node (rows): 1 - correlation, 4 where it lies outside.

    first, second: grey images, each shrunk by each of the scales. own, there: (n, 2) where a node
    lies in `first` and, by geometry, in `second` (px of the unshrunk images). scale: (n) index of
    its scale; negative: it is the larger in `first`. lines: (n, 3) epipolar lines in `second` of
    unit normal, 0 for none. offsets: (l, 2) px in `second`; steps: (l) along the scales.
    """

def walk_potts(
    costs: _Array2[np.float32],
    node: _Array2[np.int32],
    right: _Array2[np.float32],
    down: _Array2[np.float32],
    solver: str,
    *,
    rounds: int,
) -> tuple[_Array1[np.uint32], float, float]:
    """A labelling of low Potts energy, its energy, and what no labelling goes below.

    costs: (n, l). node: (rows, columns) the numbers of the nodes row by row, -1 for none. right,
    down: the weight between a node and the one on its right, below it. solver: "trws" or "icm".
    """

def walk_rasterise(
    screen: _Array2[np.float32],
    carried: _Array2[np.float32],
    triangles: _Array2[np.uint32],
    width: int,
    height: int,
    *,
    near: float,
) -> tuple[_Array2[np.float32], _Array2[np.float32], _Array2[np.int32]]:
    """Triangles drawn: (h, w) depth, infinite where nothing is; (h w, c) what the surface carries there;
    (h, w) which triangle it is, -1 for none.

    screen: (v, 3) x and y (px) and depth (m) of the vertices. carried: (v, c). triangles: (t, 3).
    """
