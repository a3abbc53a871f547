"""Run a benchmark with its options, or list what there is.

    .venv/bin/python benchmarks                          what there is, a line each
    .venv/bin/python benchmarks dense/linking --no-keep  one of them

A program finds what it shares with others: `record.py`, `measuring/` and its own folder.
"""

from __future__ import annotations

import ast
import runpy
import sys
from pathlib import Path

from veduta.run.threads import same_sums_anywhere

HERE = Path(__file__).resolve().parent


def programs() -> dict[str, Path]:
    """What can be run, by its name: `VERB/PROGRAM`."""
    found = sorted([*HERE.glob("*.py"), *HERE.glob("*/*.py")])
    return {
        path.relative_to(HERE).with_suffix("").as_posix(): path
        for path in found
        if path.name != "__main__.py" and '\nif __name__ == "__main__"' in path.read_text()
    }


def main() -> int:
    """Run what is named, in this process; 2 where there is none of that name."""
    known = programs()
    if len(sys.argv) < 2:
        for name, path in known.items():
            says = (ast.get_docstring(ast.parse(path.read_text())) or "").splitlines()
            print(f"{name:32} {says[0] if says else ''}")
        return 0
    name = sys.argv[1]
    if name not in known:
        print(f"there is no benchmark {name}: python benchmarks lists them", file=sys.stderr)
        return 2
    path = known[name]
    same_sums_anywhere()  # as the command does, before anything loads numpy
    sys.argv = [str(path), *sys.argv[2:]]
    sys.path[:0] = [str(folder) for folder in (HERE, HERE / "measuring", path.parent)]
    runpy.run_path(str(path), run_name="__main__")
    return 0


if __name__ == "__main__":
    sys.exit(main())
