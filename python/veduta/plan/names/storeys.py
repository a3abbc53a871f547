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
_ITALIAN = ("primo", "secondo", "terzo", "quarto", "quinto", "sesto", "settimo", "ottavo")
_SPANISH = ("primera", "segunda", "tercera", "cuarta", "quinta", "sexta", "septima", "octava")
_DUTCH = ("eerste", "tweede", "derde", "vierde", "vijfde", "zesde", "zevende", "achtste")
_LEVEL = r"(floor|level|storey|story)"
_TITLES = {
    "cellar": rf"((lower ground|basement|cellar) {_LEVEL}|lower ground|basement|sous sol|subsolo"
    r"|keller ?geschoss|unter ?geschoss|kellari ?kerros|(piano )?(semi)?interrato|(planta )?sotano"
    r"|kelder ?verdieping|kallar ?(plan|vaning)|b\d+f|地下\d*階|קומת מרתף)",
    "ground": rf"((ground|main) {_LEVEL}|rez de (chaussee|jardin)|erd ?geschoss"
    r"|(pavimento |piso )?terreo|res do chao|pohja ?kerros|piano (terra|rialzato)|planta baja"
    r"|begane grond|botten ?(vaning|plan)|entre ?plan|קומת קרקע)",
    "from one": r"((?P<a>\d+) ?(f|階|층))",
    "number": rf"(({_LEVEL}|piso) (?P<a>\d+)|(?P<b>\d+) ?(st|nd|rd|th) {_LEVEL}"
    r"|(?P<c>\d+) ?(er|ere|e|eme) etage|(?P<d>\d+)\.? ?(og|ober ?geschoss|stock)"
    r"|(?P<e>\d+)\.? ?[oa]? ?(pavimento|andar|piso)|(?P<f>\d+)\.? ?(kerros|krs)"
    r"|(planta|verdieping|קומה) (?P<i>\d+)|(?P<j>\d+)a planta|(?P<k>\d+)(e|ste|de) verdieping)",
    "ordinal": rf"((?P<g>{'|'.join(_ORDINALS)}) {_LEVEL}"
    rf"|(?P<h>{'|'.join(_ROMANCE)}) (pavimento|andar|piso)"
    rf"|(?P<l>{'|'.join(_ITALIAN)}) piano|piano (?P<m>{'|'.join(_ITALIAN)})"
    rf"|(?P<n>{'|'.join(_SPANISH)}) planta|planta (?P<o>{'|'.join(_SPANISH)})"
    rf"|(?P<p>{'|'.join(_DUTCH)}) verdieping)",
    "top": rf"((upper|top|attic|loft) {_LEVEL}|ober ?geschoss|dach ?geschoss"
    r"|pavimento superior|ullakko ?kerros|planta alta|piano superiore|over ?vaning(en)?"
    r"|vinds ?(plan|vaning)|zolder ?verdieping)",
}
_BEFORE = (
    r"(floor ?plan|plan|planta baixa|planta|grundriss|pohjapiirros)( of( the)?| du| de l'| do)?"
)
_AFTER = r"(plan|layout)"
_RANKS = {"cellar": -1, "ground": 0, "top": 99}
_SHORT = {"KG": "cellar", "UG": "cellar", "EG": "ground", "OG": "top", "DG": "top"}
"""As Germans write them, in capital letters alone."""


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
    whole, name = name, cut["name"].strip(" :-") if cut else name
    # The whole line first: `Planta` alone begins a title, `Planta baja` is one.
    return _titled(whole) or _titled(name)


def _titled(name: str) -> StoreyName | None:
    if name in _SHORT:
        return StoreyName(name, _RANKS[_SHORT[name]])
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
    for ordinals in (_ORDINALS, _ROMANCE, _ITALIAN, _SPANISH, _DUTCH):
        if word in ordinals:
            return ordinals.index(word) + 1
    return int(word) - 1 if kind == "from one" else int(word)
