"""Showing how far long work has come: a bar on a terminal, plain lines elsewhere."""

from __future__ import annotations

from typing import Protocol


class StepProgress(Protocol):
    """What a step calls to say where it is; it may raise to stop the work (Ctrl-C)."""

    def __call__(self, step: str, fraction: float) -> None:
        """`step` has come to `fraction` (0..1) of its work."""


def no_progress(step: str, fraction: float) -> None:
    """Say nothing."""
