"""`veduta demo`: what it refuses before it begins."""

from __future__ import annotations

from pathlib import Path

import pytest

from veduta.cli.demo import run
from veduta.run.errors import InputError


def test_two_demos_at_once_are_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="two demos"):
        run(["-o", str(tmp_path / "demo"), "--walk", "--animal"])
    assert not (tmp_path / "demo").exists()
