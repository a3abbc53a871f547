"""`veduta fauna` from midlines to a place, from its document again, and what it refuses."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from command_line import refused

from veduta.cli.main import main


@pytest.fixture(scope="module")
def midlines(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("record") / "eel.csv"
    rows = ["t,frame,point,x_mm,y_mm"]
    for frame in range(40):
        for point in range(20):
            x = 4.0 * frame - 8.0 * point
            y = (2.0 + 0.6 * point) * np.sin(0.35 * point - 0.5 * frame)
            rows.append(f"{0.02 * frame:.2f},{frame},{point},{x:.3f},{y:.3f}")
    path.write_text("\n".join(rows))
    return path


def test_midlines_become_a_place_and_the_document_builds_it_again(
    midlines: Path, tmp_path: Path
) -> None:
    out = tmp_path / "out"
    assert main(["fauna", str(midlines), "-o", str(out), "--kind", "fish", "--quiet"]) == 0
    place = json.loads((out / "place.json").read_text())
    assert [clip["name"] for clip in place["animals"][0]["clips"]] == ["swim", "roam", "footage"]
    report = json.loads((out / "report.json").read_text())
    assert report["state"] == "done"
    assert report["measures"]["wave_hz"] == pytest.approx(0.5 / 0.02 / (2 * np.pi), rel=0.03)
    document = json.loads((out / "animal.json").read_text())
    document["length"]["metres"] *= 2.0
    edited = tmp_path / "animal.json"
    edited.write_text(json.dumps(document))
    assert main(["fauna", str(edited), "-o", str(tmp_path / "again"), "--quiet"]) == 0
    again = json.loads((tmp_path / "again" / "place.json").read_text())
    assert again["animals"][0]["length"] == pytest.approx(2.0 * place["animals"][0]["length"])


def test_the_same_call_makes_the_same_bytes(midlines: Path, tmp_path: Path) -> None:
    for name in ("one", "two"):
        assert main(["fauna", str(midlines), "-o", str(tmp_path / name), "--quiet"]) == 0
    first, second = ((tmp_path / name / "animal.glb").read_bytes() for name in ("one", "two"))
    assert first == second


def test_what_is_no_footage_is_refused(tmp_path: Path) -> None:
    assert (
        "there is no such file"
        in refused("fauna", tmp_path / "none", "-o", tmp_path / "out").stderr
    )
