"""A checkout may lie in a folder whose name has spaces: no command takes it apart."""

from __future__ import annotations

import shlex
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
TARGETS = ("setup", "lint-python", "lint-rust", "lint-studio", "test-rust", "test-python", "wheel")


@pytest.mark.parametrize("target", TARGETS)
def test_what_make_would_run_quotes_the_folder(target: str, tmp_path: Path) -> None:
    folder = tmp_path / "my check out"
    folder.mkdir()
    shutil.copy(ROOT / "Makefile", folder)
    for name in ("crates", "studio", "scripts", "requirements", "python", "pyproject.toml",
                 "Cargo.toml", "Cargo.lock"):  # fmt: skip
        (folder / name).symlink_to(ROOT / name)
    done = subprocess.run(
        ["make", "-n", "-B", target], cwd=folder, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    text = done.stdout.replace("\\\n", " ")
    lines = [line for line in text.splitlines() if str(folder) in line]
    for line in lines:
        words = shlex.split(line)
        whole = sum(word.count(str(folder)) for word in words)
        assert whole == line.count(str(folder)), line
    if target == "setup":
        assert lines, "setup names the folder, for the extension's interpreter"
