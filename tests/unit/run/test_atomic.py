"""Files appear whole or not at all; keys change with all that a result depends on."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from veduta.run.atomic import atomic_folder, atomic_write, write_bytes
from veduta.run.digests import file_digest, result_key
from veduta.run.options import Options


def test_write(tmp_path: Path) -> None:
    path = tmp_path / "a.txt"
    write_bytes(path, b"one")
    write_bytes(path, b"two")
    assert path.read_bytes() == b"two"
    assert list(tmp_path.iterdir()) == [path]
    mask = os.umask(0)
    os.umask(mask)
    assert path.stat().st_mode & 0o777 == 0o666 & ~mask


def fail_in_write(path: Path) -> None:
    with atomic_write(path) as temporary:
        temporary.write_text("half")
        raise KeyboardInterrupt


def fail_in_folder(path: Path) -> None:
    with atomic_folder(path) as temporary:
        (temporary / "a").write_text("half")
        raise KeyboardInterrupt


def test_a_failed_write_leaves_the_old_file(tmp_path: Path) -> None:
    path = tmp_path / "a.txt"
    path.write_text("old")
    with pytest.raises(KeyboardInterrupt):
        fail_in_write(path)
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_folder(tmp_path: Path) -> None:
    path = tmp_path / "out"
    with pytest.raises(KeyboardInterrupt):
        fail_in_folder(path)
    assert list(tmp_path.iterdir()) == []
    with atomic_folder(path) as temporary:
        (temporary / "a").write_text("whole")
        assert not path.exists()
    assert (path / "a").read_text() == "whole"
    assert list(tmp_path.iterdir()) == [path]


class Depth(Options):
    """Options to make keys of."""

    depth_m: float = 10.0
    note: str = ""


def test_digest(tmp_path: Path) -> None:
    (tmp_path / "a").write_bytes(b"abc")
    # FIPS 180-2, appendix B.1
    assert file_digest(tmp_path / "a") == (
        "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"
    )


def test_keys_differ_where_results_may() -> None:
    keys = {
        result_key("facade", "1", Depth(), ["a", "b"]),
        result_key("facade", "1", Depth(), ["b", "a"]),
        result_key("facade", "1", Depth(), ["ab"]),
        result_key("facade", "1", Depth(depth_m=10.000001), ["a", "b"]),
        result_key("facade", "1", Depth(note="x"), ["a", "b"]),
        result_key("facade", "2", Depth(), ["a", "b"]),
        result_key("grammar", "1", Depth(), ["a", "b"]),
    }
    assert len(keys) == 7
    assert result_key("facade", "1", Depth(), ["a"]) == result_key("facade", "1", Depth(), ["a"])
