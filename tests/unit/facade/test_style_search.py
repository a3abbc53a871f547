"""The posterior of structures, and the search over them, against enumeration of small spaces."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from veduta.facade.style.deformed import Borders
from veduta.facade.style.grammar import StyleGrammar, style_grammar
from veduta.facade.style.infer import Candidate
from veduta.facade.style.labels import Front, painted
from veduta.facade.style.likelihood import LikelihoodParameters, evidence_score, log_likelihood
from veduta.facade.style.observed import KINDS, LABELS, Observed, ObservedParameters, observed_of
from veduta.facade.style.other_searches import anneal, greedy
from veduta.facade.style.posterior import Posterior, Scored
from veduta.facade.style.prior import Choice, Real, distributions
from veduta.facade.style.search import SearchParameters, search
from veduta.facade.style.starts import climbed
from veduta.facade.style.state import SCALE
from veduta.grammar.derivation import parse

WIDTH_M = 11.0
CELLS = ObservedParameters()


def seen_of(front: Front, sure: float = 0.7, rows: int = 150) -> Observed:
    """What eyes see of a front that give each cell's own label this chance."""
    shape = rows, round(front.width_m / CELLS.cell_m)
    labels = painted(front, shape, CELLS.cell_m)
    chances = np.full((len(LABELS), *shape), (1.0 - sure) / (len(LABELS) - 1))
    np.put_along_axis(chances, labels[None], sure, axis=0)
    return observed_of(chances, (front.width_m, front.eaves_m), dict(front.boxes), CELLS)


@pytest.fixture(scope="module")
def haussmann() -> StyleGrammar:
    return style_grammar("haussmann", WIDTH_M, Real(0.97, 1.03, 0.9, 1.1))


def posterior_at(grammar: StyleGrammar, sure: float = 0.7) -> tuple[Posterior, Scored]:
    """The posterior for a front of the style, and that front."""
    rng = np.random.default_rng(5)
    state = grammar.start().with_attributes(storeys=4.0, storeyHeight=3.3)
    truth = grammar.complete(state, rng)
    assert truth is not None
    posterior = Posterior(grammar, seen_of(truth.front, sure))
    return posterior, posterior.of(truth)


def test_the_prior_of_choices_is_that_of_the_engine(haussmann: StyleGrammar) -> None:
    """With what one does not see left out, which the engine counts too."""
    rng = np.random.default_rng(3)
    derived = haussmann.complete(haussmann.start(), rng)
    assert derived is not None
    tree = haussmann._tree(derived.state)
    assert tree is not None
    paths = set(derived.state.choices)
    unseen = sum(
        math.log(chance)
        for shape in range(len(tree))
        for slot, (_, _, chance) in enumerate(tree.choices(shape))
        if tuple(tree.path(shape)) not in paths or haussmann.chances[tree.name(shape), slot] is None
    )
    constants = (
        tree.log_prior - unseen - sum(taken.log_chance for taken in derived.state.choices.values())
    )
    # What is left are the attributes and constants that the file draws by chance (colours).
    again = haussmann.complete(haussmann.start(), np.random.default_rng(4))
    assert again is not None
    other = haussmann._tree(again.state)
    assert other is not None
    rest = sum(
        math.log(chance)
        for shape in range(len(other))
        for slot, (_, _, chance) in enumerate(other.choices(shape))
        if tuple(other.path(shape)) not in set(again.state.choices)
        or haussmann.chances[other.name(shape), slot] is None
    )
    seen = sum(taken.log_chance for taken in again.state.choices.values())
    assert other.log_prior - rest - seen == pytest.approx(constants)


def test_every_choice_is_found_once_and_the_prior_sums_to_one(haussmann: StyleGrammar) -> None:
    posterior, truth = posterior_at(haussmann)
    rng = np.random.default_rng(0)
    every = list(posterior.every_choice(truth, rng))
    assert len({one.state.key for one in every}) == len(every)
    chances = [
        math.exp(math.fsum(t.log_chance for t in one.state.choices.values())) for one in every
    ]
    assert sum(chances) == pytest.approx(1.0)


SMALL = """
attr LOD = 2
Lot --> [ Body ] t(0, 6, 0) NIL
Body --> set(material.name, "wall") extrude(world.up, 6) comp(f) { front : Front | all : NIL }
Front -->
    30% : Plain
    else : split(y) { ~1 : Floor | ~1 : Floor | ~1 : Floor }
Plain --> Wall.
Floor -->
    50% : Wall.
    30% : split(x) { ~1 : Wall. | 1 : Window | ~1 : Wall. }
    else : split(x) { ~1 : Wall. | 1 : Window | ~1 : Half }
Half -->
    50% : Wall.
    else : Window
Window --> set(material.name, "window") Window.
"""


def test_chains_visit_structures_as_often_as_the_posterior_says(tmp_path: Path) -> None:
    """A space whose trees have one to seven random choices, each of them with another number."""
    path = tmp_path / "small.cga"
    path.write_text(SMALL)
    scale = {SCALE: Choice((1.0,), (1.0,))}
    grammar = StyleGrammar("small", parse(path), {**scale}, 6.0)
    rng = np.random.default_rng(1)
    derived = grammar.complete(grammar.start(), rng)
    assert derived is not None
    faint = LikelihoodParameters(pixels=0.06, elements=0.0)
    posterior = Posterior(grammar, seen_of(derived.front, rows=40), faint)
    start = posterior.of(derived)
    every = list(posterior.every_choice(start, rng))
    logs = np.array([one.log_posterior for one in every])
    expected = np.exp(logs - np.logaddexp.reduce(logs))
    assert len(every) == 1 + 4**3
    assert expected.max() < 0.6
    found = search(
        posterior,
        [start],
        rng,
        SearchParameters(betas=(1.0, 0.3), seconds=60.0, steps=12000, burn=0.05),
    )
    counts = Counter(one.state.key for one in found.samples)
    assert set(counts) <= {one.state.key for one in every}
    shares = np.array([counts[one.state.key] / len(found.samples) for one in every])
    by_size: dict[int, list[float]] = {}
    for one, share, due in zip(every, shares, expected, strict=True):
        own = by_size.setdefault(len(one.state.choices), [0.0, 0.0])
        own[0], own[1] = own[0] + share, own[1] + due
    assert all(share == pytest.approx(due, abs=0.05) for share, due in by_size.values())
    assert 0.5 * np.abs(shares - expected).sum() < 0.15


def test_the_search_finds_the_truth_from_another_start(haussmann: StyleGrammar) -> None:
    posterior, truth = posterior_at(haussmann)
    rng = np.random.default_rng(2)
    start = climbed(posterior, haussmann.start(), rng)
    assert start is not None
    found = search(posterior, [start], rng, SearchParameters(seconds=60.0, steps=450))
    assert found.best.log_posterior > truth.log_posterior - 1.0
    assert found.best.state.attributes["storeys"] == 4.0
    # Rows and pairs of consoles look alike from the street: there the likelier one is found.
    looks = [painted(one.front, (250, 200), 0.1) for one in (found.best, truth)]
    assert set(found.best.state.choices) == set(truth.state.choices)
    assert np.mean(looks[0] == looks[1]) > 0.995
    assert all(0 < chain.accepted < chain.proposed for chain in found.chains)
    assert found.best.log_posterior == max(chain.best.log_posterior for chain in found.chains)


def test_other_searches_never_end_below_their_start(haussmann: StyleGrammar) -> None:
    posterior, _ = posterior_at(haussmann)
    rng = np.random.default_rng(2)
    start = posterior.score(haussmann.start(), rng)
    assert start is not None
    for other in (greedy, anneal):
        assert other(posterior, start, rng, 0.2).log_posterior >= start.log_posterior


def test_a_cut_tree_has_the_choices_outside_of_the_cut(haussmann: StyleGrammar) -> None:
    posterior, truth = posterior_at(haussmann)
    rng = np.random.default_rng(7)
    for cut in truth.state.cuts():
        found = posterior.score(truth.state.without(cut), rng)
        assert found is not None
        outside = {p: t for p, t in truth.state.choices.items() if p[: len(cut)] != cut}
        assert {p: found.state.choices[p] for p in outside} == outside


def test_pixels_and_elements_speak_for_the_front_that_is_there() -> None:
    boxes = {kind: np.zeros((0, 4)) for kind in KINDS}
    windows = np.array([[1.0, 4.0, 2.2, 6.0], [4.0, 4.0, 5.2, 6.0]])
    front = Front(6.0, 7.0, (), {**boxes, "window": windows})
    observed = seen_of(front, rows=60)
    right = log_likelihood(front, observed)
    for moved in (windows + 0.7, windows[:1], np.vstack([windows, [[2.4, 4.0, 3.4, 6.0]]])):
        other = replace(front, boxes={**boxes, "window": moved})
        assert log_likelihood(other, observed) < right
    assert evidence_score(front, observed) == pytest.approx(2.0)
    # The thesis's sum does not mind an element too many.
    third = replace(front, boxes={**boxes, "window": np.vstack([windows, windows[:1] + 9.0])})
    assert evidence_score(third, observed) == pytest.approx(2.0)


def test_what_is_hidden_says_nothing() -> None:
    chances = np.zeros((len(LABELS), 4, 4))
    observed = observed_of(chances, (0.6, 0.6), {kind: np.zeros((0, 4)) for kind in KINDS})
    assert np.abs(observed.ratios).max() < 1e-9


def test_distributions_are_read_from_a_rule_file() -> None:
    text = (
        '@Description("floors") @Range(min=2, max=4)\nattr storeys = 50% : 2 else : 3\n'
        "@Range(min=2, max=4)\nattr storeyHeight = 3 + rand(0.5)\n"
        "@Range(min=3, max=5)\nattr ground = 4\n"
        'attr shops = true\n@Color\nattr paint = 50% : "#ffffff" else : "#000000"\n'
        "attr other = ground * 2\n"
    )
    found = distributions(text)
    assert sorted(found) == ["ground", "shops", "storeyHeight", "storeys"]
    storeys, height = found["storeys"], found["storeyHeight"]
    assert isinstance(storeys, Choice)
    assert storeys.values == (2.0, 3.0, 4.0)
    assert sum(storeys.chances) == pytest.approx(1.0)
    assert storeys.log_density(5.0) == -math.inf
    for one in (height, found["ground"]):
        assert isinstance(one, Real)
        at = np.linspace(one.least, one.most, 20001)
        density = np.exp([one.log_density(value) for value in at.tolist()])
        assert np.trapezoid(density, at) == pytest.approx(1.0, abs=0.02)
        assert one.log_density(one.most + 0.1) == -math.inf
        drawn = [one.draw(np.random.default_rng(k)) for k in range(50)]
        assert one.least <= min(drawn) <= max(drawn) <= one.most


def test_the_scale_is_an_attribute_of_each_grammar(haussmann: StyleGrammar) -> None:
    assert SCALE in haussmann.distributions
    assert haussmann.start().scale == pytest.approx(1.0)


def test_a_tree_that_is_cut_is_the_one_that_is_derived_as_a_whole(haussmann: StyleGrammar) -> None:
    rng = np.random.default_rng(11)
    derived = haussmann.complete(haussmann.start(), rng)
    assert derived is not None
    for path, taken in derived.state.choices.items():
        for other in haussmann.alternatives(path, taken):
            before = haussmann.cut, haussmann.derived
            cut = haussmann.complete(
                derived.state.with_choice(path, other), rng, (derived.state, path)
            )
            assert cut is not None
            assert (haussmann.cut > before[0], haussmann.derived) == (True, before[1])
            haussmann._trees.clear()
            whole = haussmann.complete(cut.state, rng)
            assert whole is not None
            assert whole.state == cut.state
            for kind, boxes in whole.front.boxes.items():
                np.testing.assert_array_equal(boxes, cut.front.boxes[kind])
            haussmann.complete(derived.state, rng)


def test_a_settled_candidate_has_the_railings_that_were_seen(haussmann: StyleGrammar) -> None:
    """Of a house whose floors are up to a quarter higher or lower than a row of equal ones."""
    _, truth = posterior_at(haussmann)
    drawn = np.linspace(0.0, truth.front.eaves_m, 6)
    moved = drawn + np.array([0.0, 0.6, -0.5, 0.5, -0.4, 0.0])
    borders = Borders((np.array([0.0, WIDTH_M]), np.array([0.0, WIDTH_M])), (drawn, moved))
    seen = Posterior(haussmann, seen_of(borders.carry(truth.front)))
    rng = np.random.default_rng(4)
    look = painted(borders.carry(truth.front), (250, 200), 0.1)
    wrong = [
        one
        for path, taken in sorted(truth.state.choices.items())
        for other in haussmann.alternatives(path, taken)
        if (one := seen.score(truth.state.with_choice(path, other), rng)) is not None
    ]
    assert len(wrong) > 5
    for start in wrong:
        begun, kept = Candidate(seen, start).deformed(), Candidate(seen, start).settled(rng)
        assert kept.log_evidence >= begun.log_evidence
        assert kept.real is not None
        assert np.mean(painted(kept.real.front, (250, 200), 0.1) == look) > 0.965
