"""The features of a GeoJSON file that is too large to be read at once, one after the other."""

from __future__ import annotations

import codecs
import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NoReturn

from veduta.run.errors import InputError

BLOCK_BYTES = 1 << 20
MAX_VALUE = 64 << 20
"""Letters of one feature, or of one member beside the features."""
_AFTER = ",]} \t\r\n"
_SPACE = re.compile(r"[ \t\r\n]*")


class FeatureStream:
    """A FeatureCollection on its way; `members` are those that have come so far, but features."""

    def __init__(self, path: Path) -> None:
        self.members: dict[str, Any] = {}
        self._path = path
        self._text = ""
        self._at = 0
        self._ended = False
        self._blocks = self._read()
        self._decoder = json.JSONDecoder(parse_constant=_refuse_constant)

    def features(self) -> Iterator[Any]:
        """The features in their order; InputError where the file is no FeatureCollection."""
        self._expect("{", "an object")
        has_features = False
        while self._next_sign() != "}":
            name = self._value()
            self._expect(":", "a colon")
            if name == "features":
                has_features = True
                yield from self._list()
            else:
                self.members[str(name)] = self._value()
                if self.members.get("type") == "CityJSON":
                    raise InputError(
                        self._path, "is too large for CityJSON", "Cut it into several."
                    )
            if not self._goes_on("}"):
                break
        self._expect("}", "the end of the object")
        if not has_features or self.members.get("type") != "FeatureCollection":
            raise self._fault("only a FeatureCollection may be so large")

    def _list(self) -> Iterator[Any]:
        self._expect("[", "a list of features")
        while self._next_sign() != "]":
            yield self._value()
            if not self._goes_on("]"):
                break
        self._expect("]", "the end of the features")

    def _goes_on(self, end: str) -> bool:
        """Whether a comma leads to something else than the end."""
        if self._next_sign() != ",":
            return False
        self._at += 1
        if self._next_sign() == end:
            raise self._fault("a comma leads nowhere")
        return True

    def _value(self) -> Any:
        """The next value, and the place after it."""
        self._next_sign()
        while True:
            try:
                value, end = self._decoder.raw_decode(self._text, self._at)
            except RecursionError as error:
                raise self._fault("a value is nested too deep") from error
            except ValueError as error:
                if self._ended or not isinstance(error, json.JSONDecodeError):
                    raise self._fault(str(error)) from error
            else:
                # A number may go on: `1` is the beginning of `1.5`, and of `1e9`.
                follows = self._text[end : end + 1]
                is_whole = not isinstance(value, int | float) or (follows and follows in _AFTER)
                if is_whole or self._ended:
                    self._at = end
                    return value
            if len(self._text) - self._at > MAX_VALUE:
                raise self._fault(f"a value of more than {MAX_VALUE >> 20} MB")
            self._more(double=True)

    def _next_sign(self) -> str:
        """The next letter that is no space; "" at the end."""
        while True:
            found = _SPACE.match(self._text, self._at)
            self._at = found.end() if found else self._at
            if self._at < len(self._text):
                return self._text[self._at]
            if self._ended:
                return ""
            self._more()

    def _expect(self, sign: str, what: str) -> None:
        if self._next_sign() != sign:
            raise self._fault(f"{what} is missing")
        self._at += 1

    def _more(self, *, double: bool = False) -> None:
        """Adds a block, or as much as is there: a value that goes on is not parsed too often."""
        kept = self._text[self._at :]
        wanted = len(kept) if double else 1
        parts = [kept]
        while wanted > 0:
            block = next(self._blocks, None)
            if block is None:
                self._ended = True
                break
            parts.append(block)
            wanted -= len(block)
        self._text, self._at = "".join(parts), 0

    def _read(self) -> Iterator[str]:
        decoder = codecs.getincrementaldecoder("utf-8-sig")()
        try:
            with self._path.open("rb") as file:
                while block := file.read(BLOCK_BYTES):
                    yield decoder.decode(block)
                yield decoder.decode(b"", final=True)
        except UnicodeDecodeError as error:
            raise self._fault("it is no UTF-8") from error
        except OSError as error:
            told = f"cannot be read ({error.strerror})"
            raise InputError(self._path, told, "Check its permissions.") from error

    def _fault(self, told: str) -> InputError:
        return InputError(self._path, f"is not GeoJSON ({told})", "Save it as GeoJSON.")


def _refuse_constant(word: str) -> NoReturn:
    raise ValueError(f"{word} is not a number")
