"""Scans on their way through a temporary file that has no room."""

from __future__ import annotations

import errno
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow
import pyarrow.parquet
import pytest

from veduta.drive.read import spool
from veduta.run.errors import UnwritableError


def test_a_full_disk_is_not_told_as_a_broken_table(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "scans.parquet"
    ranges = np.ones((20, 4), np.float32).tolist()
    pyarrow.parquet.write_table(
        pyarrow.table({"time_s": np.arange(20.0), "ranges_m": ranges}), path
    )

    class Full:
        def write(self, _: bytes) -> int:
            raise OSError(errno.ENOSPC, "No space left on device")

    def full(**_: Any) -> Full:
        return Full()

    assert len(spool.SpooledScans(path).times_s) == 20
    monkeypatch.setattr(spool.tempfile, "TemporaryFile", full)
    with pytest.raises(UnwritableError, match="No space left on device"):
        spool.SpooledScans(path)
