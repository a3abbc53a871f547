"""`veduta dense` killed with SIGKILL: at most the depth map in hand is made again."""

from __future__ import annotations

import signal
from pathlib import Path

import pytest
from command_line import DEADLINE_S, running, wait_for
from stereo_scene import write_set

from veduta.cli.main import main
from veduta.dense import depths as steps


@pytest.mark.slow
@pytest.mark.parametrize("finished", [1, 4, 7])
def test_killed_in_the_middle(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, finished: int
) -> None:
    photos, out = write_set(tmp_path / "wall"), tmp_path / "out"
    stages = out / ".veduta" / "dense"
    call = ["dense", str(photos), "-o", str(out), "--quiet", "--no-mesh"]

    def planes() -> int:
        return len([*stages.glob("coarse-*"), *stages.glob("fine-*")])

    with running(*call) as run:
        wait_for(lambda: planes() >= finished)
        run.send_signal(signal.SIGKILL)
        run.communicate(timeout=DEADLINE_S)
    assert run.returncode == -signal.SIGKILL
    assert not (out / "place.json").exists()
    kept = planes()
    assert kept >= finished
    made: list[str] = []
    for name in ("match_coarse", "match_fine"):
        real = getattr(steps, name)

        def counted(*given: object, name: str = name, real=real) -> object:  # type: ignore[no-untyped-def]
            made.append(name)
            return real(*given)

        monkeypatch.setattr(steps, name, counted)
    assert main(call) == 0
    # Four photos, two each. What the kill met half written has a name of its own and is made again.
    assert len(made) in (8 - kept, 8 - kept + 1)
    assert (out / "place.json").is_file()
