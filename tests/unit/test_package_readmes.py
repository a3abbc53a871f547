"""The README of each verb's package names every module of it, so that the map stays true."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

PACKAGES = Path(__file__).resolve().parents[2] / "python/veduta"
READMES = sorted(PACKAGES.glob("*/README.md"))


def _named(readme: Path) -> set[Path]:
    """Files and folders that the page links to."""
    links = re.findall(r"\]\(([^)#\s]+)\)", readme.read_text("utf-8"))
    return {(readme.parent / link).resolve() for link in links}


@pytest.mark.parametrize("readme", READMES, ids=lambda path: str(path.parent.name))
def test_every_module_of_a_package_is_named(readme: Path) -> None:
    named = _named(readme)
    folder = readme.parent.resolve()
    unnamed = [
        str(module.relative_to(folder))
        for module in sorted(folder.rglob("*.py"))
        if module.name != "__init__.py"
        and module not in named
        and not any(parent in named and parent != folder for parent in module.parents)
    ]
    assert unnamed == []


def test_the_map_fits_two_screens() -> None:
    assert (PACKAGES.parents[1] / "ARCHITECTURE.md").stat().st_size <= 8000
