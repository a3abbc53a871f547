"""Readers under limits: what they give, and that whatever they do ends in a named file."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from reader_samples import (
    doubled,
    ending,
    endless,
    faulty,
    hungry,
    reader_and_folder,
    refusing,
    telling,
)

from veduta.run.errors import InputError
from veduta.run.limits import Limits, ReaderFault, end_readers, limited

FEW = Limits(memory_mb=200, seconds=2)


def test_what_a_reader_gives_comes_back() -> None:
    assert limited(doubled, 21, "a.pdf", "Mend it.", FEW) == 42
    assert limited(hungry, 50, "a.pdf", "Mend it.", FEW) == 50_000_000


def test_who_asks_hears_how_far_a_reader_is() -> None:
    heard: list[float] = []
    assert limited(telling, [0.25, 0.5], "a.mp4", "Mend it.", FEW, heard.append) == 2
    assert heard == [0.25, 0.5]
    assert limited(telling, [0.75], "a.mp4", "Mend it.", FEW) == 1

    def interrupted(_: float) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        limited(telling, [0.25, 0.5], "a.mp4", "Mend it.", FEW, interrupted)
    assert limited(doubled, 2, "a.mp4", "Mend it.", FEW) == 4


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


def test_one_process_reads_one_file_after_another(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    first, folder = limited(reader_and_folder, None, "a.pdf", "Mend it.", FEW)
    assert first != os.getpid()
    assert folder == os.getcwd()
    with pytest.raises(InputError, match="more than 200 MB"):
        limited(hungry, 500, "a.pdf", "Mend it.", FEW)
    # What one file may cost is no matter of the next.
    assert limited(hungry, 500, "a.pdf", "Mend it.", Limits(900, 5)) == 500_000_000
    monkeypatch.chdir(tmp_path)
    assert limited(reader_and_folder, None, "a.pdf", "Mend it.", FEW) == (first, str(tmp_path))
    with pytest.raises(InputError, match="SIGABRT"):
        limited(ending, None, "a.pdf", "Mend it.", FEW)
    second, _ = limited(reader_and_folder, None, "a.pdf", "Mend it.", FEW)
    assert second != first
    end_readers()
    assert limited(doubled, 2, "a.pdf", "Mend it.", FEW) == 4
