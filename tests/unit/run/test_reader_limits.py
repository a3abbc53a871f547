"""Readers under limits: what they give, and that whatever they do ends in a named file."""

from __future__ import annotations

import pytest
from reader_samples import doubled, ending, endless, faulty, hungry, refusing

from veduta.run.errors import InputError
from veduta.run.limits import Limits, ReaderFault, limited

FEW = Limits(memory_mb=200, seconds=2)


def test_what_a_reader_gives_comes_back() -> None:
    assert limited(doubled, 21, "a.pdf", "Mend it.", FEW) == 42
    assert limited(hungry, 50, "a.pdf", "Mend it.", FEW) == 50_000_000


def test_its_own_errors_pass_through() -> None:
    with pytest.raises(InputError, match=r"a\.pdf: is damaged"):
        limited(refusing, "a.pdf", "other", "Other.", FEW)


@pytest.mark.parametrize(
    ("reader", "argument", "said"),
    [
        (hungry, 2000, "takes more than 200 MB of memory to read"),
        (endless, None, "(takes more than 2 s|cannot be read within 200 MB)"),
        (ending, None, r"cannot be read within .*SIGABRT"),
    ],
)
def test_a_reader_that_takes_too_much_names_the_file(
    reader: object, argument: object, said: str
) -> None:
    with pytest.raises(InputError, match=rf"a\.pdf: {said}.* Mend it\."):
        limited(reader, argument, "a.pdf", "Mend it.", FEW)


def test_a_bug_in_a_reader_is_one() -> None:
    with pytest.raises(ReaderFault, match="no such thing"):
        limited(faulty, None, "a.pdf", "Mend it.", FEW)
