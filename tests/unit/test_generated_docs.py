"""The tables in docs/ that follow from the code are as the code has them now."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path


def test_tables_are_up_to_date(repository: Path) -> None:
    check = [sys.executable, "docs/generate.py", "--check"]
    done = subprocess.run(check, cwd=repository, capture_output=True, text=True, check=False)
    assert done.returncode == 0, f"{done.stdout}{done.stderr}: run python docs/generate.py"
