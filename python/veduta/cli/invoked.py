"""Commands that are shown to be copied: they name the program as it was called."""

from __future__ import annotations

import shlex
import shutil
import sys
from pathlib import Path


def invoked(*words: str) -> str:
    """`veduta view out`, or `.venv/bin/veduta view out` where the shell would not find it."""
    called = sys.argv[0]
    elsewhere = Path(called).name == "veduta" and shutil.which("veduta") is None
    return shlex.join([called if elsewhere else "veduta", *words])
