"""`veduta carve` killed with SIGKILL: silhouettes and turns that were found are kept."""

from __future__ import annotations

import signal
from pathlib import Path

import cv2
import numpy as np
import pytest
from command_line import DEADLINE_S, running, wait_for
from turned_object import silhouettes

from veduta.carve import turned
from veduta.carve.read import views
from veduta.carve.read.turning import Table
from veduta.cli.main import main


@pytest.mark.slow
@pytest.mark.parametrize("stage", ["silhouettes", "turns"])
def test_killed_after_a_stage(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, stage: str) -> None:
    folder, out = tmp_path / "piece", tmp_path / "out"
    folder.mkdir()
    table = Table(450.0, 0.35, 0.0, 0.0, np.linspace(0.0, 2.0 * np.pi, 13)[:-1])
    for number, mask in enumerate(silhouettes(table, (320, 240))):
        photo = np.where(mask[..., None], (60, 120, 200), 15).astype(np.uint8)
        cv2.imwrite(str(folder / f"turn{number:02d}.png"), photo)
    call = ["carve", str(folder), "-o", str(out), "--turntable", "--levels", "6", "--quiet"]
    with running(*call) as run:
        wait_for(lambda: any((out / ".veduta" / "carve").glob(f"{stage}-*")))
        run.send_signal(signal.SIGKILL)
        run.communicate(timeout=DEADLINE_S)
    assert run.returncode == -signal.SIGKILL
    assert not (out / "object.glb").exists()

    def again(*given: object, **named: object) -> None:
        raise AssertionError(f"made again: {given} {named}")

    monkeypatch.setattr(views, "masks_of_background", again)
    if stage == "turns":
        monkeypatch.setattr(turned, "find_turns", again)
    assert main(call) == 0
    assert (out / "object.glb").is_file()
