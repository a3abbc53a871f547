"""What the parser makes of options that need not be given, and what the help says of them."""

from __future__ import annotations

import importlib
from pathlib import Path

import pytest

from veduta.cli import main as cli
from veduta.cli.arguments import parse
from veduta.cli.export_call import ExportCall
from veduta.cli.facade_call import FacadeCall

# The help of `grammar` itself is a text: its options are those of its actions.
CALLS = [verb for verb in cli.VERBS if verb != "grammar"]


@pytest.mark.parametrize("call", [*CALLS, "grammar check", "grammar format", "grammar derive"])
def test_help_shows_what_an_option_takes(call: str, capsys: pytest.CaptureFixture[str]) -> None:
    """And nothing of Python's None, which nobody can type."""
    verb, *action = call.split()
    with pytest.raises(SystemExit) as ended:
        importlib.import_module(f"veduta.cli.{verb}").run([*action, "--help"])
    assert ended.value.code == 0
    text = capsys.readouterr().out
    assert f"usage: veduta {call}" in text
    assert "None" not in text


def test_metavars(capsys: pytest.CaptureFixture[str]) -> None:
    for call, said in ((ExportCall, "--web PATH"), (FacadeCall, "--height-m FLOAT")):
        with pytest.raises(SystemExit):
            parse(call, "veduta", ["--help"])
        assert said in capsys.readouterr().out


def test_values_are_read_as_their_type() -> None:
    export = parse(ExportCall, "veduta export", ["place", "--web", "None"])
    assert export.web == Path("None")
    assert parse(ExportCall, "veduta export", ["place"]).web is None
    assert parse(ExportCall, "veduta export", ["place", "x.obj"]).file == Path("x.obj")
    words = ["a.jpg", "-o", "x", "--height-m", "12", "--jobs", "3"]
    facade = parse(FacadeCall, "veduta facade", words)
    assert facade.scale.height_m == 12.0
    assert (facade.jobs, facade.scale.storey_m) == (3, None)
