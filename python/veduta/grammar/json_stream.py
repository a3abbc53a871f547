"""A JSON file that is too large to be read at once: its values one after the other.

A value in a list that is no JSON, but whose brackets close, is told and passed over; where brackets
do not close, or the file ends too early, the error names the place.
"""

from __future__ import annotations

import codecs
import json
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NoReturn

from veduta.run.errors import InputError

BLOCK_BYTES = 1 << 20
MAX_VALUE = 64 << 20
"""Letters of one value that is read as a whole."""
_AFTER = ",]} \t\r\n"
_SPACE = re.compile(r"[ \t\r\n]*")
_TOKEN = re.compile(r'"[^"\\]*(?:\\.[^"\\]*)*"|["\[\]{}]', re.DOTALL)
_WORD_END = re.compile(r"[,\]}]")
_LAST_ROW = re.compile(r"\][ \t\r\n]*\]")
NO_UTF8 = re.compile("[\udc80-\udcff]")
"""What stands for bytes that are no UTF-8, by `surrogateescape`."""
_OPENS = {"]": "[", "}": "{"}


def refuse_constant(word: str) -> NoReturn:
    """For `json.loads`: NaN and Infinity are no JSON."""
    raise ValueError(f"{word} is not a number")


@dataclass(frozen=True)
class Broken:
    """A value in a list that cannot be read, and why."""

    fault: str


class JsonStream:
    """A file on its way; `kind` is what it is to be, for messages.

    `names` gives the members of an object; after each of them its value is to be taken, with
    `value`, `names`, `values` or `rows`.
    """

    def __init__(self, path: Path, kind: str) -> None:
        self._path, self._kind = path, kind
        self._text, self._at = "", 0
        self._letters = self._lines = self._line_start = 0  # of what is not in the text any more
        self._ended = self._has_bytes = False
        self._constant = ""
        self._blocks = self._read()
        self._decoder = json.JSONDecoder(parse_constant=self._note_constant)

    def names(self) -> Iterator[str]:
        """The names of an object's members."""
        self._expect("{", "an object")
        while self._next_sign() != "}":
            name = self.value()
            self._expect(":", "a colon")
            yield str(name)
            if not self._goes_on("}"):
                break
        self._expect("}", "the end of the object")

    def values(self) -> Iterator[Any]:
        """The values of a list; `Broken` for one that is no JSON."""
        self._expect("[", "a list")
        while self._next_sign() != "]":
            yield self.value_or_broken()
            if not self._goes_on("]"):
                break
        self._expect("]", "the end of the list")

    def rows(self) -> Iterator[list[Any]]:
        """The values of a list of flat lists, many at a time."""
        self._expect("[", "a list")
        while self._next_sign() != "]":
            yield self._some_rows()
            if not self._goes_on("]"):
                break
        self._expect("]", "the end of the list")

    def value(self) -> Any:
        """The next value."""
        found = self.value_or_broken()
        if isinstance(found, Broken):
            raise self.fault(found.fault)
        return found

    def finish(self) -> None:
        """Refuse what follows."""
        if self._next_sign():
            raise self.fault("more follows where it should end")

    def fault(self, told: str) -> InputError:
        """The error that names the place."""
        begin = self._text.rfind("\n", 0, self._at) + 1
        line = self._lines + self._text.count("\n", 0, self._at) + 1
        before = self._letters - self._line_start if begin == 0 else 0
        place = f"line {line}, letter {before + self._at - begin + 1}"
        return InputError(
            self._path, f"is not {self._kind} ({place}: {told})", f"Save it as {self._kind}."
        )

    def value_or_broken(self) -> Any:
        """The next value; `Broken` where it is no JSON, but ends somewhere."""
        self._next_sign()
        while True:
            self._constant = ""
            try:
                value, end = self._decoder.raw_decode(self._text, self._at)
            except RecursionError as error:
                raise self.fault("a value is nested too deep") from error
            except json.JSONDecodeError as error:
                end = self._end_of_broken()
                if end >= 0:
                    self._at = end
                    return Broken(f"it is no JSON: {error.msg}")
                if self._ended:
                    told = "the file ends within a value" if self._text else error.msg
                    raise self.fault(told) from error
            except ValueError as error:
                raise self.fault(str(error)) from error
            else:
                # A number may go on: `1` is the beginning of `1.5`, and of `1e9`.
                follows = self._text[end : end + 1]
                is_whole = not isinstance(value, int | float) or (follows and follows in _AFTER)
                if is_whole or self._ended:
                    return self._taken(value, end)
            if len(self._text) - self._at > MAX_VALUE:
                raise self.fault(f"a value of more than {MAX_VALUE >> 20} MB, or one without end")
            self._more(double=True)

    def _taken(self, value: Any, end: int) -> Any:
        """The value that ends there, if all of it is sound."""
        begin, self._at = self._at, end
        if self._constant:
            return Broken(f"{self._constant} is not a number")
        if self._has_bytes and NO_UTF8.search(self._text, begin, end):
            return Broken("it is no UTF-8")
        return value

    def _end_of_broken(self) -> int:
        """Where a value ends that is no JSON; -1 where that is not to be seen (yet)."""
        text, sign = self._text, self._text[self._at : self._at + 1]
        if sign not in ("{", "[", '"'):
            found = _WORD_END.search(text, self._at)
            return found.start() if found and sign else -1
        opened: list[str] = []
        for token in _TOKEN.finditer(text, self._at):
            sign = token[0]
            if sign == '"':
                return -1
            if sign in "{[":
                opened.append(sign)
            elif sign in _OPENS and (not opened or opened.pop() != _OPENS[sign]):
                raise self.fault("brackets do not match in the value that begins here")
            if not opened:
                return token.end()
        return -1

    def _some_rows(self) -> list[Any]:
        """As many rows as are there as a whole, at least one."""
        while True:
            last = _LAST_ROW.search(self._text, self._at)
            end = last.start() + 1 if last else self._text.rfind("]", self._at) + 1
            if end > self._at:
                break
            if self._ended or len(self._text) - self._at > MAX_VALUE:
                raise self.fault("a list of numbers has no end")
            self._more(double=True)
        try:
            found: list[Any] = json.loads(f"[{self._text[self._at : end]}]")
        except (RecursionError, ValueError) as error:
            raise self.fault(f"from here on: {error}") from error
        self._at = end
        return found

    def _goes_on(self, end: str) -> bool:
        """Whether a comma leads to something else than the end."""
        if self._next_sign() != ",":
            return False
        self._at += 1
        if self._next_sign() == end:
            raise self.fault("a comma leads nowhere")
        return True

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
        found = self._next_sign()
        if found != sign:
            raise self.fault(f"{what} is missing" if found else f"the file ends, {what} is missing")
        self._at += 1

    def _more(self, *, double: bool = False) -> None:
        """Adds a block, or as much as is there: a value that goes on is not parsed too often."""
        kept = self._text[self._at :]
        self._lines += self._text.count("\n", 0, self._at)
        begin = self._text.rfind("\n", 0, self._at) + 1
        self._line_start = self._letters + begin if begin else self._line_start
        self._letters += self._at
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
        decoder = codecs.getincrementaldecoder("utf-8-sig")("surrogateescape")
        try:
            with self._path.open("rb") as file:
                while block := file.read(BLOCK_BYTES):
                    yield self._noticed(decoder.decode(block))
                yield self._noticed(decoder.decode(b"", final=True))
        except OSError as error:
            told = f"cannot be read ({error.strerror})"
            raise InputError(self._path, told, "Check its permissions.") from error

    def _noticed(self, text: str) -> str:
        self._has_bytes = self._has_bytes or NO_UTF8.search(text) is not None
        return text

    def _note_constant(self, word: str) -> None:
        self._constant = word
