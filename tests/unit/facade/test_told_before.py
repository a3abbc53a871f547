"""What a call says or refuses before it begins to read a photo."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from veduta.facade import batch
from veduta.facade.options import FacadeOptions, StyleOptions
from veduta.facade.style_told import search_note
from veduta.run.errors import InputError
from veduta.run.outputs import open_out
from veduta.run.progress import Progress


class ReadAnyhowError(Exception):
    """Somebody began to read a photo."""


def reads(*_: Any, **__: Any) -> None:
    raise ReadAnyhowError


def photo(path: Path) -> Path:
    Image.fromarray(np.full((90, 80, 3), 120, np.uint8)).save(path)
    return path


@pytest.mark.parametrize("command", ["facade", "plan"])
def test_an_out_of_other_inputs_is_refused_before_anything_is_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, command: str
) -> None:
    out = tmp_path / "out"
    with open_out(out, command, "another") as folder:
        work = folder.work_folder("house")
        (work / "facade.json").write_text("{}", encoding="utf-8")
        folder.publish("house", "another", work)
        folder.finish()
    for name in ("run_tasks", "run_job", "_process"):
        monkeypatch.setattr(batch, name, reads)
    with pytest.raises(InputError, match="--force"):
        batch.run_call([photo(tmp_path / "b.png")], out, FacadeOptions(), Progress(quiet=True))


def test_a_search_says_beforehand_how_long_it_takes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(batch, "_process", reads)
    options = FacadeOptions(style=StyleOptions(style="auto"))
    with pytest.raises(ReadAnyhowError):
        batch.run_call([photo(tmp_path / "a.png")], tmp_path / "out", options, Progress())
    assert search_note(options.style, 1) in capsys.readouterr().err


def test_the_note_of_a_search_names_what_is_faster_where_that_is() -> None:
    usual, few = StyleOptions(style="auto"), StyleOptions(style="auto", style_steps=30)
    assert "--style-steps 60 is faster" in search_note(usual, 1)
    assert "is faster" not in search_note(few, 1)
    assert "for each of 3 photos" in search_note(usual, 3)
    assert "haussmann is searched" in search_note(StyleOptions(style="haussmann"), 1)
