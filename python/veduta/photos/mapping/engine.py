"""The engine of structure from motion (pycolmap): what is the same wherever it is called."""

from __future__ import annotations

import signal
import threading

import pycolmap

NAME = "pycolmap"


def quiet_engine() -> None:
    """Keep its log off standard error: what matters is in our report, in plain words."""
    pycolmap.logging.minloglevel = int(pycolmap.logging.Level.ERROR)
    pycolmap.logging.stderrthreshold = int(pycolmap.logging.Level.ERROR)


def engine_version() -> str:
    """The version, for the report."""
    return str(pycolmap.__version__)


def _keep_own_ending() -> None:
    """Put our handler of SIGTERM back: loading the engine puts one there that prints a trace.

    Python still knows ours, and sets it anew when it is asked to; only its main thread may.
    """
    handler = signal.getsignal(signal.SIGTERM)
    if handler is not None and threading.current_thread() is threading.main_thread():
        signal.signal(signal.SIGTERM, handler)


_keep_own_ending()
