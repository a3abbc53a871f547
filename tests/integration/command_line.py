"""Running the real command line, and looking at what it left behind."""

from __future__ import annotations

import io
import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import (
    AbstractContextManager,
    ExitStack,
    contextmanager,
    redirect_stderr,
    redirect_stdout,
)
from pathlib import Path
from typing import Any
from unittest.mock import patch

from veduta.cli.main import main

TIMEOUT_S = 300
DEADLINE_S = 120
FILES = {
    "facade.json",
    "before.png",
    "facade.csv",
    "labels.png",
    "rectified.jpg",
    "overlay.png",
    "rules.cga",
    "cells.cga",
    "lot.geojson",
    "textures",
    "model.glb",
    "model.city.json",
    "report.json",
    "report.html",
}


def command(*arguments: object) -> list[str]:
    """What to start for these arguments."""
    return [sys.executable, "-m", "veduta.cli.main", *map(str, arguments)]


def veduta(*arguments: object) -> subprocess.CompletedProcess[str]:
    """Run `veduta` with these arguments in a process of its own."""
    return subprocess.run(
        command(*arguments), capture_output=True, text=True, timeout=TIMEOUT_S, check=False
    )


def refused(*arguments: object) -> subprocess.CompletedProcess[str]:
    """What `veduta` says to these arguments, in this process: for calls that it refuses.

    In one of its own, most of their time would be the start of Python and its imports.
    """
    words = list(map(str, arguments))
    output, errors = io.StringIO(), io.StringIO()
    at_term = signal.getsignal(signal.SIGTERM)
    with ExitStack() as stack:
        stack.callback(signal.signal, signal.SIGTERM, at_term)
        stack.enter_context(patch.dict(os.environ))
        stack.enter_context(redirect_stdout(output))
        stack.enter_context(redirect_stderr(errors))
        try:
            code = main(words)
        except SystemExit as end:
            code = end.code if isinstance(end.code, int) else 1
    return subprocess.CompletedProcess(words, code, output.getvalue(), errors.getvalue())


def facade(*arguments: object) -> subprocess.CompletedProcess[str]:
    """Run `veduta facade --rectified` with these arguments."""
    return veduta("facade", "--rectified", *arguments)


def running_facade(*arguments: object) -> AbstractContextManager[subprocess.Popen[str]]:
    """A `veduta facade --rectified` at work."""
    return running("facade", "--rectified", *arguments)


@contextmanager
def running(*arguments: object) -> Iterator[subprocess.Popen[str]]:
    """A `veduta` at work, with its errors in a pipe; none is left behind."""
    run = subprocess.Popen(
        command(*arguments),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
    )
    with run:  # closes the pipe
        try:
            yield run
        finally:
            run.kill()


def wait_for(condition: Callable[[], object]) -> None:
    """Return when the condition holds; the test fails where that takes too long."""
    end = time.monotonic() + DEADLINE_S
    while not condition():
        assert time.monotonic() < end, "the run did not come that far"
        time.sleep(0.02)


def items_done(out: Path) -> list[str]:
    """The names of the finished images, as the run record has them."""
    try:
        record = read_json(out / ".veduta" / "run.json")
    except (FileNotFoundError, json.JSONDecodeError):
        return []
    items = record["items"].items()
    return [name for name, item in items if item["state"] == "done" and name != "."]


def read_json(path: Path) -> Any:
    """The content of a JSON file."""
    return json.loads(path.read_text(encoding="utf-8"))


def tree(folder: Path) -> dict[str, bytes]:
    """All files of a result and their content; times differ, so reports are left out."""
    return {
        str(file.relative_to(folder)): file.read_bytes()
        for file in sorted(folder.rglob("*"))
        if file.is_file() and not file.name.startswith("report.") and ".veduta" not in file.parts
    }


def started_by(pid: int) -> list[int]:
    """The processes that have this parent now."""
    path = Path(f"/proc/{pid}/task/{pid}/children")
    return [int(child) for child in path.read_text().split()] if path.exists() else []


def is_running(pid: int) -> bool:
    """Whether a process is there and no zombie."""
    try:
        os.kill(pid, 0)
        return "Z" not in Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0]
    except (ProcessLookupError, FileNotFoundError):
        return False
