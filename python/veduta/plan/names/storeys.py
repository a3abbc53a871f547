"""What a storey is called, as its sheet's title has it."""

from __future__ import annotations

import re
import unicodedata
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from veduta.plan.document import Text

USUAL = ("ground floor", "first floor", "second floor", "third floor")
_SURE = 0.8
"""Score of a text from which on it is taken for a title."""

_ORDINALS = ("first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth", "ninth")
_ROMANCE = ("primeiro", "segundo", "terceiro", "quarto", "quinto", "sexto", "setimo", "oitavo")
_LEVEL = r"(floor|level|storey|story)"
_TITLES = {
    "cellar": rf"((lower ground|basement|cellar) {_LEVEL}|lower ground|basement|sous sol|subsolo"
    r"|keller ?geschoss|unter ?geschoss|kellari ?kerros)",
    "ground": rf"((ground|main) {_LEVEL}|rez de (chaussee|jardin)|erd ?geschoss"
    r"|(pavimento |piso )?terreo|res do chao|pohja ?kerros)",
    "number": rf"(({_LEVEL}|piso) (?P<a>\d+)|(?P<b>\d+) ?(st|nd|rd|th) {_LEVEL}"
    r"|(?P<c>\d+) ?(er|ere|e|eme) etage|(?P<d>\d+)\.? ?(og|ober ?geschoss|stock)"
    r"|(?P<e>\d+)\.? ?[oa]? ?(pavimento|andar|piso)|(?P<f>\d+)\.? ?(kerros|krs))",
    "ordinal": rf"((?P<g>{'|'.join(_ORDINALS)}) {_LEVEL}"
    rf"|(?P<h>{'|'.join(_ROMANCE)}) (pavimento|andar|piso))",
    "top": rf"((upper|top|attic|loft) {_LEVEL}|ober ?geschoss|dach ?geschoss"
    r"|pavimento superior|ullakko ?kerros)",
}
_BEFORE = (
    r"(floor ?plan|plan|planta baixa|planta|grundriss|pohjapiirros)( of( the)?| du| de l'| do)?"
)
_AFTER = r"(plan|layout)"
_RANKS = {"cellar": -1, "ground": 0, "top": 99}


@dataclass(frozen=True)
class StoreyName:
    """As it is written; rank: the storeys of a house that say theirs stand in its order."""

    name: str
    rank: int


def storey_name(texts: Sequence[Text]) -> StoreyName | None:
    """The storey that the only title on a sheet names; None without one, or with several."""
    found = {
        one.name.casefold(): one
        for text in texts
        if text.score >= _SURE and (one := title_of(text.text)) is not None
    }
    return next(iter(found.values())) if len(found) == 1 else None


def title_of(line: str) -> StoreyName | None:
    """The storey that a line of text names, and nothing else."""
    name = re.sub(r"\s+", " ", line).strip(" .,:;-_()[]")
    cut = re.fullmatch(rf"({_BEFORE}[ :-]+)?(?P<name>.+?)([ :-]+{_AFTER})?", name, re.I)
    name = cut["name"].strip(" :-") if cut else name
    plain = _folded(name)
    for kind, pattern in _TITLES.items():
        match = re.fullmatch(pattern, plain)
        if match:
            # Not of abbreviations, as OG is one.
            loud = name.isupper() and max(map(len, name.split())) > len("1er")
            shown = name.capitalize() if loud else name
            return StoreyName(shown, _rank(kind, match.groupdict()))
    return None


def named_apart(found: Sequence[StoreyName | None]) -> list[str]:
    """A name for each storey, from the lowest up, no two alike: its own, else the usual one."""
    count = Counter(_folded(one.name) for one in found if one is not None)
    taken = {name for name, times in count.items() if times == 1}
    names = list[str]()
    for index, one in enumerate(found):
        if one is not None and _folded(one.name) in taken:
            names.append(one.name)
            continue
        usual = USUAL[index] if index < len(USUAL) else f"floor {index}"
        others = (usual, f"storey {index + 1}", f"storey {index + 1} of {len(found)}")
        names.append(next(name for name in others if name not in taken))
    return names


def out_of_order(found: Sequence[StoreyName | None]) -> list[str]:
    """What is to be said where a storey is written to lie below the one that was given before."""
    told = [one for one in found if one is not None]
    for lower, upper in zip(told, told[1:], strict=False):
        if upper.rank < lower.rank:
            return [
                f"{upper.name!r} is given after {lower.name!r}: the drawings are taken for storeys"
                " from the lowest up, so give them in that order."
            ]
    return []


def _folded(name: str) -> str:
    plain = unicodedata.normalize("NFKD", name.replace("ß", "ss").replace("-", " ").casefold())
    plain = "".join(letter for letter in plain if not unicodedata.combining(letter))
    return re.sub(r"\s+", " ", plain.replace("°", "o")).strip()


def _rank(kind: str, groups: dict[str, str | None]) -> int:
    if kind in _RANKS:
        return _RANKS[kind]
    (word,) = (one for one in groups.values() if one is not None)
    for ordinals in (_ORDINALS, _ROMANCE):
        if word in ordinals:
            return ordinals.index(word) + 1
    return int(word)
