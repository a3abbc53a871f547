"""Uses and names of rooms: by the words in them, else guessed."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from shapely.geometry import Point, Polygon, box

from veduta.plan.document import Origin, RoomUse, Text
from veduta.plan.names.guess import RoomFacts, guess_uses
from veduta.plan.names.vocabulary import Language, Meaning, language_of, meanings
from veduta.plan.names.voids import says_over

_LINE_GAP = 0.9  # heights of text between two lines of one label
_REMARK = re.compile(r"\b(?:access|above|below|(?:in|to) (?:the )?attic)\b", re.IGNORECASE)
"""What is written for builders, "attic access" or "furnace in attic", names no room."""
_LENGTH = r"\d+(?:[.,]\d+)?(?:\s?(?:['’′]|ft)\s?-?(?:\d{1,2})?)?\s?(?:[\"”″]|''|[mc]?m\b)?"
_SIZE = re.compile(
    rf"(?:^|(?<=[\s(,:-])){_LENGTH}\s?[x×]\s?{_LENGTH}(?=[\s),]|$)"
    r"|(?:^|(?<=[\s(,:-]))\d+(?:[.,]\d+)?\s?(?:m2|m²|㎡|sq\.?\s?(?:m|ft)\b\.?)"
    r"|(?:^|(?<=\s))\d+(?:['’′]|[.,]\d+\s?m\b)(?:\d{1,2})?[\"”″]?(?=\s|$)"
    r"|^[1-9](?:\d|1[01])[1-9](?:\d|1[01])(?=\s)",
    re.IGNORECASE,
)
"""Sizes, areas and marks of doors (2668) beside a name."""
_OTHER_LANGUAGE = 0.8  # score of a word of a language that the sheet is not in
_LETTER = 0.5  # score of a single letter on a sheet that is not in its language
_SIZES = (0.6, 1.7)  # heights of two lines of one label, one over the other
# Where a space has several labels, as an open kitchen in a living room, the first gives its use.
_RANK: tuple[RoomUse, ...] = (
    "living", "garage", "bedroom", "kitchen", "dining", "study", "bathroom", "sauna", "toilet",
    "utility", "hall", "corridor", "stairs", "terrace", "balcony", "technical", "storage",
    "wardrobe", "other", "unknown",
)  # fmt: skip


@dataclass(frozen=True)
class NamedRoom:
    """What a room is for. `name` is as it is written on the plan, empty where nothing is."""

    use: RoomUse
    score: float
    origin: Origin
    name: str


@dataclass(frozen=True)
class _Label:
    text: str
    box: NDArray[np.float64]
    score: float


def name_rooms(
    rooms_px: Sequence[NDArray[np.float64]],
    texts: Sequence[Text],
    facts: Sequence[RoomFacts],
    doors: Sequence[tuple[int, int]],
) -> list[NamedRoom]:
    """The use and the name of each room, in the order of `rooms_px`.

    `rooms_px` are outlines (n, 2) in the pixels of `texts`; `facts` say what is known of each;
    `doors` are pairs of rooms between which one can walk. A room without a label gets the likeliest
    use by its size, shape and neighbours, with origin `inferred` and the probability as its score.
    """
    polygons = [Polygon(outline).buffer(0) for outline in rooms_px]
    inside = _texts_by_room(polygons, texts)
    labels = [_labels(found) for found in inside]
    language = language_of(label.text for found in labels for label in found)
    named = [_named(found, language) for found in labels]
    guesses = guess_uses(list(facts), doors, [room.use if room else None for room in named])
    return [
        room or NamedRoom(use, score, "inferred", "")
        for room, (use, score) in zip(named, guesses, strict=True)
    ]


def _texts_by_room(polygons: list[Polygon], texts: Sequence[Text]) -> list[list[Text]]:
    """The texts of each room: by their centres, else by where most of them lies.

    A label that does not fit into a small room reaches over its walls.
    """
    inside: list[list[Text]] = [[] for _ in polygons]
    for text in texts:
        corners = np.asarray(text.box_px)
        centre = Point(corners.mean(axis=0))
        shares = [
            polygon.area and polygon.intersection(box(*corners.min(0), *corners.max(0))).area
            for polygon in polygons
        ]
        holds = [index for index, polygon in enumerate(polygons) if polygon.contains(centre)]
        if holds:
            inside[min(holds, key=lambda index: polygons[index].area)].append(text)
        elif shares and max(shares) > 0:
            inside[int(np.argmax(shares))].append(text)
    return inside


def _labels(texts: list[Text]) -> list[_Label]:
    """The texts of a room with those that stand under each other as one label, and each alone."""
    single = [_Label(one.text, np.asarray(one.box_px), one.score) for one in texts]
    single.sort(key=lambda label: float(label.box[:, 1].min()))
    stacked = []
    for first in single:
        for second in single:
            if _goes_on(first, second):
                text = f"{first.text} {second.text}"
                corners = np.concatenate([first.box, second.box])
                stacked.append(_Label(text, corners, min(first.score, second.score)))
    return [*stacked, *single]


def _goes_on(first: _Label, second: _Label) -> bool:
    """Whether a label goes on in the line below it."""
    tall, other = (float(np.linalg.norm(one.box[3] - one.box[0])) for one in (first, second))
    if first is second or not _SIZES[0] < other / tall < _SIZES[1]:
        return False
    gap = float(second.box[:, 1].min() - first.box[:, 1].max())
    low = max(first.box[:, 0].min(), second.box[:, 0].min())
    high = min(first.box[:, 0].max(), second.box[:, 0].max())
    return -0.5 * tall < gap < _LINE_GAP * tall and high > low


def _named(labels: list[_Label], language: Language | None) -> NamedRoom | None:
    """What the labels of a room say; None where none is a word for a room."""
    void = next((label for label in labels if says_over(label.text)), None)
    if void is not None and not any(_names_another(label, void) for label in labels):
        return NamedRoom("other", float(np.clip(void.score, 0.0, 1.0)), "measured", void.text)
    found = []
    for label in labels:
        if _REMARK.search(label.text):
            continue
        best = _best(meanings(label.text), language)
        if best is not None:
            found.append((best.score * label.score, label, best))
    if not found:
        return None
    # Of one word in two lines both the whole and its halves are found: the surest goes first.
    sure = max(score for score, _, _ in found)
    found = [one for one in found if one[0] >= 0.75 * sure]
    found.sort(key=lambda one: (_RANK.index(one[2].use), -one[0], -len(one[1].text)))
    score, label, meaning = found[0]
    return NamedRoom(meaning.use, float(np.clip(score, 0.0, 1.0)), "measured", shown(label.text))


def _names_another(label: _Label, void: _Label) -> bool:
    """Whether a label that is no part of that of a void names a room: then a railing parts both."""
    low, high = void.box.min(axis=0) - 1.0, void.box.max(axis=0) + 1.0
    middle = label.box.mean(axis=0)
    part = bool((low <= middle).all() and (middle <= high).all()) or says_over(label.text)
    return not part and bool(meanings(label.text))


def shown(label: str) -> str:
    """The name alone, of a label that also says how large the room is; all of one without words."""
    name = re.sub(r"\s+", " ", _SIZE.sub(" ", label)).strip(" ,:;-()")
    return name if any(letter.isalpha() for letter in name) else label


def _best(found: list[Meaning], language: Language | None) -> Meaning | None:
    """The meaning that fits the language of the sheet; words of others count for less."""
    best: Meaning | None = None
    score = 0.0
    for one in found:
        own = one.language == language
        weight = 1.0 if own else (_LETTER if len(one.word) == 1 else _OTHER_LANGUAGE)
        if one.score * weight > score:
            best, score = one, one.score * weight
    if best is None:
        return None
    return Meaning(best.use, best.language, best.word, score)
