"""What the report tells of a style: the odds, the search, and the procedural space (figure 6.7)."""

from __future__ import annotations

import math
from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageColor

from veduta.facade.style.grammar import ANY_FRONT
from veduta.facade.style.infer import AUTO, Candidate, StyleFound
from veduta.facade.style.labels import painted
from veduta.facade.style.observed import LABELS, Observed
from veduta.facade.style.posterior import Scored
from veduta.facade.style.state import SCALE
from veduta.grammar.portrait import CLASS_COLOURS
from veduta.grammar.sheet import Cell, draw_sheet, encoded
from veduta.place.semantics import SemanticClass
from veduta.run.page import Picture, Table

Cells = float | int | str | None
SAMPLES = 5
_PICTURE_PX = 300
_MOST_ODDS = 1000
CAVEAT = "odds that few fronts were compared for, and may be too sure"
"""What is said with odds wherever they are told."""


def style_line(found: StyleFound) -> str:
    """The style with its odds, as notes and the report have it."""
    name, chance = found.candidates[0].name, found.chances[0]
    told = "none of the styles" if name == ANY_FRONT else name
    rest = 1.0 - chance
    odds = _MOST_ODDS if rest <= 0.0 else chance / rest
    said = f"more than {_MOST_ODDS} to 1" if odds >= _MOST_ODDS else f"{odds:.3g} to 1"
    line = f"style: {told}, {said} against the others"
    if name == ANY_FRONT:
        return f"{line}; of the styles, {found.chosen.name} fits best"
    return line


def next_step(found: StyleFound, asked: str) -> str:
    """What one can do with it: derive the rules, or name another style."""
    again = "Its rules, with what was found: style/rules.cga (`veduta grammar derive`)"
    if asked != AUTO:
        return again
    others = [c.name for c in found.candidates if c.name not in (ANY_FRONT, found.chosen.name)]
    return (
        f"{again}; where you know better, name the style: --style {others[0]}" if others else again
    )


def style_tables(found: StyleFound) -> list[Table]:
    """Odds of all candidates, and the search of the likeliest."""
    rows: list[list[Cells]] = [
        [
            "none of these" if one.name == ANY_FRONT else one.name,
            round(chance, 4),
            round(one.best.log_likelihood, 1),
            round(one.best.log_prior, 1),
            round(one.log_evidence, 1),
            round(one.posterior.evidence_score(one.best), 2),
        ]
        for one, chance in zip(found.candidates, found.chances, strict=True)
    ]
    columns = ("style", "chance", "ln likelihood", "ln prior", "ln evidence", "thesis's score")
    note = (
        "How well the rules of each style explain what the eyes saw; all styles were equally likely"
        " before. The thesis's score is the sum of position and size evidence of single elements."
    )
    return [Table("Style", columns, rows, note=note), _attributes(found.chosen), *_search(found)]


def _attributes(chosen: Candidate) -> Table:
    best = chosen.best.state
    samples = chosen.searched.samples if chosen.searched else ()
    rows: list[list[Cells]] = []
    for name, value in best.attributes.items():
        if isinstance(value, float):
            spread = np.std([float(s.state.attributes[name]) for s in samples]) if samples else 0.0
            rows.append([name, round(value, 3), round(float(spread), 3)])
        else:
            rows.append([name, str(value).lower(), None])
    for path, taken in sorted(best.choices.items()):
        told = ", ".join("-" if k is None else str(k + 1) for k in taken.alternatives)
        share = np.mean([s.state.choices.get(path) == taken for s in samples]) if samples else 1.0
        rows.append([f"{taken.rule} takes", told, round(float(share), 3)])
    note = (
        f"{SCALE}: metres of the style in one of the document. Last, the deviation of a number"
        " among the samples, and for a rule the share of samples with this alternative."
    )
    return Table(f"Structure: {chosen.name}", ("what", "value", "how sure"), rows, note=note)


def _search(found: StyleFound) -> list[Table]:
    searched = found.chosen.searched
    if searched is None:
        return []
    rows: list[list[Cells]] = [
        [
            f"1 / {chain.beta:g}",
            chain.proposed,
            round(chain.acceptance, 3),
            round(chain.best.log_posterior, 2),
        ]
        for chain in searched.chains
    ]
    columns = ("temperature", "proposed", "accepted", "best ln posterior")
    note = (
        f"Metropolis-Hastings with {len(searched.chains)} chains, {searched.steps} steps in"
        f" {searched.seconds:.1f} s; {searched.exchanged} of {searched.exchanges} exchanges were"
        " made."
    )
    return [Table("Search", columns, rows, note=note, for_experts=True)]


def style_picture(found: StyleFound) -> Picture:
    """The procedural space around the best structure."""
    note = "What the eyes saw, the best structure of the style, and samples of the search."
    data = encoded(style_sheet(found), ".png")
    return Picture("Style", note, data, "image/png", "style/space.png", wide=True)


def style_sheet(found: StyleFound) -> Image.Image:
    """What was seen, the best structure, and others of the style with what they come to."""
    chosen, observed = found.chosen, found.chosen.posterior.observed
    cells = [Cell("seen", "", [], [_drawn(observed.ratios.argmax(axis=0))])]
    cells.append(_cell("best", chosen.best, observed))
    for number, scored in enumerate(_spread(chosen), start=1):
        cells.append(_cell(f"sample {number}", scored, observed))
    note = "ln p: of prior and likelihood together"
    return draw_sheet(chosen.name, note, cells, min(len(cells), 4), _CLASSES)


def _cell(title: str, scored: Scored, observed: Observed) -> Cell:
    labels = painted(scored.front, observed.shape, observed.cell_m)
    values = scored.state.attributes
    names = ("storeys", "bayWidth", "storeyHeight", SCALE)
    facts = [(name, values[name]) for name in names if name in values]
    return Cell(title, f"ln p = {scored.log_posterior:.1f}", facts, [_drawn(labels)])


def _spread(chosen: Candidate) -> Sequence[Scored]:
    """Samples of the coldest chain and structures of the hotter ones, evenly apart."""
    if chosen.searched is None:
        return []
    samples = chosen.searched.samples
    picked = [samples[k] for k in np.linspace(0, len(samples) - 1, SAMPLES - 2).astype(int)]
    hot = [chain.at for chain in chosen.searched.chains[1:]]
    unlike = {one.state.key: one for one in (*picked, *hot)}
    return list(unlike.values())[:SAMPLES]


_CLASSES = [SemanticClass(name) for name in LABELS if name in {c.value for c in SemanticClass}]
_SKY = "#d0e2ee"
_HEXES = [_SKY if name == "sky" else CLASS_COLOURS[SemanticClass(name)] for name in LABELS]
_PALETTE = np.array([ImageColor.getrgb(colour) for colour in _HEXES], dtype=np.uint8)


def _drawn(labels: NDArray[np.intp]) -> NDArray[np.uint8]:
    pixels = _PALETTE[labels[::-1]]
    times = max(1, math.ceil(_PICTURE_PX / pixels.shape[1]))
    return np.asarray(
        cv2.resize(pixels, None, fx=times, fy=times, interpolation=cv2.INTER_NEAREST), np.uint8
    )
