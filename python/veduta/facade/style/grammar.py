"""A style as a stochastic grammar of fronts: states are derived, what they leave open is drawn."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import takewhile
from pathlib import Path as FilePath

import numpy as np

from veduta import _core
from veduta.facade.style.elevation import elevation
from veduta.facade.style.labels import Front, front_of
from veduta.facade.style.prior import Distribution, Real, distributions
from veduta.facade.style.state import SCALE, Path, State, Taken
from veduta.grammar.derivation import Rules, parse
from veduta.grammar.edits import CoreEdit, Edit
from veduta.grammar.rules import STYLES

LOD = 1.5
"""The styles' own level of detail at which balconies are there and windows are one panel."""
DEPTH_M = 10.0
SEED = 0
"""Of what one does not see from the street, such as colours."""
ANY_FRONT = "none"
"""The name of the grammar that stands for no style: any front with floors and columns."""
_ANY_FILE = FilePath(__file__).with_name("any_front.cga")
_MAX_PASSES = 8
_KEPT_TREES = 8
"""Trees that stay at hand to be cut: those of the chains, and of what was tried last."""


@dataclass(frozen=True)
class Derived:
    """A complete state, and the front that it makes."""

    state: State
    front: Front


@dataclass
class StyleGrammar:
    """One style on a lot that is `width_m` wide in the document's metres.

    distributions: of its attributes, with that of the scale. chances: of the alternatives of each
    random choice, by rule and number of the choice; None where nobody sees which one was taken.
    Both fill as derivations meet rules. derived, cut: how many trees were derived as a whole, and
    how many from a shape down.
    """

    name: str
    rules: Rules
    distributions: dict[str, Distribution]
    width_m: float
    chances: dict[tuple[str, int], tuple[float, ...] | None] = field(default_factory=dict)
    derived: int = 0
    cut: int = 0
    _trees: dict[tuple[object, ...], _core.Derivation] = field(default_factory=dict, repr=False)

    def start(self) -> State:
        """The likeliest value of each attribute, and no choices."""
        return State({name: d.middle for name, d in self.distributions.items()}, {})

    def draw(self, rng: np.random.Generator) -> State:
        """Attributes by chance, and no choices."""
        return State({name: d.draw(rng) for name, d in self.distributions.items()}, {})

    def log_prior(self, state: State) -> float:
        """Of a complete state."""
        return state.log_prior(self.distributions)

    def complete(
        self, state: State, rng: np.random.Generator, near: tuple[State, Path] | None = None
    ) -> Derived | None:
        """Derive a state, draw what it leaves open, and drop what it has no shapes for.

        near: a state with the same attributes, and the shape at or below which alone its choices
        are others: where its tree is at hand, that is derived from there down. None where the
        rules make no building of it.
        """
        tree = self._near(state, near)
        for _ in range(_MAX_PASSES):
            if tree is None:
                return None
            choices, is_whole = self._choices(tree, state, rng)
            whole = replace(state, choices=choices)
            if is_whole:
                self._keep(whole, tree)
                return Derived(whole, self._front(tree, state.scale))
            changed = [p for p, taken in choices.items() if state.choices.get(p) != taken]
            state = whole
            tree = self._from(tree, state, _common(changed))
        return None

    def _near(self, state: State, near: tuple[State, Path] | None) -> _core.Derivation | None:
        before = None if near is None else self._trees.get(near[0].key)
        if near is None or before is None:
            return self._tree(state)
        return self._from(before.copy(), state, near[1])

    def _from(self, tree: _core.Derivation, state: State, cut: Path) -> _core.Derivation | None:
        """The tree of a state, whose choices alone differ from the tree's, at or below the cut."""
        found = self._cut(tree, cut, _edits(state))
        return self._tree(state) if found is None else found

    def _cut(
        self, tree: _core.Derivation, path: Path, edits: list[CoreEdit]
    ) -> _core.Derivation | None:
        """The tree itself, derived anew from a shape down; None where that is not to be."""
        self.cut += 1
        try:
            is_done = self.rules.with_assets(lambda: tree.rederive(list(path), edits))
        except _core.GrammarFault:
            return None
        return tree if is_done else None

    def _keep(self, state: State, tree: _core.Derivation) -> None:
        self._trees.pop(state.key, None)
        self._trees[state.key] = tree
        if len(self._trees) > _KEPT_TREES:
            del self._trees[next(iter(self._trees))]

    def alternatives(self, path: Path, taken: Taken) -> Iterator[Taken]:
        """All that a shape's rule could take, in the choices that one sees."""
        options: list[tuple[int | None, ...]] = [()]
        for slot in range(len(taken.alternatives)):
            chances = self.chances.get((taken.rule, slot))
            own: list[int | None] = [None] if chances is None else list(range(len(chances)))
            options = [(*before, one) for before in options for one in own]
        for option in options:
            yield Taken(taken.rule, option, self._log_chance(taken.rule, option))

    def _log_chance(self, rule: str, taken: tuple[int | None, ...]) -> float:
        total = 0.0
        for slot, number in enumerate(taken):
            chances = self.chances[rule, slot]
            if chances is not None and number is not None:
                total += math.log(chances[number]) if chances[number] > 0.0 else -math.inf
        return total

    def _choices(
        self, tree: _core.Derivation, state: State, rng: np.random.Generator
    ) -> tuple[dict[Path, Taken], bool]:
        """What the shapes of a tree took or shall take, and whether the tree has it already."""
        found: dict[Path, Taken] = {}
        is_whole = True
        for number in tree.random_shapes:
            made = tree.choices(number)
            rule = tree.name(number)
            seen = [self._chances(tree, number, slot, state) for slot in range(len(made))]
            if all(chances is None for chances in seen):
                continue
            path = tuple(tree.path(number))
            before = state.choices.get(path)
            if before is not None and before.rule == rule and len(before.alternatives) == len(made):
                found[path] = before
                continue
            drawn = tuple(
                None if chances is None else int(rng.choice(len(chances), p=chances))
                for chances in seen
            )
            is_whole &= all(
                one is None or one == index for one, (index, _, _) in zip(drawn, made, strict=True)
            )
            found[path] = Taken(rule, drawn, self._log_chance(rule, drawn))
        return found, is_whole

    def _chances(
        self, tree: _core.Derivation, number: int, slot: int, state: State
    ) -> tuple[float, ...] | None:
        """Of the alternatives of a choice; the first time by trying them one after the other."""
        key = (tree.name(number), slot)
        if key in self.chances:
            return self.chances[key]
        path, count = tuple(tree.path(number)), tree.choices(number)[slot][1]
        chances, fronts = [], []
        for one in range(count):
            forced = (*[None] * slot, one)
            edits = _edits(state, Edit(path, key[0], choices=forced))
            other = self._cut(tree.copy(), path, edits)
            place = None if other is None else other.find(list(path))
            if other is None or place is None or len(other.choices(place)) <= slot:
                return None
            chances.append(other.choices(place)[slot][2])
            fronts.append(self._front(other, state.scale))
        is_seen = any(not _same(fronts[0], front) for front in fronts[1:])
        total = sum(chances)
        self.chances[key] = tuple(c / total for c in chances) if is_seen else None
        return self.chances[key]

    def _tree(self, state: State) -> _core.Derivation | None:
        width = self.width_m * state.scale
        corners = [(0.0, 0.0, 0.0), (width, 0.0, 0.0), (width, DEPTH_M, 0.0), (0.0, DEPTH_M, 0.0)]
        attributes = {name: v for name, v in state.attributes.items() if name != SCALE}
        self.derived += 1
        try:
            return self.rules.with_assets(
                lambda: _core.Derivation(
                    self.rules.core,
                    [corners],
                    SEED,
                    attributes={**attributes, "LOD": LOD},
                    edits=_edits(state),
                )
            )
        except _core.GrammarFault:
            return None

    def _front(self, tree: _core.Derivation, scale: float) -> Front:
        columns = tree.columns()
        found = elevation(columns, self.rules.library.assets_of(columns))
        return front_of(found, self.width_m * scale, scale)


def _edits(state: State, *more: Edit) -> list[CoreEdit]:
    """The choices of a state, but for those that `more` has."""
    edits = [
        Edit(path, taken.rule, choices=taken.alternatives).core
        for path, taken in sorted(state.choices.items())
        if path not in {edit.path for edit in more}
    ]
    return [*edits, *(edit.core for edit in more)]


def _common(paths: Sequence[Path]) -> Path:
    """The shape that all of these are at or below."""
    first, last = min(paths, default=()), max(paths, default=())
    shared = takewhile(lambda pair: pair[0] == pair[1], zip(first, last, strict=False))
    return tuple(place for place, _ in shared)


def _same(one: Front, other: Front) -> bool:
    if (one.eaves_m, one.top_m) != (other.eaves_m, other.top_m):
        return False
    pairs = ((boxes, other.boxes[kind]) for kind, boxes in one.boxes.items())
    return all(a.shape == b.shape and np.allclose(a, b, atol=1e-3) for a, b in pairs)


def style_grammar(name: str, width_m: float, scale: Real) -> StyleGrammar:
    """The grammar of a style, or of any front, on a lot of this width; `scale` is its prior."""
    path = _ANY_FILE if name == ANY_FRONT else STYLES / f"{name}.cga"
    own = distributions(path.read_text(encoding="utf-8"))
    rules = parse(path)
    return StyleGrammar(name, rules, {**own, SCALE: scale}, width_m)
