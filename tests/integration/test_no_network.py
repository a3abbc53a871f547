"""No verb looks up the name of any host: all look-ups of the C library are trapped.

onnxruntime's telemetry also leaves an id of the machine in the home folder on first use, before it
sends anything: with it switched on (`ORT_DISABLE_TELEMETRY` deleted), that is what fails here. The
calls of all nine verbs in `test_names_not_utf8` run in the same trap.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
import trapped_names
from command_line import command
from trapped_names import compiled_trap, trapped_environment


@pytest.fixture(scope="module")
def trap(tmp_path_factory: pytest.TempPathFactory) -> Path:
    found = compiled_trap(tmp_path_factory.mktemp("trap"))
    if found is None:
        pytest.skip("name look-ups are trapped by a library for Linux, which needs a C compiler")
    return found


def looked_up(trap: Path, folder: Path, words: list[str]) -> str:
    """What was asked for while a command ran; it must succeed."""
    env = trapped_environment(trap, folder)
    done = subprocess.run(words, env=env, capture_output=True, text=True, timeout=300, check=False)
    assert done.returncode == 0, done.stderr
    return trapped_names.looked_up(folder)


def test_the_trap_works(trap: Path, tmp_path: Path) -> None:
    code = (
        "import socket, contextlib\n"
        "with contextlib.suppress(OSError):\n"
        "    socket.getaddrinfo('host.invalid', 80)"
    )
    assert "getaddrinfo host.invalid" in looked_up(trap, tmp_path, [sys.executable, "-c", code])


def test_reading_a_facade_looks_nothing_up(trap: Path, photo: Path, tmp_path: Path) -> None:
    words = command("facade", "--rectified", photo, "-o", tmp_path / "out")
    assert looked_up(trap, tmp_path, words) == ""


def test_reading_text_looks_nothing_up(trap: Path, tmp_path: Path) -> None:
    """The engine that reads the words of plans is onnxruntime, in processes of its own."""
    code = (
        "import veduta, numpy as np\n"
        "from veduta.plan.text.engine import read_line\n"
        "print(read_line(np.full((48, 160, 3), 255, np.uint8)))\n"
        "import onnxruntime, time\n"
        "time.sleep(2)"
    )
    assert looked_up(trap, tmp_path, [sys.executable, "-c", code]) == ""


def test_deriving_looks_nothing_up(trap: Path, tmp_path: Path) -> None:
    rules = tmp_path / "box.cga"
    rules.write_text("Lot --> extrude(9)")
    words = command("grammar", "derive", rules, "-o", tmp_path / "out")
    assert looked_up(trap, tmp_path, words) == ""


def test_exporting_looks_nothing_up(trap: Path, one_house: Path, tmp_path: Path) -> None:
    for name in ("x.usda", "x.gpkg", "x.gml", "x.glb"):
        words = command("export", one_house, tmp_path / name)
        assert looked_up(trap, tmp_path, words) == ""
