"""The wheel that `make wheel` builds: it works where there is no checkout, no Rust and no Node."""

from __future__ import annotations

import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
UV = ROOT / ".venv" / "bin" / "uv"


@pytest.fixture(scope="module")
def wheel() -> Path:
    if not UV.exists() or shutil.which("cargo") is None or shutil.which("make") is None:
        pytest.skip("building the wheel needs the checkout's .venv, make and cargo")
    subprocess.run(["make", "wheel"], cwd=ROOT, check=True, capture_output=True, text=True)
    (built,) = (ROOT / "build" / "wheel").glob("veduta-*.whl")
    return built


def test_it_holds_the_extension_the_studio_and_the_rules(wheel: Path) -> None:
    names = zipfile.ZipFile(wheel).namelist()
    for ending in ("_core.abi3.so", "static/index.html", "static/offline.js", "haussmann.cga"):
        assert any(name.endswith(ending) for name in names), ending
    assert "veduta/py.typed" in names
    assert not any("tests" in name.split("/") for name in names)


def test_it_runs_the_demo_outside_of_the_checkout(wheel: Path, tmp_path: Path) -> None:
    home = tmp_path / "fresh"
    subprocess.run([UV, "venv", "--quiet", "--python", sys.executable, home], check=True)
    python = home / "bin" / "python"
    # What the lock says is in uv's cache since `make setup`: nothing is looked up.
    lock = ROOT / "requirements" / "lock.txt"
    fill = [UV, "pip", "sync", "--quiet", "--require-hashes", "--python", python, lock]
    subprocess.run(fill, cwd=tmp_path, check=True)
    install = [UV, "pip", "install", "--quiet", "--no-deps", "--python", python, wheel]
    subprocess.run(install, cwd=tmp_path, check=True)
    where = [python, "-c", "import veduta; print(veduta.__file__)"]
    found = subprocess.run(where, cwd=tmp_path, check=True, capture_output=True, text=True)
    assert Path(found.stdout.strip()).is_relative_to(home)
    command = [home / "bin" / "veduta", "demo", "-o", tmp_path / "demo"]
    told = subprocess.run(command, cwd=tmp_path, check=False, capture_output=True, text=True)
    assert told.returncode == 0, told.stderr
    assert (tmp_path / "demo" / "place" / "place.json").is_file()
    web = [
        home / "bin" / "veduta",
        "export",
        tmp_path / "demo" / "place",
        "--web",
        tmp_path / "site",
    ]
    subprocess.run(web, cwd=tmp_path, check=True, capture_output=True)
    assert (tmp_path / "site" / "index.html").is_file()
