"""What `veduta --licences` says."""

from __future__ import annotations

import pytest

from veduta.cli import licences as page
from veduta.cli.main import main


def test_every_package_is_named_with_its_licence(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--licences"]) == 0
    told = capsys.readouterr().out
    lines = {line.split(" ")[0].lower(): line for line in told.splitlines() if line}
    for name in ("numpy", "pyogrio", "ifcopenshell", "pydantic", "shapely"):
        assert name in lines
    assert "LGPL" in lines["ifcopenshell"]
    assert "pytest" not in lines
    assert "usd-core" not in lines  # of an extra
    if page.STUDIO.is_file():
        assert "three 0." in told
        assert "Permission is hereby granted" in told
