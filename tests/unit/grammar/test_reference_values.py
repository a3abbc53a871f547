"""Every value that the reference prints beside its examples of functions comes out so."""

from __future__ import annotations

from pathlib import Path

import pytest
from reference_page import values_of
from reference_values import PAGES


@pytest.mark.parametrize("page", PAGES)
def test_values_are_those_of_the_reference(page: str, tmp_path: Path) -> None:
    definitions, examples = PAGES[page]
    found = values_of(definitions, [expression for expression, _ in examples], tmp_path)
    assert dict(zip([e for e, _ in examples], found, strict=True)) == dict(examples)


def test_a_wrong_value_is_noticed(tmp_path: Path) -> None:
    assert values_of("", ["1 + 1", '"a" + "b"'], tmp_path) == ["2", "ab"]
    assert values_of("", ["notThere(1)"], tmp_path) == [None]
