"""The published schemas take what the readers take, and refuse what they refuse."""

from __future__ import annotations

import copy
import json
import tomllib
from pathlib import Path
from typing import Any

import pytest
from json_schema import faults
from pydantic import ValidationError

from veduta.drive.document.log import DriveLog

SCHEMA = Path(__file__).parents[3] / "docs/schemas/drive-toml.schema.json"
PAGE = Path(__file__).parents[3] / "docs/drive.md"


def blocks() -> list[dict[str, Any]]:
    """Each whole example of docs/drive.md."""
    told = PAGE.read_text("utf-8").split("```toml\n")[1:]
    return [tomllib.loads(one.split("```")[0]) for one in told]


def valid(log: dict[str, Any]) -> bool:
    schema = json.loads(SCHEMA.read_text("utf-8"))
    return not faults(log, schema)


@pytest.mark.parametrize("number", range(4))
def test_examples_of_the_docs_are_valid(number: int) -> None:
    log = blocks()[number]
    DriveLog.model_validate(log)
    assert valid(log)


@pytest.mark.parametrize(
    ("path", "value"),
    [
        (("vertical", "beam_step_rad"), -0.1),
        (("vertical", "vehicle_from_scanner"), [0.0] * 11),
        (("vertical", "table"), "/etc/passwd"),
        (("vertical", "bemas"), 3),
        (("camera", "width_px"), 0),
        (("camera", "focal_px"), [500.0]),
        (("origin",), [0.0, 0.0]),
        (("name",), 3),
    ],
)
def test_what_the_reader_refuses_the_schema_refuses(path: tuple[str, ...], value: object) -> None:
    log = copy.deepcopy(blocks()[0])
    at: Any = log
    for key in path[:-1]:
        at = at[key]
    at[path[-1]] = value
    with pytest.raises(ValidationError):
        DriveLog.model_validate(log)
    assert not valid(log)
