"""The words of one line of a control file: blanks, tabs or quotes keep them apart.

A photo's name may have blanks. Where tabs stand between the columns, or quotes around the name,
that settles it; else the name ends where a picture's suffix does.
"""

from __future__ import annotations

import re

NUMBERS = 5
"""x y z px py."""
_QUOTED = re.compile(r"""^(["'])(?P<name>.+?)\1(?P<rest>.*)$""")
_NAMED = re.compile(
    r"^(?P<name>.+?\.(?:jpe?g|png|tiff?|webp|hei[cf]|avif|bmp|dng|raw))(?P<rest>\s.*)?$",
    re.IGNORECASE,
)


def control_words(line: str) -> tuple[list[str], str, str]:
    """The numbers as they are written, the photo and the point's name; ValueError with the fault.

    The name is empty where the line has none.
    """
    words = line.split("\t") if line.count("\t") >= NUMBERS else line.split(maxsplit=NUMBERS)
    words = [word.strip() for word in words]
    if len(words) <= NUMBERS or not words[NUMBERS]:
        raise ValueError(f"has {len(line.split())} words")
    numbers, rest = words[:NUMBERS], words[NUMBERS:]
    if len(rest) > 1:
        return numbers, _bare(rest[0]), " ".join(_bare(word) for word in rest[1:] if word)
    return numbers, *_photo_and_name(rest[0])


def _photo_and_name(text: str) -> tuple[str, str]:
    for pattern in (_QUOTED, _NAMED):
        found = pattern.match(text)
        if found is not None:
            return found["name"].strip(), _bare((found["rest"] or "").strip())
    photo, _, name = text.partition(" ")
    return photo, _bare(name.strip())


def _bare(word: str) -> str:
    """Without the quotes around it."""
    found = _QUOTED.match(word)
    return found["name"] if found is not None and not found["rest"].strip() else word
