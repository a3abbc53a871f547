"""The plans of a seed: a house in a style, drawn and then scanned."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import get_args

import numpy as np

from veduta.synthetic.plans.annotations import RATIO
from veduta.synthetic.plans.canvas import Image
from veduta.synthetic.plans.degrade import DEGRADATIONS, Degradation
from veduta.synthetic.plans.drawing import draw_sheet
from veduta.synthetic.plans.house import Language
from veduta.synthetic.plans.labels import INCH_M
from veduta.synthetic.plans.layout import make_house
from veduta.synthetic.plans.styles import STYLES, Style
from veduta.synthetic.plans.truth_file import SheetTruth
from veduta.synthetic.seeds import stream

FIRST_TEST_SEED = 10_000
"""Seeds from here on may have any style and degradation; those below, only known ones."""

CLEAN_SHARE = 0.25
OTHER_LANGUAGE_SHARE = 0.5
LANGUAGES: tuple[Language, ...] = get_args(Language)


def choice(seed: int) -> tuple[Style, Degradation]:
    """The style and the degradation of a seed. A quarter of the sheets is clean."""
    tested = seed >= FIRST_TEST_SEED
    styles = [style for style in STYLES if tested or style.split == "development"]
    faults = [fault for fault in DEGRADATIONS if tested or fault.split == "development"]
    rng = stream(seed, "style")
    style = styles[seed % len(styles)]
    if rng.random() < CLEAN_SHARE:
        return style, DEGRADATIONS[0]
    return style, faults[int(rng.integers(1, len(faults)))]


def sheets_of(
    seed: int, style: Style | None = None, fault: Degradation | None = None
) -> Iterator[tuple[Image, SheetTruth]]:
    """The storeys of one house, each as a picture (h, w, 3) and its truth.

    Style and degradation are those of `choice` unless given.
    """
    chosen, damage = choice(seed)
    style, fault = style or chosen, fault or damage
    rng = stream(seed, "language")
    if style.many_languages and rng.random() < OTHER_LANGUAGE_SHARE:
        language = LANGUAGES[int(rng.integers(len(LANGUAGES)))]
        style = replace(style, language=language)
    unseen = tuple(item.name for item in (style, fault) if item.split == "unseen")
    house = make_house(seed, style.language)
    for storey in house.storeys:
        sheet = draw_sheet(storey, style, stream(seed, f"sheet {storey.number}"))
        rng = stream(seed, f"scan {storey.number}")
        picture, scan_from_px = fault.apply(rng, sheet.picture, style.paper)
        affine = np.asarray(scan_from_px @ sheet.px_from_m)
        px_per_m = float(abs(np.linalg.det(affine[:2, :2])) ** 0.5)
        truth = SheetTruth(
            f"{seed:05d}-{storey.number}.png",
            seed,
            style.name,
            fault.name,
            unseen,
            style.walls,
            affine,
            sheet.says_scale,
            px_per_m * INCH_M * RATIO if style.ratio else None,
            sheet.storey,
        )
        yield picture, truth
