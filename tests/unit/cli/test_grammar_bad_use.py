"""Bad use of `veduta grammar sample`, `tree` and `derive`: told, and nothing is written."""

from __future__ import annotations

from pathlib import Path

import pytest

from veduta.cli.main import main

RULES = """
attr height = 50% : 6 else : 9
@StartRule
Lot --> extrude(height)
style Low
attr height = 2
"""
LOTS = """{"type": "Feature", "id": "house-1", "geometry": {"type": "Polygon",
"coordinates": [[[0, 0], [12, 0], [12, 9], [0, 9], [0, 0]]]}}"""


def bad_calls(folder: Path) -> dict[str, tuple[list[object], str]]:
    rules = folder / "house.cga"
    sheet, out = folder / "s.png", folder / "out"
    sample, shown = ["sample", rules], ["tree", rules]
    return {
        "no sheet": (sample, "-o"),
        "kind of sheet": ([*sample, "-o", folder / "s.gif"], "End it in .png"),
        "no samples": ([*sample, "-o", sheet, "-n", "0"], "is not from 1 to 64"),
        "colours": ([*sample, "-o", sheet, "--colours", "pretty"], "colours"),
        "folder": ([*sample, "-o", folder / "no" / "s.png", "-n", "1"], "cannot be written"),
        "rules": (["sample", folder / "bad.cga", "-o", sheet], "has faults"),
        "lot of the street": ([*shown, "--lot", "nort-1"], "Did you mean `north-1`"),
        "lot": ([*shown, "--lots", folder / "lots.geojson", "--lot", "hous-1"], "Did you mean"),
        "path": ([*shown, "--at", "0/1"], "is no path"),
        "shape": ([*shown, "--at", "/7/7"], "is no shape of this tree"),
        "depth": ([*shown, "--depth", "-1"], "is not from 0 to 1000"),
        "kind of drawing": ([*shown, "-o", folder / "t.pdf"], "End it in .svg, .txt"),
        "attribute": ([*shown, "--attr", "heigt=3"], "Did you mean `height`"),
        "style": ([*shown, "--style", "Lo"], "Did you mean `Low`"),
        "edits": ([*shown, "--edits", folder / "none.txt"], "does not exist"),
        "terrain without lots": (
            ["derive", rules, "-o", out, "--terrain", folder / "t.tif"],
            "Give --lots, too",
        ),
        "terrain": (
            ["derive", rules, "-o", out, "--lots", folder / "lots.geojson", "--terrain", rules],
            "is no GeoTIFF",
        ),
    }


NAMES = sorted(bad_calls(Path()))


@pytest.mark.parametrize("name", NAMES)
def test_bad_use_is_told(
    tmp_path: Path, name: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("signal.signal", lambda *_: None)
    (tmp_path / "house.cga").write_text(RULES)
    (tmp_path / "bad.cga").write_text("Lot --> extrud(3)")
    (tmp_path / "lots.geojson").write_text(LOTS)
    before = sorted(tmp_path.iterdir())
    arguments, told = bad_calls(tmp_path)[name]
    try:
        code = main(["grammar", *(str(word) for word in arguments)])
    except SystemExit as ended:
        code = int(str(ended.code))
    said = capsys.readouterr().err
    assert code == 2, said
    assert told in said
    assert "Traceback" not in said
    assert sorted(tmp_path.iterdir()) == before
