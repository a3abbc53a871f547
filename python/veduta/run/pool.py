"""A few worker processes for independent tasks, on one machine.

The cores are shared out among the workers. The number at work at once is also bounded by the
memory that the tasks say they need. A worker that dies takes only its own task with it, which is
named; a new worker takes its place. When the caller stops (Ctrl-C, an exception), the workers are
ended at once.

`concurrent.futures` is not used: when a worker dies it fails every task in hand without saying
which one was to blame, and it has no public way to end the workers that are busy.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass
from multiprocessing.connection import wait
from typing import Any, Generic, TypeVar

from veduta.run.errors import InputError, VedutaError
from veduta.run.report import Failure
from veduta.run.threads import available_cores
from veduta.run.worker import Worker, attempt, end_workers

T = TypeVar("T")

MEMORY_BUDGET = 2 * 1024**3
"""Bytes that all workers together may use."""
WORKER_BASE = 120 * 1024**2
"""Bytes of a process before it holds any data (measured: 77 MiB with numpy, OpenCV and scipy)."""


@dataclass(frozen=True)
class Task:
    """One call of the pool's function; `memory` is what its data needs, in bytes."""

    name: str
    argument: Any
    memory: int = 0


@dataclass(frozen=True)
class Outcome(Generic[T]):
    """What became of a task: a value, an error of Veduta's own, a traceback, or a dead worker."""

    task: Task
    value: T | None = None
    error: VedutaError | None = None
    traceback: str | None = None
    crash: str | None = None

    def failure(self, subject: str) -> Failure:
        """What to tell of a task that ended without a value and without an error of Veduta's."""
        if self.traceback is not None:
            last = self.traceback.strip().splitlines()[-1]
            return Failure(subject=subject, kind="bug", reason=f"a bug in veduta: {last}")
        reason = self.crash or "the worker process gave no result"
        return Failure(subject=subject, kind="crash", reason=reason)


@dataclass
class _Hand:
    """A worker and the task that it is at."""

    worker: Worker
    task: Task | None = None


def require_jobs(jobs: int | None) -> None:
    """InputError for a number of processes that is none."""
    if jobs is not None and jobs < 1:
        raise InputError("--jobs", f"is {jobs}", "Give 1 or more.")


def run_tasks(
    function: Callable[[Any], T],
    tasks: Sequence[Task],
    *,
    jobs: int | None = None,
    memory_budget: int = MEMORY_BUDGET,
    started: Callable[[Task], None] = lambda task: None,
    made: Callable[[Any], Any] = lambda argument: argument,
) -> Generator[Outcome[T], None, None]:
    """Call `function` (of a module's top level) on each task's argument; yield as they end.

    `jobs` is the number of processes, as many as there are cores by default. With one job or
    one task the work is done in this process. `made` gives what the function is called with, of a
    task's argument: so that what is large is made, in this process, when the task's turn has come.
    """
    jobs = min(jobs or available_cores(), len(tasks), max(1, memory_budget // (2 * WORKER_BASE)))
    if jobs <= 1:
        for task in tasks:
            started(task)
            yield Outcome(task, *attempt(function, made(task.argument)))
        return
    budget = memory_budget - (jobs + 1) * WORKER_BASE  # this process is one more
    waiting = list(reversed(tasks))
    hands: list[_Hand] = []
    try:
        while waiting or any(hand.task for hand in hands):
            _hand_out(function, hands, waiting, jobs, budget, started, made)
            for hand, task in _ready(hands):
                yield _collect(hand, task, hands)
    finally:
        end_workers([hand.worker for hand in hands])


def _hand_out(
    function: Callable[[Any], Any],
    hands: list[_Hand],
    waiting: list[Task],
    jobs: int,
    budget: int,
    started: Callable[[Task], None],
    made: Callable[[Any], Any],
) -> None:
    """Give the next tasks to idle workers, as far as the memory reaches (always to one)."""
    while waiting:
        in_hand = [hand.task for hand in hands if hand.task]
        used = sum(task.memory for task in in_hand)
        if in_hand and used + waiting[-1].memory > budget:
            return
        hand = next((hand for hand in hands if hand.task is None), None)
        if hand is None:
            if len(hands) == jobs:
                return
            hand = _Hand(Worker(function, threads=max(1, available_cores() // jobs)))
            hands.append(hand)
        hand.task = waiting.pop()
        started(hand.task)
        hand.worker.send(made(hand.task.argument))


def _ready(hands: list[_Hand]) -> list[tuple[_Hand, Task]]:
    """Wait until busy workers have answered or died; those, with the tasks they had."""
    busy = [(hand, hand.task) for hand in hands if hand.task]
    answered = wait([hand.worker.pipe for hand, _ in busy])
    return [(hand, task) for hand, task in busy if hand.worker.pipe in answered]


def _collect(hand: _Hand, task: Task, hands: list[_Hand]) -> Outcome[Any]:
    """A worker's answer; a dead one is not asked again."""
    hand.task = None
    answer = hand.worker.receive()
    if answer.crash is not None:
        hands.remove(hand)
        end_workers([hand.worker])
    return Outcome(task, *answer)
