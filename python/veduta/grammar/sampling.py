"""`veduta grammar sample`: what a stochastic grammar can make, as random derivations in a picture.

Each picture is one derivation, and its prior is the product of the chances of its random choices:
the procedural space as O. Moslah shows it (thesis, Cergy-Pontoise 2011, figure 6.7, section 6.5).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from veduta.grammar.building import NothingBuiltError, build_part
from veduta.grammar.derivation import Derivation, Rules
from veduta.grammar.lot import Lot
from veduta.grammar.one_lot import derive_lot
from veduta.grammar.options import GrammarOptions, SampleOptions
from veduta.grammar.outline import Attribute
from veduta.grammar.portrait import AZIMUTH_RAD, Box, in_class_colours, portrait, turned
from veduta.grammar.sheet import MAX_FACTS, Cell, draw_sheet
from veduta.place.part import Part
from veduta.place.semantics import SemanticClass
from veduta.run.errors import InputError
from veduta.run.progress import Progress

MAX_SAMPLES = 64


@dataclass(frozen=True)
class Sample:
    """A random derivation and the part that was built of it.

    along: (2,) the direction of its front from left to right. box_m: lower and upper corner of the
    part, turned so that its front looks to -y.
    """

    seed: int
    derivation: Derivation
    part: Part
    along: NDArray[np.float64]
    box_m: Box


def draw_samples(
    rules: Rules,
    lot: Lot,
    options: GrammarOptions,
    count: int,
    beside: tuple[Lot, ...] = (),
) -> list[Sample]:
    """Derivations with the seeds from that of the options on."""
    found = []
    first = options.derive.seed
    along = lot.rings_m[0][1] - lot.rings_m[0][0]
    for seed in range(first, first + count):
        made = derive_lot(rules, lot, options, seed, beside=beside)
        try:
            columns = made.columns()
            assets = rules.library.assets_of(columns)
            part = build_part(columns, lot.id, assets, rules.textures)
        except NothingBuiltError as fault:
            raise InputError(
                f"seed {seed}", f"makes no building: {fault}", "Mend the rules."
            ) from fault
        low, high = (np.array(corner) for corner in turned(part, along).bounds_m)
        found.append(Sample(seed, made, part, along, (low, high)))
    return found


def picture_cells(
    samples: Sequence[Sample], options: SampleOptions, progress: Progress
) -> list[Cell]:
    """The samples as pictures of one size with what is to be said of each."""
    box = _box_m(samples)
    size = (options.width, _height_px(box, options.width))
    facts = key_attributes([sample.derivation.attributes for sample in samples])
    cells = []
    with progress.over(len(samples)):
        for sample in samples:
            views, part = [], turned(sample.part, sample.along)
            if options.colours != "classes":
                views.append(part)
            if options.colours != "real":
                views.append(in_class_colours(part))
            values = sample.derivation.attributes
            cells.append(
                Cell(
                    title=f"seed {sample.seed}",
                    prior=prior_text(sample.derivation.log_prior),
                    facts=[(name, values[name]) for name in facts if name in values],
                    pictures=[portrait(view, box, size, options.rays) for view in views],
                )
            )
            progress.finished(f"seed {sample.seed}", None)
    return cells


def key_attributes(values: Sequence[dict[str, Attribute]]) -> list[str]:
    """The attributes that tell the samples apart: those with few values before the others."""
    counts = {name: len({one.get(name) for one in values}) for name in values[0]}
    differing = [name for name, count in counts.items() if count > 1]
    differing.sort(key=lambda name: counts[name] >= len(values))  # stable: the file's order stays
    return differing[:MAX_FACTS]


def prior_text(log_prior: float) -> str:
    """A prior as the sheet has it."""
    return f"ln p = {log_prior:.1f}" if math.isfinite(log_prior) else "p = 0"


def sheet_of(
    name: str, lot: Lot, samples: Sequence[Sample], cells: Sequence[Cell], options: SampleOptions
) -> Image.Image:
    """The picture of all."""
    count = len(samples)
    first, last = samples[0].seed, samples[-1].seed
    seeds = f"seed {first}" if count == 1 else f"seeds {first} to {last}"
    what = "one random derivation" if count == 1 else f"{count} random derivations"
    note = f"{what} on the lot {lot.name}, {seeds}; p: product of the chances of all choices"
    classes = classes_of(samples) if options.colours != "real" else []
    return draw_sheet(name, note, cells, columns_of(count, options), classes)


def classes_of(samples: Iterable[Sample]) -> list[SemanticClass]:
    """The classes that there are."""
    codes = {code for sample in samples for code in sample.part.features.class_code.tolist()}
    return [SemanticClass.of_code(code) for code in sorted(codes)]


def columns_of(count: int, options: SampleOptions) -> int:
    """Buildings in a row."""
    return min(count, options.columns or math.ceil(math.sqrt(count)))


def _box_m(samples: Sequence[Sample]) -> Box:
    """The box around all samples, which stand on each other's places."""
    low = np.array([sample.box_m[0] for sample in samples]).min(axis=0)
    return low, np.array([sample.box_m[1] for sample in samples]).max(axis=0)


def _height_px(box_m: Box, width: int) -> int:
    """High enough for the tallest building, within reason."""
    east, north, up = box_m[1] - box_m[0]
    across = max(np.cos(AZIMUTH_RAD) * east + np.sin(AZIMUTH_RAD) * north, 1e-3)
    return int(np.clip(width * (up / across + 0.14), 0.6 * width, 1.7 * width))
