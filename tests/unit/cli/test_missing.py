"""What is missing is told in a line; what is on says with which word it is off."""

from __future__ import annotations

import pytest

from veduta.cli import main as cli


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["carve", "photos"], "error: -o OUT: was not given (folder for the results). Give it"),
        (["dense"], "error: CAMERAS: was not given (a result of `veduta photos`"),
        (["grammar", "derive", "haussmann"], "error: -o OUT: was not given"),
        (["export", "--force"], "error: OUT: was not given (folder with a place.json"),
    ],
)
def test_one_line_says_what_is_missing(
    words: list[str], told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.main(words) == 2
    said = capsys.readouterr().err
    assert said.startswith(told)
    assert said.count("\n") == 1
    assert f"`veduta {' '.join(words[: 2 if words[0] == 'grammar' else 1])} --help`" in said


@pytest.mark.parametrize(("verb", "option"), [("carve", "carve"), ("drive", "fill")])
def test_what_is_on_says_how_it_is_off(
    verb: str, option: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit):
        cli.main([verb, "--help"])
    told = " ".join(word for word in capsys.readouterr().out.split() if word != "│")
    assert f"(on unless --no-{option})" in told
    assert "default: True" not in told
