"""Rules, derivations and shapes for programs: what `veduta.grammar` offers.

    >>> from veduta import grammar
    >>> rules = grammar.parse("haussmann")
    >>> house = grammar.derive(rules, [[(0, 0), (14, 0), (14, 12), (0, 12)]], seed=7)
    >>> house.log_prior                                   # of all random choices, natural logarithm
    >>> panes = [shape for shape in house.shapes() if shape.name == "Pane"]
    >>> grammar.rederive(panes[0], choices=[1])           # this one otherwise; all others stay

The extension keeps the tree; a `Shape` is a number in it, and asking one for its size copies
nothing else. Lots are metres: x east, y north, z up, the first edge along the street.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from veduta import _core
from veduta.grammar.assets.library import Library
from veduta.grammar.building import build_part
from veduta.grammar.edge_values import EdgeList
from veduta.grammar.edits import Edit, path_text
from veduta.grammar.options import LimitOptions
from veduta.grammar.outline import Attribute
from veduta.grammar.project import SearchPath
from veduta.grammar.project_files import project_files
from veduta.grammar.rules import RuleFiles, compile_rules, find_rules, read_rules
from veduta.grammar.textures import Textures, find_textures, read_textures
from veduta.place.part import Part
from veduta.place.place import Place
from veduta.run.errors import InputError, VedutaError

T = TypeVar("T")
TEXT = "rules.cga"
"""What faults call rules that were given as text."""
Surroundings = tuple[_core.Surroundings, list[tuple[int, tuple[float, float, float]]]]


class StaleShapeError(VedutaError):
    """The shape is one of a tree that was edited since: look it up again by its path."""


@dataclass(frozen=True)
class Rules:
    """A rule file with what it imports, checked and compiled."""

    path: Path
    core: _core.GrammarRules
    library: Library
    textures: Textures

    def with_assets(self, make: Callable[[], T]) -> T:
        """What `make` gives, again where an asset is wanted whose name only the derivation shows.

        GrammarFault where the rules fail; InputError where there is no such asset.
        """
        while True:
            try:
                return make()
            except _core.AssetWanted as wanted:
                self.library.add_to(self.core, str(wanted.args[1]))
                self.textures.add(self.library.pictures)

    def __repr__(self) -> str:
        starts, attributes = len(self.starts), len(self.attributes)
        return f'Rules("{self.path.name}", starts={starts}, attributes={attributes})'

    @property
    def starts(self) -> list[str]:
        """The rules that a derivation can start with, the one that it does start with first."""
        return self.core.starts

    @property
    def attributes(self) -> dict[str, str]:
        """The attributes, and what each takes: `number`, `text`, `bool`, or "" for anything."""
        return dict(self.core.attributes)


@dataclass(frozen=True)
class Choice:
    """A random choice that was made: alternative `index` (from 0) of `of`, with its chance."""

    index: int
    of: int
    chance: float


@dataclass(frozen=True)
class Polygons:
    """Polygons of one shape, in metres.

    corners_m: (n, 3). ring_offsets: (r + 1,) int64, the first corner of each ring. polygon_offsets:
    (p + 1,) int64, the first ring of each polygon, whose first ring is the outline.
    """

    corners_m: NDArray[np.float64]
    ring_offsets: NDArray[np.int64]
    polygon_offsets: NDArray[np.int64]

    def __repr__(self) -> str:
        return f"Polygons(polygons={len(self.polygon_offsets) - 1}, corners={len(self.corners_m)})"


class Derivation:
    """A derived building that stays, with all of its shapes; `derive` makes it."""

    def __init__(
        self, rules: Rules, core: _core.Derivation, edits: Mapping[tuple[int, ...], Edit]
    ) -> None:
        self.rules = rules
        self._core = core
        self._edits = dict(edits)
        self._version = 0

    def __len__(self) -> int:
        return len(self._core)

    def __repr__(self) -> str:
        return f'Derivation("{self.rules.path.name}", shapes={len(self)})'

    @property
    def log_prior(self) -> float:
        """The natural logarithm of the product of the chances of all random choices.

        Those of the rules of all shapes, and of attributes and constants that have chances. What
        `rand` draws has a density and no chance, and does not count.
        """
        return self._core.log_prior

    @property
    def attributes(self) -> dict[str, Attribute]:
        """The value of each attribute; of an array, its text."""
        return {name: value for name, is_attribute, value in self._core.values if is_attribute}

    @property
    def reports(self) -> list[tuple[str, Attribute]]:
        """What the rules reported: key and value, in order."""
        return self._core.reports

    @property
    def messages(self) -> list[str]:
        """What the rules printed."""
        return self._core.messages

    @property
    def edits(self) -> tuple[Edit, ...]:
        """The edits that are in effect, by their paths."""
        return tuple(self._edits[path] for path in sorted(self._edits))

    @property
    def edit_faults(self) -> list[tuple[list[int], str]]:
        """Path and fault of the edits that could not be done."""
        return self._core.edit_faults

    @property
    def root(self) -> Shape:
        """The start shape."""
        return Shape(self, 0)

    def shape(self, path: Sequence[int]) -> Shape | None:
        """The shape at the end of a path: the places of children from the start shape on."""
        number = self._core.find(list(path))
        return None if number is None else Shape(self, number)

    def shapes(self) -> Iterator[Shape]:
        """All shapes, each before what was made of it, in the order of the rules."""
        yield from self.root.walk()

    def leaves(self) -> Iterator[Shape]:
        """The shapes that stay."""
        return (shape for shape in self.shapes() if shape.is_leaf)

    def columns(self) -> _core.DerivedLot:
        """Geometry and looks of all leaves at once, as columns."""
        return self._core.columns()

    def part(self, part_id: str = "building") -> Part:
        """The building as it is now; NothingBuiltError where the rules leave no surface."""
        columns = self.columns()
        assets = self.rules.library.assets_of(columns)
        return build_part(columns, part_id, assets, self.rules.textures)

    def place(self, part_id: str = "building") -> Place:
        """A place with the building alone: to be saved, or written in any format."""
        place = Place(title=part_id)
        place.add(self.part(part_id))
        return place

    def rederive(self, path: Sequence[int], edit: Edit | None = None) -> Shape | None:
        """Derive the shape at `path` anew, with `edit` instead of the one that it had.

        All else stays, so that the tree is what a full derivation with the same edits gives. The
        shape that is then at the path; None where the edit deletes it. InputError where there is
        no such shape or the edit cannot be done: the tree is then as before.
        """
        at = tuple(path)
        before = dict(self._edits)
        self._edits.pop(at, None)
        if edit is not None and not edit.is_empty:
            self._edits[at] = edit
        fault = self._derive_at(at)
        if fault is not None:
            self._edits = before
            self._derive_at(at)
            raise InputError(
                path_text(at, edit.name if edit else None),
                f"cannot be derived anew: {fault}",
                "Look the shape up in the tree.",
            )
        return self.shape(at)

    def _derive_at(self, path: tuple[int, ...]) -> str | None:
        """Bring the tree up to the edits at a path; what stands against it."""
        self._version += 1
        try:
            edits = [edit.core for edit in self.edits]
            found = self.rules.with_assets(lambda: self._core.rederive(list(path), edits))
        except _core.GrammarFault as fault:
            return str(fault)
        if not found:
            return "there is no such shape"
        own = (told for at, told in self.edit_faults if tuple(at) == path)
        return next(own, None)


class Shape:
    """A shape of a derivation, looked at where it is."""

    __slots__ = ("_number", "_version", "derivation")

    def __init__(self, derivation: Derivation, number: int) -> None:
        self.derivation = derivation
        self._number = number
        self._version = derivation._version

    def __repr__(self) -> str:
        return f"Shape({path_text(self.path, self.name)})"

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Shape):
            return NotImplemented
        return (self.derivation, self._number) == (other.derivation, other._number)

    def __hash__(self) -> int:
        return hash((id(self.derivation), self._number))

    @property
    def path(self) -> tuple[int, ...]:
        """The places of children from the start shape on, from 0."""
        return tuple(self._tree.path(self._number))

    @property
    def name(self) -> str:
        """The name of its rule, or that of the leaf."""
        return self._tree.name(self._number)

    @property
    def is_leaf(self) -> bool:
        """Whether it stays: no rule was applied to it."""
        return self._tree.is_leaf(self._number)

    @property
    def parent(self) -> Shape | None:
        """The shape that it was made from."""
        number = self._tree.parent(self._number)
        return None if number is None else Shape(self.derivation, number)

    @property
    def children(self) -> list[Shape]:
        """The shapes that were made from it."""
        return [Shape(self.derivation, number) for number in range(*self._range)]

    @property
    def parameters(self) -> dict[str, Attribute]:
        """What its rule was given, without edits."""
        return dict(self._tree.parameters(self._number))

    @property
    def choices(self) -> list[Choice]:
        """The random choices of its rule."""
        return [Choice(*one) for one in self._tree.choices(self._number)]

    @property
    def surface_class(self) -> str:
        """What it is in the model (`material.name`); "" where the rules do not say it."""
        return self._tree.surface_class(self._number)

    @property
    def colour(self) -> tuple[float, float, float]:
        """The sRGB colour that the rules give it, 0 to 1."""
        red, green, blue = self._tree.colour(self._number)
        return red, green, blue

    @property
    def size_m(self) -> tuple[float, float, float]:
        """The size of its scope along its own x, y and z."""
        x, y, z = self._tree.size_m(self._number)
        return x, y, z

    @property
    def origin_m(self) -> tuple[float, float, float]:
        """Where its scope begins: x east, y north, z up, as the lot has them."""
        x, y, z = self._tree.origin_m(self._number)
        return x, y, z

    def polygons(self) -> Polygons:
        """Its own polygons, copied."""
        return Polygons(*self._tree.polygons(self._number))

    def walk(self) -> Iterator[Shape]:
        """It and all below it, each before what was made of it."""
        waiting = [self._number]
        while waiting:
            number = waiting.pop()
            yield Shape(self.derivation, number)
            waiting += reversed(range(*self._tree.children(number)))

    @property
    def _tree(self) -> _core.Derivation:
        if self._version != self.derivation._version:
            raise StaleShapeError(
                "the tree was edited since this shape was looked up: look it up again by its path"
            )
        return self.derivation._core

    @property
    def _range(self) -> tuple[int, int]:
        return self._tree.children(self._number)


def parse(rules: str | Path, *, style: str | None = None, start: str | None = None) -> Rules:
    """The rules of a file, of a style of Veduta's, or of a text; InputError with all faults.

    A text is what has an arrow (`Lot --> extrude(10)`) or several lines; what it imports is looked
    for in the working folder. style: one of the styles in the file (`style Name`); `Default` where
    it is None. start: the rule that derivations begin with; what it never reaches refuses nothing.
    """
    if isinstance(rules, str) and ("-->" in rules or "\n" in rules):
        files = RuleFiles(Path(TEXT), ((TEXT, rules),), SearchPath.of(Path()))
    else:
        files = read_rules(find_rules(str(rules)))
    core, library = compile_rules(files, style, start), Library(files.search)
    library.add_written_to(core)
    asked = project_files(files.search, core)
    asked.add_to(core)
    texts = [text for _, text in files.files]
    textures = read_textures(find_textures(files.path, texts, files.search, asked.names))
    textures.add(library.pictures)
    return Rules(files.path, core, library, textures)


def derive(
    rules: Rules,
    lot: Sequence[ArrayLike],
    *,
    seed: int = 0,
    start: str | None = None,
    attributes: Mapping[str, Attribute] | None = None,
    edits: Sequence[Edit] = (),
    surroundings: Surroundings | None = None,
    besides: Mapping[str, EdgeList] | None = None,
    limits: LimitOptions | None = None,
) -> Derivation:
    """The building on a lot: rings of (n, 2) or (n, 3) metres, the outline first.

    InputError where the rules fail, or there is no such start rule or attribute. Edits that cannot
    be done are in `Derivation.edit_faults`. limits: what it may cost, and again each shape that is
    made anew by `rederive`; the fault names the option that allows more.
    besides: what is known of its edges, as `veduta.grammar.edge_values` has it.
    surroundings: what stands beside the lot, and how far off; `inter` asks about it.
    """
    for name in attributes or ():
        if name not in rules.attributes:
            known = ", ".join(list(rules.attributes)[:12])
            raise InputError(name, f"is no attribute of {rules.path.name}", f"It has: {known}.")
    rings = [_ring(ring) for ring in lot]
    around, beside = surroundings or (None, None)

    def derived() -> _core.Derivation:
        return _core.Derivation(
            rules.core,
            rings,
            seed,
            start=start,
            attributes={**(attributes or {}), **(besides or {})},
            edits=[edit.core for edit in edits],
            around=around,
            beside=beside,
            limits=(limits or LimitOptions()).core,
        )

    try:
        core = rules.with_assets(derived)
    except _core.GrammarFault as fault:
        raise InputError(
            rules.path, f"cannot be derived: {fault}", "Mend the rules or the lot."
        ) from fault
    return Derivation(rules, core, {edit.path: edit for edit in edits})


def rederive(
    shape: Shape,
    *,
    delete: bool = False,
    choices: Sequence[int | None] = (),
    values: Mapping[str, Attribute] | None = None,
) -> Shape | None:
    """Derive one shape anew, edited like this; without any edit, as the seed has it.

    The shape that is then in its place; None where it is deleted. See `Derivation.rederive`.
    """
    given = tuple((values or {}).items())
    edit = Edit(shape.path, shape.name, delete, tuple(choices), given)
    return shape.derivation.rederive(shape.path, edit)


def log_prior(derivation: Derivation) -> float:
    """The natural logarithm of a derivation's prior probability; see `Derivation.log_prior`."""
    return derivation.log_prior


def _ring(ring: ArrayLike) -> list[tuple[float, float, float]]:
    points = np.asarray(ring, dtype=np.float64)
    if points.ndim != 2 or points.shape[1] not in (2, 3) or not np.isfinite(points).all():
        raise InputError(
            "lot", "a ring is no list of points of two or three finite numbers", "Give metres."
        )
    flat = points if points.shape[1] == 3 else np.column_stack([points, np.zeros(len(points))])
    return [(x, y, z) for x, y, z in flat.tolist()]
