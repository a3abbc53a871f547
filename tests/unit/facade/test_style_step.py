"""`--style`: the style of a front that its own rules drew, with odds, files and report."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from sample_document import sample_document
from test_style_search import CELLS, WIDTH_M

from veduta.facade.document import FacadeDocument
from veduta.facade.options import StyleOptions
from veduta.facade.style import find_style, require_style
from veduta.facade.style.deformed import deformed
from veduta.facade.style.elevation import elevation
from veduta.facade.style.grammar import ANY_FRONT, LOD, style_grammar
from veduta.facade.style.infer import (
    AUTO,
    InferParameters,
    StyleFound,
    candidate_names,
    infer_style,
    log_odds_of_none,
    ranked,
)
from veduta.facade.style.labels import Front, front_of, painted
from veduta.facade.style.likelihood import log_likelihood
from veduta.facade.style.observed import LABELS, Observed, observed_of
from veduta.facade.style.prior import Real
from veduta.facade.style.search import SearchParameters
from veduta.facade.style.told import style_line, style_picture, style_tables
from veduta.facade.style.write import style_files
from veduta.facade.style_told import StyleTold
from veduta.grammar.derivation import derive, parse
from veduta.grammar.edits import read_edits
from veduta.run.errors import InputError
from veduta.run.progress import no_progress

STEPS = SearchParameters(seconds=60.0, steps=60)


def seen_as(style: str, seed: int = 3) -> tuple[Front, Observed]:
    """A front of a style by chance, and what good eyes see of it."""
    rng = np.random.default_rng(seed)
    grammar = style_grammar(style, WIDTH_M, Real(0.99, 1.01, 0.98, 1.02))
    derived = grammar.complete(grammar.start(), rng)
    assert derived is not None
    front = derived.front
    shape = round((front.top_m + 1.0) / CELLS.cell_m), round(WIDTH_M / CELLS.cell_m)
    labels = painted(front, shape, CELLS.cell_m)
    chances = np.full((len(LABELS), *shape), 0.3 / (len(LABELS) - 1))
    np.put_along_axis(chances, labels[None], 0.7, axis=0)
    return front, observed_of(chances, (WIDTH_M, front.eaves_m), dict(front.boxes), CELLS)


def document_of(front: Front) -> FacadeDocument:
    """A document of this size whose floors are what a first half may have read."""
    document = sample_document()
    floors = max(2, round(front.eaves_m / 3.6))
    sizes = [front.eaves_m / floors] * floors
    split = document.rules.facade.model_copy(
        update={"sizes_m": sizes, "symbols": ["Gf", *["Fl"] * (floors - 1)]}
    )
    size = {"width_m": WIDTH_M, "height_m": front.eaves_m}
    return document.model_copy(
        update={
            "facade": document.facade.model_copy(update=size),
            "rules": document.rules.model_copy(update={"facade": split}),
        }
    )


@pytest.fixture(scope="module")
def haussmann() -> StyleFound:
    front, observed = seen_as("haussmann")
    return infer_style(document_of(front), observed, AUTO, STEPS)


def test_the_style_is_told_with_odds(haussmann: StyleFound) -> None:
    assert haussmann.chosen.name == "haussmann"
    assert haussmann.candidates[0].name == "haussmann"
    assert sum(haussmann.chances) == pytest.approx(1.0)
    assert {one.name for one in haussmann.candidates} <= {*candidate_names(AUTO), ANY_FRONT}
    assert style_line(haussmann).startswith("style: haussmann, ")


def test_none_of_these_is_told_with_what_fits_best(haussmann: StyleFound) -> None:
    none = [one for one in haussmann.candidates if one.name == ANY_FRONT]
    told = style_line(ranked(none, haussmann.chosen))
    assert told.startswith("style: none of the styles, more than 1000 to 1")
    assert told.endswith("of the styles, haussmann fits best")


def test_the_report_has_the_search_and_the_space(haussmann: StyleFound) -> None:
    titles = [table.title for table in style_tables(haussmann)]
    assert titles == ["Style", "Structure: haussmann", "Search"]
    assert len(style_tables(haussmann)[2].rows) == len(SearchParameters().betas)
    assert style_picture(haussmann).data.startswith(b"\x89PNG")


def test_the_files_derive_to_the_structure_that_was_found(
    haussmann: StyleFound, tmp_path: Path
) -> None:
    StyleTold((), (), style_files(haussmann, "photo.jpg")).write(tmp_path)
    grammar, best = haussmann.chosen.posterior.grammar, haussmann.chosen.best
    rules = parse(tmp_path / "style/rules.cga")
    width = grammar.width_m * best.state.scale
    lot = [[(0.0, 0.0), (width, 0.0), (width, 10.0), (0.0, 10.0)]]
    (edits,) = read_edits(tmp_path / "style/edits.txt").values()
    made = derive(rules, lot, edits=edits, attributes={"style.LOD": LOD})
    assert made.edit_faults == []
    columns = made.columns()
    front = front_of(elevation(columns, rules.library.assets_of(columns)), width, best.state.scale)
    for kind, boxes in best.front.boxes.items():
        np.testing.assert_allclose(front.boxes[kind], boxes, atol=0.03)


def test_no_style_is_looked_for_where_none_is_asked_for() -> None:
    document = sample_document()
    pixels = np.zeros((4, 4, 3), np.uint8)
    assert find_style(document, pixels, None, StyleOptions(), [], no_progress) == (document, None)


@pytest.mark.parametrize("name", ["baroque", "suburban-house", "styles/haussmann.cga", ""])
def test_an_unknown_style_is_refused(name: str) -> None:
    with pytest.raises(InputError, match=r"is no style of fronts.*Name auto or one of .*haussmann"):
        require_style(name)


def test_none_of_the_styles_is_likely_where_all_fit_badly() -> None:
    assert log_odds_of_none(60.0, 100.0, 500.0) > log_odds_of_none(100.0, 100.0, 500.0)
    assert log_odds_of_none(100.0, 100.0, 500.0) > log_odds_of_none(300.0, 300.0, 500.0)
    own = InferParameters(none_offset=1.0, none_worse=2.0, none_apart=4.0)
    assert log_odds_of_none(50.0, 30.0, 100.0, own) == pytest.approx(1.0 - 0.4 - 2.0)


def test_chances_are_those_of_the_odds(haussmann: StyleFound) -> None:
    """None of the styles against all, by its own odds; the styles by their evidences."""
    found = ranked(haussmann.candidates, haussmann.chosen)
    by_name = dict(zip([one.name for one in found.candidates], found.chances, strict=True))
    styles = [one for one in found.candidates if one.name != ANY_FRONT]
    none = next(one for one in found.candidates if one.name == ANY_FRONT)
    best = max(styles, key=lambda one: one.log_evidence)
    most = float(best.posterior.observed.ratios.max(axis=0).sum())
    odds = log_odds_of_none(best.log_seen, none.log_seen, most)
    told = by_name[ANY_FRONT] / (1.0 - by_name[ANY_FRONT])
    assert np.log(told) == pytest.approx(odds - np.log(len(styles)), abs=1e-6)
    one, other = styles[:2]
    apart = (one.log_evidence - other.log_evidence) / one.parameters.temperature
    assert np.log(by_name[one.name] / by_name[other.name]) == pytest.approx(apart, abs=1e-6)


def test_a_house_that_is_a_little_off_is_found_again() -> None:
    """Storeys and bays that are not quite those of the rules: deformed, it is as likely again."""
    front, observed = seen_as("haussmann")
    boxes = {
        kind: np.column_stack([b[:, 0], b[:, 1] ** 1.03, b[:, 2], b[:, 3] ** 1.03])
        for kind, b in front.boxes.items()
    }
    off = replace(front, boxes=boxes, eaves_m=front.eaves_m**1.03)
    drawn = log_likelihood(off, observed)
    found = deformed(off, observed)
    assert found.log_cost <= 0.0
    assert found.log_total > drawn
    assert found.log_likelihood > drawn + 0.3 * (log_likelihood(front, observed) - drawn)
    assert deformed(front, observed).log_total >= log_likelihood(front, observed)
