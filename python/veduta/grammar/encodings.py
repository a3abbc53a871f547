"""The text of rule files and tables in the encodings that people have saved them in."""

from __future__ import annotations

import codecs

_MARKS = (
    (codecs.BOM_UTF8, "utf-8-sig"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)


def decoded(content: bytes) -> tuple[str, str | None]:
    """The text, and the encoding where it is not UTF-8.

    UTF-16 is told by its mark. What is not UTF-8 is taken for cp1252, which Windows programs of the
    western languages write; its five bytes without a meaning are those of Latin-1.
    """
    for mark, encoding in _MARKS:
        if content.startswith(mark):
            text = content.decode(encoding, errors="replace")
            return text, None if mark == codecs.BOM_UTF8 else "UTF-16"
    try:
        return content.decode("utf-8"), None
    except UnicodeDecodeError:
        pass
    try:
        return content.decode("cp1252"), "cp1252"
    except UnicodeDecodeError:
        return content.decode("latin-1"), "Latin-1"
