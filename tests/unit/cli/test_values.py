"""Values that break a rule of their model: told in the rule's words, without the parser's."""

from __future__ import annotations

import pytest

from veduta.cli.arguments import parse
from veduta.cli.plan_call import PlanCall
from veduta.run.errors import InputError


@pytest.mark.parametrize(
    ("arguments", "option", "fault"),
    [
        ("--place 151 0", "--place", "151 is no latitude: it goes from -90 to 90"),
        ("--place 0 -200", "--place", "-200 is no longitude"),
        ("--time 4pm", "--time", "'4pm' is no date with a time"),
        ("--time=2026-06-21", "--time", "'2026-06-21' has no time of day"),
        ("--pages 5-2", "--pages", "5-2 runs backwards"),
    ],
)
def test_a_value_that_breaks_a_rule(arguments: str, option: str, fault: str) -> None:
    with pytest.raises(InputError) as raised:
        parse(PlanCall, "veduta plan", ["plan.png", "-o", "out", *arguments.split()])
    assert raised.value.subject == option
    assert raised.value.fault.startswith(fault)
    assert raised.value.remedy.startswith("It is ")


def test_values_that_keep_the_rules_pass() -> None:
    given = {"--place": ["51.5", "-0.1"], "--time": ["2026-06-21T15:00"], "--pages": ["2-3,5"]}
    words = ["plan.png", "-o", "out", *(word for one in given for word in (one, *given[one]))]
    call = parse(PlanCall, "veduta plan", words)
    assert call.site.place == (51.5, -0.1)
    assert call.site.time == "2026-06-21T15:00"
    assert call.input.pages == "2-3,5"
