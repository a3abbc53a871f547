"""Which tests `make test-changed` runs."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from types import ModuleType

import pytest

SCRIPT = Path(__file__).parents[2] / "scripts" / "changed_tests.py"


@pytest.fixture(scope="module")
def script() -> ModuleType:
    spec = importlib.util.spec_from_file_location("changed_tests", SCRIPT)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_a_module_touches_the_tests_of_all_that_import_it(script: ModuleType) -> None:
    chosen = script.touched_tests(["python/veduta/walk/build/morph.py"])
    assert any("tests/unit/walk/" in name for name in chosen)
    assert "tests/unit/carve/test_background.py" not in chosen
    low = script.touched_tests(["python/veduta/run/errors.py"])
    # Those of the package itself are run for whatever in it has changed.
    assert {name for name in chosen if "tests/unit/walk/" not in name} < set(low)


def test_the_studio_and_the_benchmarks_touch_none(script: ModuleType) -> None:
    assert script.touched_tests(["studio/src/app/studio.ts", "benchmarks/photos/roofs.py"]) == []


def test_a_rule_file_touches_its_package_and_a_lock_everything(script: ModuleType) -> None:
    styles = script.touched_tests(["python/veduta/grammar/styles/haussmann.cga"])
    assert any("tests/unit/grammar/" in name for name in styles)
    every = script.touched_tests(["requirements/lock.txt"])
    assert set(styles) < set(every)
    assert "tests/unit/test_changed_tests.py" in every


def test_a_test_touches_itself_alone(script: ModuleType) -> None:
    name = "tests/unit/test_changed_tests.py"
    assert script.touched_tests([name]) == [name]


def test_a_crate_touches_its_own_tests_and_the_studio_its(script: ModuleType) -> None:
    files = [
        "Cargo.lock",
        "crates/veduta-py/src/lib.rs",
        "crates/veduta-tiles/src/lib.rs",
        "crates/veduta-tiles/tests/a.rs",
        "crates/that-was-removed/src/lib.rs",
        "studio/src/app/studio.ts",
    ]
    assert script.touched_crates(files) == ["veduta-tiles"]
    assert script.touched_studio(files) == ["studio/src/app/studio.ts"]
    assert script.touched_crates(["studio/src/app/studio.ts"]) == []
