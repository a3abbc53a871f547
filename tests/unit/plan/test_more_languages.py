"""Names of rooms in Swedish, Spanish, Italian, Dutch, Hebrew and Japanese; tatami and tsubo."""

from __future__ import annotations

import pytest

from veduta.plan.names.vocabulary import language_of, meanings
from veduta.plan.scale.quantities import read_quantities

WORDS = {
    "sv": {"Vardagsrum": "living", "KÖK": "kitchen", "Sovrum 2": "bedroom", "Klk": "wardrobe"},
    "es": {"Salón comedor": "living", "COCINA": "kitchen", "Baño": "bathroom", "Aseo": "toilet"},
    "it": {"Soggiorno": "living", "cucina": "kitchen", "Camera da letto": "bedroom"},
    "nl": {"Woonkamer": "living", "Slaapkamer 1": "bedroom", "Berging": "storage"},
    "he": {"חדר שינה": "bedroom", "מטבח": "kitchen", "מרפסת": "balcony", "סלון": "living"},
    "ja": {"洋室6帖": "bedroom", "LDK 16.5帖": "living", "バルコニー": "balcony", "玄関": "hall"},
}


@pytest.mark.parametrize("language", WORDS)
def test_words_of_a_language_name_rooms(language: str) -> None:
    for word, use in WORDS[language].items():
        assert meanings(word)[0].use == use, word
    assert language_of(WORDS[language]) == language


@pytest.mark.parametrize(
    ("text", "area_m2"), [("6帖", 9.72), ("(約19帖)", 30.78), ("4.5畳", 7.29), ("21.5坪", 71.07)]
)
def test_areas_in_mats_and_tsubo(text: str, area_m2: float) -> None:
    (found,) = read_quantities(text)
    assert (found.kind, found.values[0]) == ("area", pytest.approx(area_m2, abs=0.01))


@pytest.mark.parametrize("text", ["<1,80m", "ht. 1.35ml", "ligne ht. 1.80ml", "H=2.60"])
def test_heights_are_no_lengths(text: str) -> None:
    assert read_quantities(text) == []
