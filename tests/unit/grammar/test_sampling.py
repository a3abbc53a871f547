"""Samples of a rule file as a picture: what is drawn, and that one scale holds for all."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from veduta import grammar
from veduta.grammar.building import build_part
from veduta.grammar.one_lot import derive_lot, plain_lot
from veduta.grammar.options import GrammarOptions, SampleOptions
from veduta.grammar.portrait import CLASS_COLOURS, PAPER, in_class_colours, portrait
from veduta.grammar.sampling import (
    draw_samples,
    key_attributes,
    picture_cells,
    prior_text,
    sheet_of,
)
from veduta.grammar.sheet import shown
from veduta.place.semantics import SemanticClass
from veduta.run.errors import InputError
from veduta.run.progress import Progress

RULES = """
attr tall = 50% : 4 else : 8
attr wide = rand(1, 2)
attr same = 3
Lot --> extrude(tall) comp(f) { front : Front | all : Wall }
Front --> split(x) { ~1 : Wall | ~1 : Window | ~1 : Wall }
Wall --> set(material.name, "wall")
Window --> set(material.name, "window") color("#ff0000")
"""


@pytest.fixture(scope="module")
def rules(tmp_path_factory: pytest.TempPathFactory) -> grammar.Rules:
    path = tmp_path_factory.mktemp("rules") / "house.cga"
    path.write_text(RULES)
    return grammar.parse(path)


def seen(picture: np.ndarray) -> np.ndarray:
    """(h, w) where something else than paper is."""
    return np.abs(picture.astype(float) - PAPER).max(axis=2) > 60


def test_a_portrait_shows_the_building_and_nothing_else(rules: grammar.Rules) -> None:
    made = derive_lot(rules, plain_lot(), GrammarOptions(), 1)
    part = build_part(made.columns(), "house")
    box = (np.array(part.bounds_m[0]), np.array(part.bounds_m[1]))
    picture = portrait(in_class_colours(part), box, (160, 120), 1)
    assert picture.shape == (120, 160, 3)
    rows, columns = np.nonzero(seen(picture))
    # It fills the picture to its margin in one direction, and lies in its middle.
    filled = max(np.ptp(columns) / 160, np.ptp(rows) / 120)
    assert filled == pytest.approx(0.94, abs=0.05)
    assert (columns.min() + columns.max()) / 2 == pytest.approx(80, abs=6)
    corners = picture[[0, 0, -1, -1], [0, -1, 0, -1]].astype(float)
    assert np.abs(corners - PAPER).max() < 3
    # Windows are blue in the colours of classes, and red in those of the rules.
    blue = picture[..., 2].astype(int) - picture[..., 0]
    assert (blue > 60).sum() > 50
    own = portrait(part, box, (160, 120), 1)
    assert ((own[..., 0].astype(int) - own[..., 2]) > 60).sum() > 50
    again = portrait(in_class_colours(part), box, (160, 120), 1)
    assert (again == picture).all()


def test_one_scale_holds_for_all(rules: grammar.Rules) -> None:
    samples = draw_samples(rules, plain_lot(), GrammarOptions(), 6)
    by_height = {sample.derivation.attributes["tall"]: sample for sample in samples}
    assert set(by_height) == {4.0, 8.0}
    options = SampleOptions(width=120, rays=1)
    cells = picture_cells(samples, options, Progress(quiet=True))
    extents = {}
    for sample, cell in zip(samples, cells, strict=True):
        rows = np.nonzero(seen(cell.pictures[0]).any(axis=1))[0]
        extents[sample.derivation.attributes["tall"]] = (rows.max(), np.ptp(rows))
    (low_foot, low), (high_foot, high) = extents[4.0], extents[8.0]
    assert abs(low_foot - high_foot) <= 2
    assert high > 1.5 * low
    assert [cell.title for cell in cells] == [f"seed {k}" for k in range(6)]
    assert [name for name, _ in cells[0].facts] == ["tall", "wide"]
    both = SampleOptions(width=120, rays=1, colours="both", columns=2)
    pairs = picture_cells(samples[:2], both, Progress(quiet=True))
    sheet = sheet_of("house", plain_lot(), samples[:2], pairs, both)
    assert len(pairs[0].pictures) == 2
    assert sheet.width > 4 * 120
    assert sheet.size == sheet_of("house", plain_lot(), samples[:2], pairs, both).size


def test_the_front_of_any_lot_is_seen(rules: grammar.Rules) -> None:
    plain = plain_lot()
    turn = np.array([[0.6, -0.8], [0.8, 0.6]])
    lots = [plain, replace(plain, rings_m=(plain.rings_m[0] @ turn.T,))]
    options = SampleOptions(width=120, rays=1)
    pictures = []
    for lot in lots:
        samples = draw_samples(rules, lot, GrammarOptions(), 1)
        (cell,) = picture_cells(samples, options, Progress(quiet=True))
        pictures.append(cell.pictures[0].astype(float))
    assert pictures[0].shape == pictures[1].shape
    assert np.abs(pictures[0] - pictures[1]).mean() < 1.0


def test_samples_are_what_derive_makes(rules: grammar.Rules) -> None:
    samples = draw_samples(rules, plain_lot(), GrammarOptions(), 3)
    for sample in samples:
        made = derive_lot(rules, plain_lot(), GrammarOptions(), sample.seed)
        assert made.log_prior == sample.derivation.log_prior
        assert prior_text(made.log_prior) == "ln p = -0.7"


def test_attributes_with_few_values_come_first() -> None:
    values = [{"a": 1.0, "b": k * 1.0, "c": float(k % 2)} for k in range(4)]
    assert key_attributes(values) == ["c", "b"]
    assert (shown(True), shown(3.14159), shown("x" * 40)) == ("yes", "3.14", "x" * 15 + "…")
    assert prior_text(float("-inf")) == "p = 0"


def test_each_class_has_a_colour_of_its_own() -> None:
    assert set(CLASS_COLOURS) == set(SemanticClass)
    assert len(set(CLASS_COLOURS.values())) == len(SemanticClass)


def test_rules_that_make_nothing_are_told(tmp_path: Path) -> None:
    path = tmp_path / "nothing.cga"
    path.write_text("Lot --> NIL")
    with pytest.raises(InputError, match="makes no building"):
        draw_samples(grammar.parse(path), plain_lot(), GrammarOptions(), 1)
