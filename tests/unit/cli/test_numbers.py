"""Numbers on the command line: one line says which option, what is wrong, and what to write."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

from veduta.cli.arguments import parse
from veduta.cli.demo_call import DemoCall
from veduta.cli.facade_call import FacadeCall
from veduta.cli.numbers import number_options, require_numbers
from veduta.facade.options import ScaleOptions
from veduta.run.errors import InputError
from veduta.studio.options import ViewOptions

CORNERS = (
    "Give eight numbers with spaces between them: "
    "x y of upper left, upper right, lower right, lower left."
)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("--storey-m 30", "--storey-m: 30 is out of range. Give a number from 2 to 8."),
        ("--storey-m 3,2", '--storey-m: "3,2" is not a number. Write 3.2, with a point.'),
        ("--storey_m=3,2", '--storey-m: "3,2" is not a number. Write 3.2, with a point.'),
        ("--storey-m 30,2", '--storey-m: "30,2" is not a number. Give a number from 2 to 8.'),
        ("--height-m tall", '--height-m: "tall" is not a number. Give a number from 2 to 1000.'),
        ("--height-m -3", "--height-m: -3 is out of range. Give a number from 2 to 1000."),
        ("--height-m nan", '--height-m: "nan" is not a number. Give a number from 2 to 1000.'),
        ("--height-m inf", '--height-m: "inf" is not a number. Give a number from 2 to 1000.'),
        ("--height-m --force", "--height-m: its value is missing. Give a number from 2 to 1000."),
        ("--corners 1,2,3,4", f'--corners: "1,2,3,4" is not eight numbers. {CORNERS}'),
        ("--corners 1,2 3,4 -q", f'--corners: "1,2 3,4" is not eight numbers. {CORNERS}'),
        ("--corners 1 2 3", f'--corners: "1 2 3" is not eight numbers. {CORNERS}'),
        (
            "--max-side-px 3.5",
            '--max-side-px: "3.5" is not a whole number. Give a whole number from 256 to 8000.',
        ),
        ("--jobs many", '--jobs: "many" is not a whole number. Give a whole number.'),
    ],
)
def test_bad_numbers_of_facade(arguments: str, message: str) -> None:
    words = ["photo.jpg", "-o", "out", *arguments.split()]
    with pytest.raises(InputError) as raised:
        parse(FacadeCall, "veduta facade", words)
    assert str(raised.value) == message


@pytest.mark.parametrize(
    ("call", "arguments", "remedy"),
    [
        (DemoCall, "--seed -1", "Give a whole number at least 0 and below 2147483648."),
        (ViewOptions, "out --port 99999", "Give a whole number from 0 to 65535."),
    ],
)
def test_other_verbs(call: type[Any], arguments: str, remedy: str) -> None:
    with pytest.raises(InputError) as raised:
        require_numbers(call, arguments.split())
    assert raised.value.remedy == remedy


def test_good_numbers_pass() -> None:
    words = "a.jpg -o out --corners 1 2.5 -3 4e1 5 6 7 8 --storey-m 3.2 --jobs 2 --setback-m=0"
    call = parse(FacadeCall, "veduta facade", words.split())
    assert call.rectify.corners == (1, 2.5, -3, 40, 5, 6, 7, 8)
    assert (call.scale.storey_m, call.jobs, call.model.setback_m) == (3.2, 2, 0.0)


def test_flags_with_the_name_of_a_number_elsewhere_pass() -> None:
    require_numbers(DemoCall, ["--corners", "--seed", "3"])


def test_every_number_of_a_verb_is_known() -> None:
    flags = {option.flag for option in number_options(FacadeCall)}
    numbers = "edge corners focal-mm35 max-side-px height-m storey-m width-m depth-m"
    numbers += " setback-m style-steps jobs"
    assert flags == {f"--{name}" for name in numbers.split()}


@given(st.floats(min_value=-20, max_value=20))
def test_ranges_are_those_of_the_options(value: float) -> None:
    """Pydantic is the oracle: what it refuses is refused before it, and nothing else."""

    def told() -> bool:
        try:
            require_numbers(ScaleOptions, ["--storey-m", repr(value)])
        except InputError:
            return True
        return False

    try:
        ScaleOptions(storey_m=value)
    except ValidationError:
        assert told()
    else:
        assert not told()
