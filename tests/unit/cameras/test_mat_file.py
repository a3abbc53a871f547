"""MATLAB files as scipy reads them, and damaged ones that end in a message."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import scipy.io

from veduta.cameras.mat_file import DamagedError, parse_mat


@pytest.mark.parametrize("packed", [False, True])
def test_what_scipy_reads(packed: bool, tmp_path: Path) -> None:
    path = tmp_path / "a.mat"
    cells = np.empty((1, 2), dtype=object)
    cells[0, 0], cells[0, 1] = np.arange(12.0).reshape(3, 4), np.array([[7]], dtype=np.uint8)
    given = {
        "P": cells,
        "U": np.arange(24.0).reshape(2, 3, 4),
        "word": "a name",
        "s": {"points": np.eye(3), "index": np.array([[1, 2]], dtype=np.int32)},
    }
    scipy.io.savemat(path, given, do_compression=packed)
    found, known = parse_mat(path.read_bytes()), scipy.io.loadmat(path)
    np.testing.assert_array_equal(found["U"], known["U"])
    for number in range(2):
        np.testing.assert_array_equal(found["P"][0, number], known["P"][0, number])
    assert found["word"][0] == known["word"][0]
    assert found["s"].dtype.names == known["s"].dtype.names
    np.testing.assert_array_equal(found["s"]["points"][0, 0], np.eye(3))


def test_damage_is_told(tmp_path: Path) -> None:
    path = tmp_path / "a.mat"
    cells = np.empty((1, 3), dtype=object)
    cells[:] = [[np.eye(3, 4)] * 3]
    scipy.io.savemat(path, {"P": cells, "U": np.ones((4, 5))})
    whole = path.read_bytes()
    rng = np.random.default_rng(0)
    told = 0
    for _ in range(400):
        data = bytearray(whole)
        for place in rng.integers(128, len(data), 3):
            data[place] = rng.integers(256)
        try:
            parse_mat(bytes(data[: rng.integers(100, len(data) + 1)]))
        except DamagedError:
            told += 1
    assert told > 100
    with pytest.raises(DamagedError, match="head"):
        parse_mat(b"nothing")
