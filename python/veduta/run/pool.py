"""A few worker processes for independent tasks, on one machine.

Workers are spawned, never forked (native libraries have started threads by then), and the
cores are shared out among them. The number at work at once is also bounded by the memory that
the tasks say they need. A worker that dies takes only its own task
with it, which is named; a new worker takes its place. When the caller stops (Ctrl-C, an
exception), the workers are ended at once, and a worker whose parent is gone ends itself.

`concurrent.futures` is not used: when a worker dies it fails every task in hand without saying
which one was to blame, and it has no public way to end the workers that are busy.
"""

from __future__ import annotations

import importlib
import multiprocessing
import os
import signal
import threading
import traceback
from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from typing import Any, Generic, TypeVar

from veduta.run.errors import InputError, VedutaError
from veduta.run.report import Failure
from veduta.run.threads import share_cores

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
class _Worker:
    process: BaseProcess
    pipe: Connection
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
            yield Outcome(task, *_attempt(function, made(task.argument)))
        return
    budget = memory_budget - (jobs + 1) * WORKER_BASE  # this process is one more
    waiting = list(reversed(tasks))
    workers: list[_Worker] = []
    try:
        while waiting or any(worker.task for worker in workers):
            _hand_out(function, workers, waiting, jobs, budget, started, made)
            for worker, task in _ready(workers):
                yield _collect(worker, task, workers)
    finally:
        _end(workers)


def available_cores() -> int:
    """The cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def _hand_out(
    function: Callable[[Any], Any],
    workers: list[_Worker],
    waiting: list[Task],
    jobs: int,
    budget: int,
    started: Callable[[Task], None],
    made: Callable[[Any], Any],
) -> None:
    """Give the next tasks to idle workers, as far as the memory reaches (always to one)."""
    while waiting:
        in_hand = [worker.task for worker in workers if worker.task]
        used = sum(task.memory for task in in_hand)
        if in_hand and used + waiting[-1].memory > budget:
            return
        worker = next((worker for worker in workers if worker.task is None), None)
        if worker is None:
            if len(workers) == jobs:
                return
            worker = _start(function, threads=max(1, available_cores() // jobs))
            workers.append(worker)
        worker.task = waiting.pop()
        started(worker.task)
        try:
            worker.pipe.send(made(worker.task.argument))
        except (BrokenPipeError, ConnectionResetError):
            return  # the worker died before its task; `_collect` finds that out


def _start(function: Callable[[Any], Any], threads: int) -> _Worker:
    context = multiprocessing.get_context("spawn")
    ours, theirs = context.Pipe()
    arguments = (theirs, function.__module__, function.__qualname__, threads)
    process = context.Process(target=_work, args=arguments, daemon=True)
    process.start()
    theirs.close()
    return _Worker(process, ours)


def _ready(workers: list[_Worker]) -> list[tuple[_Worker, Task]]:
    """Wait until busy workers have answered or died; those, with the tasks they had."""
    busy = [(worker, worker.task) for worker in workers if worker.task]
    answered = wait([worker.pipe for worker, _ in busy])
    return [(worker, task) for worker, task in busy if worker.pipe in answered]


def _collect(worker: _Worker, task: Task, workers: list[_Worker]) -> Outcome[Any]:
    """A worker's answer; the pipe of a dead one is at its end."""
    worker.task = None
    try:
        return Outcome(task, *worker.pipe.recv())
    except (EOFError, ConnectionResetError):
        workers.remove(worker)
        worker.process.join()
        return Outcome(task, crash=_cause_of_death(worker.process.exitcode))


def _cause_of_death(code: int | None) -> str:
    if code is not None and code < 0:
        name = signal.Signals(-code).name
        memory = " (the system may have run out of memory)" if name == "SIGKILL" else ""
        return f"the worker process was ended by {name}{memory}"
    return f"the worker process ended with exit code {code}"


def _end(workers: list[_Worker]) -> None:
    for worker in workers:
        worker.pipe.close()
        worker.process.terminate()
    for worker in workers:
        worker.process.join(timeout=2)
        if worker.process.is_alive():
            worker.process.kill()
            worker.process.join()


def _work(pipe: Connection, module: str, name: str, threads: int) -> None:
    """The life of a worker: a task in, its result out, until the pipe closes."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C reaches all; the parent decides
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    threading.Thread(target=_end_with_parent, daemon=True).start()
    share_cores(threads)  # before the import that loads the libraries
    function = getattr(importlib.import_module(module), name)
    while True:
        try:
            argument = pipe.recv()
        except EOFError:
            return
        pipe.send(_attempt(function, argument))


def _end_with_parent() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


def _attempt(
    function: Callable[[Any], T], argument: Any
) -> tuple[T | None, VedutaError | None, str | None]:
    """The value, or the error, or the traceback of an error that nobody expected."""
    try:
        return function(argument), None, None
    except VedutaError as error:
        return None, error, None
    except Exception:  # noqa: BLE001  a task's bug is the outcome; the caller tells it
        return None, None, traceback.format_exc()
