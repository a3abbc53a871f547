"""How many threads native libraries use; to be said before they are loaded."""

from __future__ import annotations

import os

_THREADS_OF = ("RAYON_NUM_THREADS", "OMP_NUM_THREADS", "OPENCV_FOR_THREADS_NUM")
_ONE_THREAD_OF = ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "VECLIB_MAXIMUM_THREADS")


def same_sums_anywhere() -> None:
    """Matrix products on one thread: on several they sum in another order, to other last digits."""
    os.environ.update(dict.fromkeys(_ONE_THREAD_OF, "1"))


def share_cores(threads: int) -> None:
    """At most this many threads in each library, in this process."""
    os.environ.update(dict.fromkeys(_THREADS_OF, str(threads)))
    same_sums_anywhere()


def available_cores() -> int:
    """The cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
