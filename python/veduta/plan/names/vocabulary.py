"""Words for rooms in eleven languages, and what they mean.

English, Finnish, French, German, Portuguese, Swedish, Spanish, Italian, Dutch, Hebrew, Japanese.
The table `words.csv` was made for this project. Words are compared without case, accents and
punctuation, since all three are lost in small print; long ones may also differ by slips of reading.
"""

from __future__ import annotations

import csv
import re
import unicodedata
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from importlib.resources import files
from typing import Literal, get_args

from rapidfuzz import fuzz, process

from veduta.plan.document import RoomUse

Language = Literal["en", "fi", "fr", "de", "pt", "sv", "es", "it", "nl", "he", "ja"]
LANGUAGES: tuple[Language, ...] = get_args(Language)
_FLAT = re.compile(r"\W*\d+(?:[,.]5)?\s?-?(?:[hHkKrR]\+|[Zz]i|[Rr]oom|[Bb]ed)")  # 3H+K+S, 2-Zimmer
_FUZZY = 5  # letters that a word needs to be known in spite of slips
_ALIKE = 80.0  # of 100: one slip in five letters
_SHORT = 0.9  # score of abbreviations: they also stand for other things
_CJK = 0x3000  # from here on, scripts are written without blanks between words
_PART = 0.85  # score of a word in a longer label


@dataclass(frozen=True)
class Meaning:
    """What a word can mean. `score` 0 to 1 says how well the text matches `word`."""

    use: RoomUse
    language: Language
    word: str
    score: float


def meanings(label: str) -> list[Meaning]:
    """All that a label can mean, the best first; empty where it names no room.

    A whole label goes before its parts: `salle de bain` before `salle`, `k/ru` before `k`.
    """
    if _FLAT.match(label):
        return []
    plain = folded(label)
    found = list(_of_phrase(plain))
    if not found:
        found = [
            Meaning(one.use, one.language, one.word, one.score * _PART)
            for part in (*_parts(plain), *_unspaced(plain))
            for one in _of_phrase(part)
        ]
    return sorted(found, key=lambda one: (-one.score, -len(one.word)))


def names_open_air(label: str) -> bool:
    """Whether a label most likely names a balcony or a terrace."""
    return any(one.use in ("balcony", "terrace") for one in meanings(label)[:1])


def folded(label: str) -> str:
    """A label in lower case without accents, numbers, sizes and outer punctuation."""
    plain = unicodedata.normalize("NFKD", label.replace("ß", "ss").casefold())
    plain = "".join(letter for letter in plain if not unicodedata.combining(letter))
    plain = re.sub(r"[’`´]", "'", plain)
    plain = re.sub(r"\d+[.,\d]*\s*(m2|m²|sqm|sq\.?\s?\w+|m|帖|畳|坪)?(?=\W|$)", " ", plain)
    plain = re.sub(r"(?<=[a-z])\d+$", "", plain.strip())  # mh1
    plain = re.sub(r"\s*([/+&-])\s*", r"\1", plain)
    return re.sub(r"\s+", " ", plain).strip(" .,:;_-()[]*'\"/+&")


def language_of(labels: Iterable[str]) -> Language | None:
    """The language in which most labels make sense; None where no label does.

    A word that is the same in several languages votes for each of them in part.
    """
    votes = dict.fromkeys(LANGUAGES, 0.0)
    for label in labels:
        found = meanings(label)
        best = max((one.score for one in found), default=0.0)
        languages = {one.language for one in found if one.score >= best - 0.01}
        for language in languages:
            votes[language] += best * min(len(folded(label)), 8) / len(languages) ** 2
    leader = max(LANGUAGES, key=lambda language: votes[language])
    return leader if votes[leader] > 0 else None


def _parts(plain: str) -> Iterator[str]:
    """Parts of a label that may be a word: between strokes, then runs of words, long ones first."""
    pieces = [piece.strip(" .'") for piece in re.split(r"[/+&,()]", plain)]
    for piece in pieces:
        if piece != plain and piece:
            yield piece
        words = piece.split(" ")
        for length in range(min(3, len(words) - 1), 0, -1):
            for start in range(len(words) - length + 1):
                part = " ".join(words[start : start + length]).strip(" .-'")
                if len(part) >= 3:
                    yield part


def _unspaced(plain: str) -> Iterator[str]:
    """The longest words that a label of a script without blanks holds, as `洋室6帖` does."""
    if not any(ord(letter) >= _CJK for letter in plain):
        return
    held = [word for word in _table() if len(word) > 1 and word in plain]
    yield from sorted(held, key=len, reverse=True)[:1]


def _of_phrase(plain: str) -> Iterator[Meaning]:
    table = _table()
    if not plain:
        return
    for use, language in table.get(plain, ()):
        yield Meaning(use, language, plain, 1.0 if len(plain) > 3 else _SHORT)
    if plain in table or len(plain) < _FUZZY:
        return
    near = process.extract(plain, _long_words(), scorer=fuzz.ratio, score_cutoff=_ALIKE, limit=3)
    for word, alike, _ in near:
        for use, language in table[word]:
            yield Meaning(use, language, word, alike / 100.0 * _SHORT)


@lru_cache(maxsize=1)
def _table() -> dict[str, tuple[tuple[RoomUse, Language], ...]]:
    """What each folded word means, in each language that has it."""
    table: dict[str, list[tuple[RoomUse, Language]]] = {}
    text = files("veduta.plan.names").joinpath("words.csv").read_text(encoding="utf-8")
    for row in csv.DictReader(text.splitlines()):
        entry = table.setdefault(folded(row["word"]), [])
        entry.append((_use(row["use"]), _language(row["language"])))
    return {word: tuple(dict.fromkeys(entry)) for word, entry in table.items() if word}


@lru_cache(maxsize=1)
def _long_words() -> tuple[str, ...]:
    return tuple(word for word in _table() if len(word) >= _FUZZY)


def _use(text: str) -> RoomUse:
    return next(use for use in get_args(RoomUse) if use == text)


def _language(text: str) -> Language:
    return next(language for language in LANGUAGES if language == text)
