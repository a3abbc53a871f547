"""Warnings of libraries that say nothing to whoever calls a verb."""

from __future__ import annotations

import warnings


def quiet_libraries() -> None:
    """Say nothing of what is right all the same; in this process, and in each that is begun."""
    # GEOS divides by zero where it mitres a corner that is none; what it gives is right.
    warnings.filterwarnings("ignore", ".* encountered in buffer", RuntimeWarning)
