"""Options that take one word of several: told as wrong numbers are."""

from __future__ import annotations

from pathlib import Path

import pytest

from veduta.cli.arguments import parse
from veduta.cli.choices import choice_options
from veduta.cli.grammar_call import DeriveCall
from veduta.run.errors import InputError


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("--up x", '--up: "x" is not among its values. Give y or z.'),
        ("--up=x", '--up: "x" is not among its values. Give y or z.'),
        ("--up", "--up: its value is missing. Give y or z."),
        ("--up --force", "--up: its value is missing. Give y or z."),
        ("--ground middle", '--ground: "middle" is not among its values. Give lowest or mean.'),
    ],
)
def test_a_word_that_is_no_choice(arguments: str, message: str) -> None:
    words = ["rules.cga", "-o", "out", *arguments.split()]
    with pytest.raises(InputError) as raised:
        parse(DeriveCall, "veduta grammar derive", words)
    assert str(raised.value) == message


def test_each_choice_is_taken() -> None:
    assert dict(choice_options(DeriveCall)) == {"--up": ["y", "z"], "--ground": ["lowest", "mean"]}
    for up in ("y", "z"):
        call = parse(DeriveCall, "veduta grammar derive", ["rules.cga", "-o", "out", "--up", up])
        assert (call.read.up, call.out) == (up, Path("out"))
