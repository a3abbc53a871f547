"""Prints what a change touches: `scripts/changed_tests.py [SINCE] [python|rust|studio]`.

SINCE is what the working tree is compared with (the branch `main` where it is not given). A Python
file touches the tests that import it, or whatever imports it; a file that is no module (a rule
file, a crate, a set of settings) touches all of its package's, or all there are. A file of a crate
touches that crate's own tests (`rust` prints their names), one of the studio its unit tests
(`studio` prints the files).
"""

from __future__ import annotations

import ast
import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path

import grimp

ROOT = Path(__file__).parents[1]
PACKAGE = "veduta"
SOURCES = ROOT / "python"
TESTS = ROOT / "tests"
COMMANDS = {f"{PACKAGE}.cli.{path.stem}" for path in (SOURCES / PACKAGE / "cli").glob("*.py")}
# What no test is told by: the studio's own tests and the benchmarks run apart.
APART = ("studio/", "benchmarks/", "docs/images/")


def changed_files(since: str) -> list[str]:
    """Paths from the root of the checkout: changed since, and those that Git does not know yet."""
    against = ["git", "diff", "--name-only", since]
    unknown = ["git", "ls-files", "--others", "--exclude-standard"]
    found = [
        subprocess.run(one, cwd=ROOT, check=True, capture_output=True, text=True).stdout
        for one in (against, unknown)
    ]
    return sorted({line for text in found for line in text.splitlines()})


def touched_tests(files: Iterable[str]) -> list[str]:
    """The test files, relative to the root; all of them where nothing says which."""
    tests = {path: _imports(path) for path in sorted(TESTS.rglob("test_*.py"))}
    graph = grimp.build_graph(PACKAGE, exclude_type_checking_imports=True)
    # The package's own face reaches every verb, and is imported for its version.
    for module in graph.find_modules_that_directly_import(PACKAGE):
        graph.remove_import(importer=module, imported=PACKAGE)
    chosen: set[Path] = set()
    for name in files:
        path = ROOT / name
        if name.startswith(APART):
            continue
        if path in tests:
            chosen.add(path)
        elif name.startswith("docs/") or name.endswith(".md"):
            chosen |= {one for one in tests if one.parent == TESTS / "unit"}
        elif name.startswith("python/veduta/") and "_core" not in name:
            module = _module_of(name, graph.modules)
            changed = _downstream(graph, module)
            own = TESTS / "unit" / module.split(".")[1]
            chosen |= {
                one for one, met in tests.items() if met & changed or one.is_relative_to(own)
            }
        elif name.startswith(("tests/unit/", "tests/integration/")):
            chosen |= {one for one in tests if one.is_relative_to(path.parent)}
        else:
            chosen |= set(tests)
    return [path.relative_to(ROOT).as_posix() for path in sorted(chosen)]


def touched_crates(files: Iterable[str]) -> list[str]:
    """The crates with a change; but for the one that Python imports, which has no tests."""
    parts = [name.split("/") for name in files if name.startswith("crates/")]
    names = {part[1] for part in parts if len(part) > 2} - {"veduta-py"}
    return sorted(name for name in names if (ROOT / "crates" / name / "Cargo.toml").is_file())


def touched_studio(files: Iterable[str]) -> list[str]:
    """The files of the studio that have changed."""
    return [name for name in files if name.startswith("studio/")]


def _module_of(name: str, modules: Iterable[str]) -> str:
    """The module of a file; of one that is none, the nearest package around it."""
    dotted = name.removeprefix("python/").removesuffix(".py").replace("/", ".")
    dotted = dotted.removesuffix(".__init__")
    known = set(modules)
    while dotted not in known and "." in dotted:
        dotted = dotted.rpartition(".")[0]
    return dotted


def _downstream(graph: grimp.ImportGraph, module: str) -> set[str]:
    """A module, those in it, and all that import any of them."""
    inside = {module, *graph.find_descendants(module)}
    return inside.union(*(graph.find_downstream_modules(one) for one in inside))


def _imports(path: Path) -> set[str]:
    """What a test imports of the package, and each module that it may mean by a name."""
    found: set[str] = set()
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            found |= {node.module, *(f"{node.module}.{alias.name}" for alias in node.names)}
    # The command line brings each verb when it is asked for, and so do those who run it.
    runs = found & {"command_line", "subprocess", f"{PACKAGE}.cli.main"}
    return found | (COMMANDS if runs else set())


if __name__ == "__main__":
    since = sys.argv[1] if len(sys.argv) > 1 else "main"
    kind = sys.argv[2] if len(sys.argv) > 2 else "python"
    kinds = {"python": touched_tests, "rust": touched_crates, "studio": touched_studio}
    print("\n".join(kinds[kind](changed_files(since))))
