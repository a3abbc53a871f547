"""What an edit of a document changes elsewhere in it: metres, rules and the derivation tree.

Pixels and the scale decide. The metres of the facade and the elements, the splits of the floors
and the tree follow from them. What they cannot say is kept as it is written: the heights of the
floors (`rules.facade`) and of the roof (`rules.roof_height_m`). The tree that came with the
document tells which of these somebody has edited, for it still holds the values that were found.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import accumulate, pairwise
from statistics import median

from pydantic import JsonValue

from veduta.facade.derive import derivation, facade_split, floor_splits
from veduta.facade.document import (
    DerivationNode,
    Element,
    FacadeBox,
    FacadeDocument,
    RuleParameters,
    Split,
)
from veduta.facade.edit_notes import Edits, told
from veduta.facade.shape import fitted_outline

TOLERANCE = 0.01
"""Metres that differ from what the pixels say by no more than this are left alone."""
# How much two scales may differ to be the same but for the rounding of metres, and the most that
# one may be of the other: beyond that, the metres tell nothing.
_SAME_SCALE, _ANY_SCALE = 1e-3, 1e3
# Share of its height that the top floor must keep to be one when the eaves come down.
_STILL_A_FLOOR = 0.5


@dataclass(frozen=True)
class _Before:
    """The document before it was edited, as far as its metres and its tree still tell.

    `metres_per_px` and `ground_px` (the facade's lower border) are medians over all elements, so
    that one which was edited or added does not move them. None: the tree does not tell.
    """

    metres_per_px: float
    ground_px: float
    floors_m: list[float] | None
    roof_m: float | None


def contradictions(document: FacadeDocument) -> list[str]:
    """Edits that cannot all be kept, each with its place in the file."""
    sizes, height = document.rules.facade.sizes_m, _height_m(document)
    found_m = _before(document).floors_m
    found = []
    if not (_same_sizes(sizes, found_m) or _adds_up(sizes, height)):
        found.append(
            f"rules.facade.sizes_m: the floors are {sum(sizes):g} m high together, but the facade"
            f" {height:g} m (facade.height_px x scale.metres_per_px)"
        )
    if document.storeys not in {len(sizes), len(found_m or sizes)}:
        found.append(
            f"storeys: {document.storeys}, but rules.facade.sizes_m has {len(sizes)} floors;"
            " write their heights there"
        )
    return found


def reconciled(document: FacadeDocument) -> FacadeDocument:
    """The document in agreement with itself, with a note of each thing that was made anew.

    A document that agrees already comes back as it is, to the last digit.
    """
    before = _before(document)
    with_metres, moved = _with_metres(document, before)
    done = _with_rules(with_metres, document, before)
    scale = document.scale.metres_per_px
    edits = Edits(
        metres=tuple(moved),
        rules=done is not with_metres,
        floors=_are_floors_edited(done, document, before),
        scale=before.metres_per_px != scale,
    )
    return told(done, edits)


def _before(document: FacadeDocument) -> _Before:
    box, elements = document.facade, document.elements
    pairs = [(box.width_m, box.width_px), (box.height_m, box.height_px)]
    for item in elements:
        pairs += [(item.width_m, item.width_px), (item.height_m, item.height_px)]
    scale = document.scale.metres_per_px
    told = median(m / px for m, px in pairs)
    if abs(told / scale - 1.0) > _SAME_SCALE and 1 / _ANY_SCALE < told / scale < _ANY_SCALE:
        scale = told
    grounds = [item.y_px + item.height_px + item.y_m / scale for item in elements]
    volume, roof = _child(document.derivation, "Vl"), _child(document.derivation, "Rf")
    front = _child(volume, "Fc_1")
    return _Before(
        metres_per_px=scale,
        ground_px=median(grounds) if grounds else box.y_px + box.height_px,
        floors_m=[floor.height_m for floor in front.children] if front else None,
        roof_m=roof.height_m if roof else None,
    )


def _child(node: DerivationNode | None, symbol: str) -> DerivationNode | None:
    children = node.children if node else []
    return next((child for child in children if child.symbol == symbol), None)


def _height_m(document: FacadeDocument) -> float:
    return document.facade.height_px * document.scale.metres_per_px


def _adds_up(sizes: list[float], height_m: float) -> bool:
    return abs(sum(sizes) - height_m) <= TOLERANCE * max(1, len(sizes))


def _same_sizes(sizes: list[float], others: list[float] | None) -> bool:
    return others is not None and _agree(list(sizes), list(others))


def _agree(one: JsonValue, other: JsonValue) -> bool:
    """Whether two values are the same but for numbers within the tolerance."""
    if isinstance(one, dict) and isinstance(other, dict):
        return one.keys() == other.keys() and all(_agree(one[key], other[key]) for key in one)
    if isinstance(one, list) and isinstance(other, list):
        return len(one) == len(other) and all(map(_agree, one, other))
    if isinstance(one, float) and isinstance(other, float):
        return abs(one - other) <= TOLERANCE
    return one == other


def _with_metres(document: FacadeDocument, before: _Before) -> tuple[FacadeDocument, list[str]]:
    """The document with all metres as the pixels and the scale say, and the names of what moved."""
    scale, box = document.scale.metres_per_px, document.facade
    # Small sizes differ by less than the tolerance under another scale; left as they are written
    # they would tell the old one again when the document is read the next time.
    rescaled = before.metres_per_px != scale
    moved: list[str] = []

    def agreed(name: str, written: float, pixels: float) -> float:
        if abs(written - pixels * scale) > TOLERANCE:
            moved.append(name)
        elif not rescaled:
            return written
        return pixels * scale

    facade = box.model_copy(
        update={
            "width_m": agreed("the facade", box.width_m, box.width_px),
            "height_m": agreed("the facade", box.height_m, box.height_px),
        }
    )
    below = box.y_px + box.height_px
    elements = []
    for index, item in enumerate(document.elements):
        name = f"{item.class_} (elements[{index}])"
        metres: dict[str, object] = {
            "x_m": agreed(name, item.x_m, item.x_px - box.x_px),
            "y_m": agreed(name, item.y_m, below - item.y_px - item.height_px),
            "width_m": agreed(name, item.width_m, item.width_px),
            "height_m": agreed(name, item.height_m, item.height_px),
        }
        metres |= {"outline_px": fitted_outline(item)}
        elements.append(item.model_copy(update=metres))
    return document.model_copy(update={"facade": facade, "elements": elements}), moved


def _with_rules(
    document: FacadeDocument, written: FacadeDocument, before: _Before
) -> FacadeDocument:
    """The document (its metres agree) with rules, tree and floors made anew where they do not."""
    facade, split = document.facade, _facade_split(document, before)
    elements = _with_floors(document, written, split.sizes_m, before)
    rules = RuleParameters(
        building_height_m=facade.height_m,
        roof_height_m=_roof_m(document, before),
        facade=split,
        floors=floor_splits(len(split.sizes_m) - 1, facade.width_m, elements),
    )
    tree = derivation(rules, facade, elements)
    same_rules = _agree(rules.model_dump(), document.rules.model_dump())
    same_tree = _agree(tree.model_dump(), document.derivation.model_dump())
    if same_rules and same_tree and elements == document.elements:
        return document
    update = {"elements": elements, "rules": rules, "derivation": tree}
    return document.model_copy(update=update | {"storeys": len(split.sizes_m)})


def _are_floors_edited(done: FacadeDocument, written: FacadeDocument, before: _Before) -> bool:
    """Whether the floors are others than were found: not by the scale alone."""
    if before.floors_m is None:
        return False
    sizes = _scaled(before.floors_m, written, before)
    return not _same_sizes(done.rules.facade.sizes_m, sizes)


def _with_floors(
    document: FacadeDocument, written: FacadeDocument, sizes_m: list[float], before: _Before
) -> list[Element]:
    """The elements, each window in the floor that holds it; the rules say nothing of others."""
    edited = before.floors_m is not None and not _same_sizes(
        document.rules.facade.sizes_m, before.floors_m
    )
    elements = []
    for item, old in zip(document.elements, written.elements, strict=True):
        gone = item.floor is not None and not 0 <= item.floor < len(sizes_m)
        if item.class_ == "window" and (
            edited or gone or _floor_is_doubtful(item, old, document.facade, before)
        ):
            item = item.model_copy(update={"floor": _floor_at(item, sizes_m)})
        elements.append(item)
    return elements


def _roof_m(document: FacadeDocument, before: _Before) -> float:
    """As written; a roof that nobody edited grows with the scale."""
    roof_m = document.rules.roof_height_m
    if before.roof_m is None or not _agree(roof_m, before.roof_m):
        return roof_m
    return _scaled([roof_m], document, before)[0]


def _scaled(sizes: list[float], document: FacadeDocument, before: _Before) -> list[float]:
    """Sizes in the document's metres, from those that it had before."""
    if before.metres_per_px == document.scale.metres_per_px:
        return sizes
    return [size * document.scale.metres_per_px / before.metres_per_px for size in sizes]


def _facade_split(document: FacadeDocument, before: _Before) -> Split:
    """The heights of the floors: as written, or brought to a facade whose border was moved."""
    split = document.rules.facade
    if not _same_sizes(split.sizes_m, before.floors_m):
        return facade_split(split.sizes_m)  # `contradictions` has made sure that they add up
    sizes = _scaled(split.sizes_m, document, before)
    if not _adds_up(sizes, document.facade.height_m):
        return facade_split(_moved_floors(sizes, document.facade, document, before))
    return split if sizes is split.sizes_m else Split(symbols=split.symbols, sizes_m=sizes)


def _moved_floors(
    sizes: list[float], box: FacadeBox, document: FacadeDocument, before: _Before
) -> list[float]:
    """The floors between the facade's new borders; those inside of it stay where they are.

    A top floor of which the new eaves leave less than half belongs to the one below it.
    """
    m = document.scale.metres_per_px
    shift_m = (box.y_px + box.height_px - before.ground_px) * m
    inner = [at + shift_m for at in accumulate(sizes[:-1])]
    borders = [0.0, *(min(max(at, 0.0), box.height_m) for at in inner), box.height_m]
    moved = [upper - lower for lower, upper in pairwise(borders)]
    while len(moved) > 1 and moved[-1] < _STILL_A_FLOOR * sizes[len(moved) - 1]:
        rest = moved.pop()
        moved[-1] += rest
    return moved


def _floor_is_doubtful(item: Element, old: Element, facade: FacadeBox, before: _Before) -> bool:
    """Whether a window may stand in another floor than the one that it names."""
    if (item.floor is None) != (item.y_m + item.height_m / 2 > facade.height_m):
        return True
    # Its metres as they were written, beside those of its pixels before other things were edited.
    m = before.metres_per_px
    up_m = (before.ground_px - item.y_px - item.height_px) * m
    return max(abs(old.y_m - up_m), abs(old.height_m - item.height_px * m)) > TOLERANCE


def _floor_at(item: Element, sizes_m: list[float]) -> int | None:
    """The floor that holds the middle of an element; None above the eaves."""
    middle = item.y_m + item.height_m / 2
    tops = accumulate(sizes_m)
    return next((floor for floor, top in enumerate(tops) if middle <= top), None)
