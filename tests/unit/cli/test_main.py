"""The dispatcher: what it imports, and how errors are told."""

from __future__ import annotations

import importlib
import os
import signal
import subprocess
import sys
import types
import warnings
from collections.abc import Callable
from pathlib import Path

import pytest

from veduta.cli import main as cli
from veduta.run.errors import InputError, NotFoundError, UnfinishedError

HEAVY = {"numpy", "cv2", "scipy", "pydantic", "tyro", "rich", "PIL", "fastapi", "jinja2", "trimesh"}


def test_help_imports_nothing_heavy() -> None:
    code = "import sys; from veduta.cli.main import main; main(['--help']); print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    *text, modules = done.stdout.splitlines()
    assert HEAVY & set(modules.split()) == set()
    for verb in cli.VERBS:
        assert any(line.startswith(f"  {verb} ") for line in text)


def test_a_facade_imports_no_library_that_it_does_not_need() -> None:
    """Each takes longer to import than all of Veduta, in each process of a call."""
    code = "import sys, veduta.facade.batch, veduta.cli.facade_call; print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert {"scipy", "trimesh", "pycolmap", "fastapi"} & set(done.stdout.split()) == set()


@pytest.mark.parametrize("verb", cli.VERBS)
def test_summaries_are_of_one_style(verb: str) -> None:
    """An imperative with a capital, short enough for a line, without a full stop."""
    summary = importlib.import_module(f"veduta.cli.{verb}").SUMMARY
    assert summary.split()[0] in {"Turn", "Make", "Show", "Write"}
    assert len(summary) < 80
    assert not summary.endswith(".")


@pytest.fixture
def run_verb(monkeypatch: pytest.MonkeyPatch) -> Callable[[BaseException | int], int]:
    """Run a verb that raises this, or returns it."""

    def run(outcome: BaseException | int) -> int:
        def verb(arguments: list[str]) -> int:
            if isinstance(outcome, BaseException):
                raise outcome
            return outcome

        module = types.SimpleNamespace(run=verb, SUMMARY="")
        monkeypatch.setitem(sys.modules, "veduta.cli.facade", module)
        monkeypatch.setattr(signal, "signal", lambda *_: None)
        return cli.main(["facade"])

    return run


@pytest.mark.parametrize(
    ("outcome", "code", "told"),
    [
        (0, 0, ""),
        (3, 3, ""),
        (InputError("a.jpg", "is empty", "Copy it."), 2, "error: a.jpg: is empty. Copy it.\n"),
        (NotFoundError("facade", "no lines", "Try."), 3, "error: facade not found: no lines"),
        (KeyboardInterrupt(), 130, "stopped: what is finished"),
        (UnfinishedError("by SIGTERM"), 143, "stopped: "),
    ],
)
def test_outcomes(
    run_verb: Callable[[BaseException | int], int],
    capfd: pytest.CaptureFixture[str],
    outcome: BaseException | int,
    code: int,
    told: str,
) -> None:
    assert run_verb(outcome) == code
    assert capfd.readouterr().err.startswith(told)


def test_a_help_text_leaves_nothing_finished(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def verb(_: list[str]) -> int:
        raise KeyboardInterrupt

    module = types.SimpleNamespace(run=verb, SUMMARY="")
    monkeypatch.setitem(sys.modules, "veduta.cli.facade", module)
    monkeypatch.setattr(signal, "signal", lambda *_: None)
    assert cli.main(["facade", "--help"]) == 130
    assert capsys.readouterr().err == "stopped\n"


def test_a_bug_is_saved_and_named(
    run_verb: Callable[[BaseException | int], int], capsys: pytest.CaptureFixture[str]
) -> None:
    assert run_verb(ZeroDivisionError("by zero")) == 1
    error = capsys.readouterr().err
    assert "a bug in veduta facade: ZeroDivisionError: by zero" in error
    assert "Traceback" not in error
    saved = Path(error.split()[-1])
    assert "raise outcome" in saved.read_text()
    saved.unlink()


TALKER = """
import sys, types
from veduta.cli import main as cli

def verb(arguments):
    print("first line", flush=True)
    sys.stdin.readline()  # until the reader has gone
    for number in range(20_000):  # more than any buffer holds
        print("line", number)
    print("an error", file=sys.stderr)
    sys.stdin.readline()
    print("the last line, which is flushed at the exit")
    return 3

sys.modules["veduta.cli.facade"] = types.SimpleNamespace(run=verb, SUMMARY="")
sys.exit(cli.main(["facade"]))
"""


@pytest.mark.parametrize("unbuffered", ["", "1"])
def test_a_reader_that_leaves_changes_no_exit_code(unbuffered: str) -> None:
    environment = {**os.environ, "PYTHONUNBUFFERED": unbuffered}
    with subprocess.Popen(
        [sys.executable, "-c", TALKER],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=environment,
    ) as run:
        assert run.stdin
        assert run.stdout
        assert run.stderr
        assert run.stdout.readline() == "first line\n"
        run.stdout.close()
        run.stdin.write("go on\ngo on\n")
        run.stdin.close()
        assert run.stderr.read() == "an error\n"
    assert run.returncode == 3


@pytest.mark.parametrize(
    ("arguments", "code"), [(["--help"], 0), (["facade", "--help"], 0), (["facade", "no.jpg"], 2)]
)
def test_nobody_reads_anything(arguments: list[str], code: int) -> None:
    """Both streams are pipes whose other end is closed before the first word."""
    reader, writer = os.pipe()
    os.close(reader)
    done = subprocess.run(
        [sys.executable, "-m", "veduta.cli.main", *arguments, "-o", "out"],
        stdout=writer,
        stderr=writer,
        check=False,
    )
    os.close(writer)
    assert done.returncode == code


def test_what_is_read_arrives_whole(tmp_path: Path) -> None:
    """In a pipe as in a file."""
    command = [sys.executable, "-m", "veduta.cli.main", "facade", "--help"]
    piped = subprocess.run(command, capture_output=True, check=True).stdout
    with (tmp_path / "help").open("wb") as file:
        subprocess.run(command, stdout=file, check=True)
    assert piped == (tmp_path / "help").read_bytes() != b""


def test_the_help_of_grammar_names_every_option() -> None:
    """`veduta grammar --help` stands for the help of its actions."""
    from dataclasses import fields

    from veduta.cli.grammar import HELP
    from veduta.cli.grammar_call import DeriveCall, FormatCall, SampleCall, TreeCall
    from veduta.grammar.options import (
        DeriveOptions,
        LimitOptions,
        LotOptions,
        OutputOptions,
        SampleOptions,
    )
    from veduta.run.options import flag

    calls = (DeriveCall, FormatCall, SampleCall, TreeCall)
    names = {field.name for call in calls for field in fields(call)}
    names -= {"rules", "derive", "limits", "read", "output", "sheet", "out"}
    for options in (DeriveOptions, LimitOptions, LotOptions, OutputOptions, SampleOptions):
        names |= set(options.model_fields)
    named = {name for name in names if flag(name) in HELP or f"--no-{name}" in HELP}
    missing = names - named
    assert missing == set()


def test_sums_of_a_library_that_come_out_right_are_no_warnings(tmp_path: Path) -> None:
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        cli.main(["plan", str(tmp_path / "missing.png"), "-o", str(tmp_path / "out")])
        warnings.warn("divide by zero encountered in buffer", RuntimeWarning, stacklevel=1)
        assert told == []
        warnings.warn("divide by zero encountered in scalar divide", RuntimeWarning, stacklevel=1)
        assert len(told) == 1


HELPS = """
import contextlib, io, sys
from veduta.cli.main import VERBS, main
from veduta.cli.grammar import ACTIONS
calls = [[verb] for verb in VERBS] + [["grammar", action] for action in ACTIONS]
for call in calls:
    with contextlib.redirect_stdout(io.StringIO()) as said, contextlib.suppress(SystemExit):
        main([*call, "--help"])
    assert "usage" in said.getvalue().lower(), call
print(*sorted(sys.modules))
"""


def test_help_waits_for_nothing_that_does_the_work() -> None:
    """Of any verb: what works is brought after the arguments were read."""
    done = subprocess.run([sys.executable, "-c", HELPS], capture_output=True, text=True, check=True)
    brought = set(done.stdout.split())
    works = {"scipy", "pycolmap", "rasterio", "onnxruntime", "shapely", "pyproj", "laspy"}
    assert brought & works == set()
    assert not {f"veduta.{verb}.pipeline" for verb in cli.VERBS} & brought
