"""Only ordinary files of a bounded size are opened."""

from __future__ import annotations

import os
import socket
from pathlib import Path

import pytest

from veduta.run.errors import InputError
from veduta.run.inputs import require_file


def test_files_up_to_the_bound(tmp_path: Path) -> None:
    path = tmp_path / "a"
    path.write_bytes(b"12345")
    (tmp_path / "link").symlink_to(path)
    for name in (path, tmp_path / "link"):
        require_file(name, 5)
        with pytest.raises(InputError, match="5e-06 MB large, more than 4e-06 MB") as caught:
            require_file(name, 4)
        assert caught.value.subject == str(name)


def test_a_large_file_is_not_read(tmp_path: Path) -> None:
    path = tmp_path / "large"
    path.touch()
    os.truncate(path, 3 * 10**12)  # a hole: nothing of it is on the disk
    with pytest.raises(InputError, match="is 3000 GB large, more than 1 GB"):
        require_file(path, 10**9)


def test_other_things_than_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "link").symlink_to(tmp_path / "pipe")
    monkeypatch.chdir(tmp_path)  # the name of a socket must be short
    with socket.socket(socket.AF_UNIX) as listener:
        listener.bind("socket")
    for name, kind in [
        (tmp_path / "pipe", "a pipe"),
        (tmp_path / "link", "a pipe"),
        (tmp_path / "socket", "a socket"),
        (tmp_path, "a folder"),
        (Path("/dev/zero"), "a device"),
    ]:
        with pytest.raises(InputError, match=f"is {kind}, not a file"):
            require_file(name, 10**9)


def test_what_is_not_there_is_left_to_the_caller(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        require_file(tmp_path / "none", 10)
