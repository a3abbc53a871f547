"""Rule files that failed when people who did not write the engine tried theirs: all derive now."""

from __future__ import annotations

from pathlib import Path

import pytest

from veduta.grammar.assets.library import Library
from veduta.grammar.project_files import project_files
from veduta.grammar.rules import check_rules, compile_rules, read_rules

pytestmark = pytest.mark.regression
LOT = [[(0.0, 0.0, 0.0), (14.0, 0.0, 0.0), (14.0, 12.0, 0.0), (0.0, 12.0, 0.0)]]


def test_every_case_derives_as_it_stands(veduta_data: Path) -> None:
    folder = veduta_data / "cases" / "grammar"
    if not folder.is_dir():
        pytest.skip(f"{folder} is not there")
    told = {}
    paths = [path for path in sorted(folder.rglob("*.cga")) if path.parent.name != "sub"]
    for path in paths:
        rules = read_rules(path)
        verdict = check_rules(rules)
        if verdict.errors:
            told[path.name] = verdict.told
            continue
        compiled = compile_rules(rules)
        Library(rules.search).add_written_to(compiled)
        project_files(rules.search, compiled).add_to(compiled)
        (house,) = compiled.derive([LOT], [0])
        if isinstance(house, str):
            told[path.name] = house
        elif len(house.positions_m) == 0 and len(house.instance_feature) == 0:
            told[path.name] = "nothing is left"
    assert told == {}
    assert len(paths) >= 20
