"""Words for rooms in five languages, with slips of reading, and words that are none."""

from __future__ import annotations

import csv
from importlib.resources import files

import pytest
from hypothesis import given
from hypothesis import strategies as st

from veduta.plan.names.vocabulary import folded, language_of, meanings
from veduta.plan.names.voids import names_void

ROWS = list(
    csv.DictReader(files("veduta.plan.names").joinpath("words.csv").read_text("utf-8").splitlines())
)


def test_each_word_of_the_table_means_what_it_says() -> None:
    assert len(ROWS) > 800
    for row in ROWS:
        found = {(one.use, one.language) for one in meanings(row["word"])}
        assert (row["use"], row["language"]) in found, row


def test_a_word_has_one_use_in_a_language() -> None:
    uses: dict[tuple[str, str], set[str]] = {}
    for row in ROWS:
        uses.setdefault((folded(row["word"]), row["language"]), set()).add(row["use"])
    assert {word: use for word, use in uses.items() if len(use) > 1} == {}


@pytest.mark.parametrize(
    ("label", "use"),
    [
        ("MH", "bedroom"), ("MH 3", "bedroom"), ("mh2", "bedroom"), ("OH", "living"),
        ("K", "kitchen"), ("KH", "bathroom"), ("KPH", "bathroom"), ("PSH", "bathroom"),
        ("WC", "toilet"), ("ET", "hall"), ("TK", "hall"), ("VH", "wardrobe"), ("S", "sauna"),
        ("AT", "garage"), ("KHH", "utility"), ("VAR.", "storage"), ("PARVEKE", "balcony"),
        ("k/ru", "kitchen"), ("kh/wc", "bathroom"), ("lasitettu parveke", "balcony"),
        ("Bedroom 2", "bedroom"), ("MASTER BEDROOM", "bedroom"), ("Living Room", "living"),
        ("Casa de Banho", "bathroom"), ("Cozinha", "kitchen"), ("Quarto 1", "bedroom"),
        ("Salle à manger", "dining"), ("Chambre 3", "bedroom"), ("Dgt", "corridor"),
        ("Küche", "kitchen"), ("Gäste-WC", "toilet"), ("Abstellraum 4,2 m²", "storage"),
    ],
)  # fmt: skip
def test_labels_of_plans(label: str, use: str) -> None:
    assert meanings(label)[0].use == use


@pytest.mark.parametrize(
    ("slip", "use"),
    [
        ("Keittio", "kitchen"), ("Olohuohe", "living"), ("Schlafzirnmer", "bedroom"),
        ("lasitetlu parveke", "balcony"), ("Bathroon", "bathroom"), ("LIV1NG ROOM", "living"),
        ("Kuche", "kitchen"), ("Cuislne", "kitchen"),
    ],
)  # fmt: skip
def test_slips_of_reading(slip: str, use: str) -> None:
    best = meanings(slip)[0]
    assert best.use == use
    assert best.score <= 1.0


@pytest.mark.parametrize(
    "label",
    ["3H+K+S", "4,5-Zimmer-Wohnung", "Fourth Floor", "hk", "va", "dB 30", "EI 60", "N", "",
     "Approximate Gross Internal Area", "Piirros ohjeellinen, ei mittakaavassa"],
)  # fmt: skip
def test_what_is_no_room(label: str) -> None:
    assert meanings(label) == []


@pytest.mark.parametrize("language", ["en", "fi", "fr", "de", "pt"])
def test_the_language_is_that_of_most_words(language: str) -> None:
    """Of words that only one language has, any three give that language."""
    owners: dict[str, set[str]] = {}
    for row in ROWS:
        owners.setdefault(folded(row["word"]), set()).add(row["language"])
    own = [word for word, languages in owners.items() if languages == {language}]
    words = [word for word in own if len(word) > 5][:30]
    assert all(language_of(words[i : i + 3]) == language for i in range(0, 27, 3))


def test_without_words_there_is_no_language() -> None:
    assert language_of(["3450", "xyzzy", ""]) is None


@given(st.text("abcdefghäöüé /+-.0123456789²m", max_size=30))
def test_any_label_is_survived(label: str) -> None:
    assert all(0 < one.score <= 1 for one in meanings(label))


@pytest.mark.parametrize(
    ("label", "void"),
    [
        ("VOID", True),
        ("Open to below", True),
        ("OPEN TO GREAT ROOM", True),
        ("Luftraum", True),
        ("Vide sur séjour", True),
        ("吹抜", True),
        ("Pool", False),
        ("Open kitchen", False),
        ("Great room", False),
    ],
)
def test_words_for_what_has_no_floor(label: str, void: bool) -> None:
    assert names_void(label) is void
