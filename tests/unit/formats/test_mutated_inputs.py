"""Every reader of files that come from outside, on files with faults put into them.

Whatever is in a file, a reader gives a result or an error that a person can act on (`InputError`,
`NotFoundError`), and takes no more memory than its file deserves. `FUZZ_CASES=5000` draws as many
cases of each kind, and `FUZZ_FIRST` begins at a number: a case is made from its number alone.
`scripts/mutations.py` keeps a table.
"""

from __future__ import annotations

import os
import resource
from pathlib import Path

import pytest
from faulty_inputs import CLASSES, mutated

from veduta.run.errors import InputError, NotFoundError

CASES = int(os.environ.get("FUZZ_CASES", "60"))
FIRST = int(os.environ.get("FUZZ_FIRST", "0"))
MOST_BYTES = 500 * 2**20


@pytest.mark.parametrize("kind", CLASSES)
def test_a_reader_gives_a_result_or_a_reason(kind: str, tmp_path: Path) -> None:
    write, read = CLASSES[kind]
    try:
        path = write(tmp_path)
    except FileNotFoundError as error:  # a kind whose sound files are real data
        pytest.skip(str(error))
    sound = path.read_bytes()
    read(path)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    unnamed = []
    refused = 0
    for number in range(FIRST, FIRST + CASES):
        path.write_bytes(mutated(sound, number))
        try:
            read(path)
        except (InputError, NotFoundError) as error:
            refused += 1
            if path.name not in str(error) and path.parent.name not in str(error):
                unnamed.append((number, str(error)))
        except Exception as error:
            raise AssertionError(f"case {number} of {kind}: {error!r}") from error
    assert refused > 0
    assert unnamed == []
    grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
    assert grown * 1024 < MOST_BYTES, f"{kind} took {grown / 1024:.0f} MB"
