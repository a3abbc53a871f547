"""The demo's film of an animal: whole or not there."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

from veduta.fauna import demo
from veduta.fauna.path.given import read_path
from veduta.run.errors import UnwritableError
from veduta.run.progress import Progress
from veduta.synthetic.animals import Filmed


@pytest.fixture
def filmed(monkeypatch: pytest.MonkeyPatch) -> list[Path]:
    """Films that `veduta fauna` was asked to read; each has four frames."""
    asked: list[Path] = []
    frames = np.arange(4 * 6 * 8 * 3, dtype=np.uint8).reshape(4, 6, 8, 3)

    def film(*_: object, **__: object) -> Any:
        film = Filmed.__new__(Filmed)
        object.__setattr__(film, "frames", frames)
        return film

    def run(record: Any, *_: object, **__: object) -> None:
        asked.append(record.path)

    monkeypatch.setattr(demo, "film_quadruped", film)
    monkeypatch.setattr(demo, "run_fauna", run)
    return asked


def test_a_film_that_was_broken_off_is_made_again(
    tmp_path: Path, filmed: list[Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    encode, done = cv2.imencode, 0

    def killed(*given: Any) -> Any:
        nonlocal done
        done += 1
        if done == 3:
            raise KeyboardInterrupt
        return encode(*given)

    with monkeypatch.context() as patch:
        patch.setattr(cv2, "imencode", killed)
        with pytest.raises(KeyboardInterrupt):
            demo.run_demo_animal(tmp_path, Progress(quiet=True), force=False)
    assert not (tmp_path / "film").exists()
    demo.run_demo_animal(tmp_path, Progress(quiet=True), force=False)
    assert [one.name for one in sorted(filmed[0].iterdir())] == [f"{n:03d}.png" for n in range(4)]
    way = read_path(tmp_path / demo.WAY)
    assert (way[:, 1] < -2.0).all()  # before the fronts, which are at y = 0
    assert (way[2] - way[1]) @ (way[1] - way[0]) < 0.0  # there, and back again


def test_a_frame_that_cannot_be_written_is_no_film(
    tmp_path: Path, filmed: list[Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(cv2, "imencode", lambda *_: (False, None))
    with pytest.raises(UnwritableError, match="frame 0"):
        demo.run_demo_animal(tmp_path, Progress(quiet=True), force=False)
    assert not filmed
    assert not (tmp_path / "film").exists()


def test_force_films_again(tmp_path: Path, filmed: list[Path]) -> None:
    film = tmp_path / "film"
    film.mkdir()
    (film / "900.png").write_bytes(b"old")
    demo.run_demo_animal(tmp_path, Progress(quiet=True), force=False)
    assert (film / "900.png").exists()
    demo.run_demo_animal(tmp_path, Progress(quiet=True), force=True)
    assert len(list(film.iterdir())) == 4
    assert len(filmed) == 2
