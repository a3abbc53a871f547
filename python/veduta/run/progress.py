"""Showing how far long work has come: a bar on a terminal, plain lines elsewhere."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Protocol

from veduta.run.pool import Task
from veduta.run.report import Failure

if TYPE_CHECKING:
    from rich.progress import Progress as Bar

LINE_EVERY_S = 10.0
"""Where there is no terminal, a single item says so often (s) how far it has come."""


class StepProgress(Protocol):
    """What a step calls to say where it is; it may raise to stop the work (Ctrl-C)."""

    def __call__(self, step: str, fraction: float) -> None:
        """`step` has come to `fraction` (0..1) of its work."""


def no_progress(step: str, fraction: float) -> None:
    """Say nothing."""


class Progress:
    """How far a call with several items has come; written to standard error."""

    def __init__(self, *, quiet: bool = False) -> None:
        self._quiet = quiet
        self._bar: Bar | None = None
        self._in_hand: list[str] = []
        self._total = 0
        self._done = 0
        self._steps: list[str] = []
        self._said_at = 0.0

    @contextmanager
    def over(self, total: int, steps: int | None = None) -> Iterator[None]:
        """Show the progress of `total` items while the block runs.

        steps: of one item, if it is the only one; how far it has come is how many of them are done.
        """
        self._total, self._done, self._steps = total, 0, []
        self._said_at = time.monotonic()
        if self._quiet or not _is_terminal():
            yield
            return
        self._bar = _bar(counts=total != 1)
        try:
            with self._bar:
                self._bar.add_task("", total=steps if total == 1 else total)
                yield
        finally:
            self._bar = None

    def said(self, text: str) -> None:
        """A line about work that is no item of a call."""
        if not self._quiet:
            sys.stderr.write(f"{text}\n")
            sys.stderr.flush()

    def started(self, task: Task) -> None:
        """A process has taken an item in hand."""
        self._in_hand.append(task.name)
        self._show()

    def step(self, step: str, fraction: float) -> None:
        """The only item in hand has come to this share of a step."""
        if self._total == 1:
            if [step] != self._steps[-1:]:
                self._steps.append(step)
            if self._bar is not None:
                done = len(self._steps) - 1 + fraction
                self._bar.update(self._bar.task_ids[0], completed=done)
            elif time.monotonic() - self._said_at >= LINE_EVERY_S:
                self._said_at = time.monotonic()
                names = ", ".join(self._in_hand)
                told = f"{step} {fraction:.0%}" if fraction > 0.0 else step
                self.said(f"{names}: {told}" if names else told)
        self._show(f"{step} {fraction:.0%}" if fraction > 0.0 else step)

    def finished(self, name: str, failure: Failure | None) -> None:
        """An item is done, or has failed."""
        self._done += 1
        if name in self._in_hand:
            self._in_hand.remove(name)
        if self._bar is not None:
            if self._total != 1:
                self._bar.advance(self._bar.task_ids[0])
        elif not self._quiet and self._total > 1:
            state = "failed" if failure else "done"
            sys.stderr.write(f"[{self._done}/{self._total}] {name}: {state}\n")
            sys.stderr.flush()
        self._show()

    def _show(self, step: str = "") -> None:
        if self._bar is not None:
            names = ", ".join(self._in_hand)
            text = f"{names}: {step}" if step else names
            self._bar.update(self._bar.task_ids[0], description=text)


def _is_terminal() -> bool:
    """Whether a bar can be drawn there, or is asked for all the same."""
    # None where it was closed, or under some services.
    shown = sys.stderr is not None and sys.stderr.isatty()
    return shown or bool(os.environ.get("FORCE_COLOR"))


def _bar(*, counts: bool) -> Bar:
    """A bar at the foot of the terminal; counts: how many of the items are done, too."""
    # Loaded where it is used: most calls have no terminal, or are over before it would be read.
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, TextColumn, TimeElapsedColumn
    from rich.progress import Progress as Bar

    count = (MofNCompleteColumn(),) if counts else ()
    text = TextColumn("{task.description}", markup=False)
    columns = (BarColumn(24), *count, TimeElapsedColumn(), text)
    console = Console(stderr=True, highlight=False)
    return Bar(*columns, console=console, transient=True)
