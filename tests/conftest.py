"""What all tests share: the real data's folder, and how far hypothesis may go."""

from __future__ import annotations

import os
import signal
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

ROOT = Path(__file__).resolve().parents[1]

# Two workers share two cores: a second thread of each for matrices only waits, and burns what the
# other one needs (an eighth of all processor time). It is said before NumPy is loaded.
if "PYTEST_XDIST_WORKER" in os.environ:
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

# No deadline: two cores are shared with compilers. In CI the same examples are drawn each time, so
# that a failure there is a failure everywhere.
_HEALTH = [HealthCheck.too_slow, HealthCheck.function_scoped_fixture]
settings.register_profile("local", deadline=None, max_examples=60, suppress_health_check=_HEALTH)
settings.register_profile(
    "ci", parent=settings.get_profile("local"), derandomize=True, database=None, print_blob=True
)
settings.load_profile("ci" if os.environ.get("CI") else "local")

# A shell ignores Ctrl-C in what it runs in the background, and what that starts inherits it; the
# programs that the tests interrupt must hear it.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(scope="session")
def repository() -> Path:
    """Return the root of the checkout."""
    return ROOT


@pytest.fixture(scope="session")
def veduta_data() -> Path:
    """Return the folder of real data, or skip the test: `$VEDUTA_DATA`, else `../shared/data`."""
    given = os.environ.get("VEDUTA_DATA")
    folder = Path(given) if given else ROOT.parent / "shared" / "data"
    if not folder.is_dir():
        pytest.skip(f"no real data in {folder}: set VEDUTA_DATA to the folder that has it")
    return folder
