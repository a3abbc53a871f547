"""`python -m veduta.plan.furnish.catalogue.copy FILE.sqlite`: the catalogue as a file."""

from __future__ import annotations

import sqlite3
import sys
from pathlib import Path

from veduta.plan.furnish.catalogue.read import open_builtin


def copy_to(path: Path) -> None:
    """Write the project's catalogue as an SQLite file; FileExistsError where there is one."""
    if path.exists():
        raise FileExistsError(f"{path} is there already")
    with open_builtin() as base:
        target = sqlite3.connect(path)
        base.backup(target)
        target.close()


if __name__ == "__main__":
    copy_to(Path(sys.argv[1]))
