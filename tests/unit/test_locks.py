"""The locks: complete, with hashes, without download addresses, and in step with what they lock."""

from __future__ import annotations

import json
import re
import tomllib
from pathlib import Path
from typing import Any

import pytest
from packaging.requirements import Requirement
from packaging.version import Version

PYTHON_LOCKS = ("requirements/bootstrap.txt", "requirements/lock.txt")


def _pins(text: str) -> dict[str, tuple[Version, str]]:
    """Return name -> (version, the whole entry) of a requirements file."""
    entries = re.split(r"\n(?=\S)", re.sub(r"^\s*#.*\n", "", text, flags=re.MULTILINE).strip())
    pins = {}
    for entry in entries:
        match = re.match(r"([A-Za-z0-9._-]+)==([^\s;]+)", entry)
        assert match, f"not a pinned requirement: {entry[:80]}"
        pins[match[1].lower()] = (Version(match[2]), entry)
    return pins


@pytest.mark.parametrize("name", PYTHON_LOCKS)
def test_python_lock_has_hashes_and_no_addresses(repository: Path, name: str) -> None:
    text = (repository / name).read_text("utf-8")
    assert "://" not in text
    assert "--index-url" not in text
    assert [pin for pin, (_, entry) in _pins(text).items() if "--hash=sha256:" not in entry] == []


def test_python_lock_is_in_step(repository: Path) -> None:
    project = tomllib.loads((repository / "pyproject.toml").read_text("utf-8"))
    wanted = project["project"]["dependencies"] + project["dependency-groups"]["dev"]
    pins = _pins((repository / "requirements/lock.txt").read_text("utf-8"))
    stale = []
    for text in wanted:
        requirement = Requirement(text)
        pin = pins.get(requirement.name.lower())
        if pin is None or not requirement.specifier.contains(pin[0], prereleases=True):
            stale.append(text)
    assert stale == [], "run `make lock`"


@pytest.fixture(scope="module")
def npm_lock(repository: Path) -> dict[str, dict[str, Any]]:
    """Return the packages of the studio's lock by their path in node_modules; "" is the studio."""
    text = (repository / "studio/package-lock.json").read_text("utf-8")
    packages: dict[str, dict[str, Any]] = json.loads(text)["packages"]
    return packages


def test_npm_lock_has_hashes_and_no_addresses(npm_lock: dict[str, dict[str, Any]]) -> None:
    packages = {path: entry for path, entry in npm_lock.items() if path}
    assert [path for path, entry in packages.items() if "resolved" in entry] == []
    assert [path for path, entry in packages.items() if "integrity" not in entry] == []
    assert [path for path, entry in packages.items() if "version" not in entry] == []


def test_npm_lock_is_in_step(repository: Path, npm_lock: dict[str, dict[str, Any]]) -> None:
    package = json.loads((repository / "studio/package.json").read_text("utf-8"))
    for kind in ("dependencies", "devDependencies"):
        assert npm_lock[""].get(kind, {}) == package.get(kind, {}), "run `make lock`"


def test_cargo_lock_has_checksums(repository: Path) -> None:
    lock = tomllib.loads((repository / "Cargo.lock").read_text("utf-8"))
    outside = [package for package in lock["package"] if "source" in package]
    assert [package["name"] for package in outside if "checksum" not in package] == []
