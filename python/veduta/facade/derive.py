"""The five rules with the values found, and the derivation tree that they make.

Koutsourakis et al. 2009, equation 2. The tree is what a shape grammar derives from the footprint;
scopes are in facade metres.
"""

from __future__ import annotations

from itertools import pairwise

from veduta.facade.document import (
    DerivationNode,
    Element,
    FacadeBox,
    RuleParameters,
    Split,
)

RULES = {
    "axiom": "axiom -> scale(z; Vl; h_b), translate(z; Rf; h_b)",
    "Vl": "Vl -> component-split(Fc_1)",
    "Rf": "Rf -> mansard(Loft, Top; h_l, h_t)",
    "Fc": "Fc_1 -> split(z; Gf, Fl_1, .., Fl_m; h_0, .., h_m)",
    "Fl": "Fl_i -> split(x; Wa_1, Win_1, .., Win_k, Wa_k+1; w'_1, w_1, .., w_k, w'_k+1)",
}


def rule_parameters(
    rows: list[float], ridge: float, facade: FacadeBox, elements: list[Element], m: float
) -> RuleParameters:
    """Sizes (metres) of the splits. `rows` are the boundaries, eaves first (rectified pixels)."""
    heights = [(b - a) * m for a, b in pairwise(rows)]
    ground = (facade.y_px + facade.height_px - rows[-1]) * m
    return RuleParameters(
        building_height_m=facade.height_m,
        roof_height_m=max(0.0, (rows[0] - ridge) * m),
        facade=facade_split([ground, *reversed(heights)]),
        floors=floor_splits(len(heights), facade.width_m, elements),
    )


def facade_split(sizes_m: list[float]) -> Split:
    """The split of the facade into floors of these heights, from the ground floor up."""
    symbols = ["Gf", *(f"Fl_{i}" for i in range(1, len(sizes_m)))]
    return Split(symbols=symbols, sizes_m=sizes_m)


def floor_splits(count: int, width_m: float, elements: list[Element]) -> list[Split]:
    """The splits of the `count` floors above the ground floor into wall and windows."""
    windows: dict[int, list[Element]] = {}
    for element in elements:
        if element.class_ == "window" and element.floor is not None:
            windows.setdefault(element.floor, []).append(element)
    return [_floor_split(windows.get(i, []), width_m) for i in range(1, count + 1)]


def _floor_split(windows: list[Element], width_m: float) -> Split:
    """A split has no overlaps: a window ends at the facade's side, and begins after the last."""
    symbols: list[str] = []
    sizes: list[float] = []
    at = 0.0
    for window in sorted(windows, key=lambda e: e.x_m):
        right = window.x_m + window.width_m
        start, end = max(window.x_m, at), min(right, width_m)
        if start >= end:
            continue
        number = len(symbols) // 2 + 1
        symbols += [f"Wa_{number}", f"Win_{number}"]
        is_whole = start == window.x_m and end == right
        sizes += [start - at, window.width_m if is_whole else end - start]
        at = end
    symbols.append(f"Wa_{len(symbols) // 2 + 1}")
    sizes.append(max(0.0, width_m - at))
    return Split(symbols=symbols, sizes_m=sizes)


def derivation(rules: RuleParameters, facade: FacadeBox, elements: list[Element]) -> DerivationNode:
    """Apply the five rules from the footprint down to walls and windows."""
    width, height = facade.width_m, facade.height_m
    floors: list[DerivationNode] = []
    y = 0.0
    for i, (symbol, size) in enumerate(
        zip(rules.facade.symbols, rules.facade.sizes_m, strict=True)
    ):
        if i == 0:
            floors.append(_node(symbol, None, 0.0, y, width, size))
        else:
            children = _cells(rules.floors[i - 1], y, size)
            floors.append(_node(symbol, RULES["Fl"], 0.0, y, width, size, children))
        y += size
    front = _node("Fc_1", RULES["Fc"], 0.0, 0.0, width, height, floors)
    volume = _node("Vl", RULES["Vl"], 0.0, 0.0, width, height, [front])
    roof = _node("Rf", RULES["Rf"], 0.0, height, width, rules.roof_height_m)
    return _node("axiom", RULES["axiom"], 0.0, 0.0, width, height, [volume, roof])


def _cells(split: Split, y: float, height: float) -> list[DerivationNode]:
    cells, x = [], 0.0
    for symbol, size in zip(split.symbols, split.sizes_m, strict=True):
        cells.append(_node(symbol, None, x, y, size, height))
        x += size
    return cells


def _node(
    symbol: str,
    rule: str | None,
    x: float,
    y: float,
    width: float,
    height: float,
    children: list[DerivationNode] | None = None,
) -> DerivationNode:
    return DerivationNode(
        symbol=symbol,
        rule=rule,
        x_m=x,
        y_m=y,
        width_m=width,
        height_m=height,
        children=children or [],
    )
