"""Folders for results that nobody has named: they are there as long as what was read from them."""

from __future__ import annotations

import tempfile
import weakref
from pathlib import Path
from typing import Any


def scratch_folder() -> tuple[Path, tempfile.TemporaryDirectory[str]]:
    """A new folder to be OUT, and what it goes with."""
    above = tempfile.TemporaryDirectory(prefix="veduta-")
    return Path(above.name) / "out", above


def goes_with(owner: Any, folder: tempfile.TemporaryDirectory[str]) -> None:
    """Have a folder deleted when its owner is no longer used."""
    weakref.finalize(owner, folder.cleanup)
