"""A worker process: it calls one function on each argument that it is sent.

Workers are spawned, never forked (native libraries have started threads by then). A worker whose
parent is gone ends itself.
"""

from __future__ import annotations

import importlib
import multiprocessing
import os
import signal
import threading
import traceback
from collections.abc import Callable, Iterable
from multiprocessing.connection import Connection
from typing import Any, NamedTuple

from veduta.run.errors import VedutaError
from veduta.run.threads import share_cores


class Answer(NamedTuple):
    """What a call came to: a value, an error of Veduta's own, a traceback, or a dead worker."""

    value: Any = None
    error: VedutaError | None = None
    traceback: str | None = None
    crash: str | None = None

    @property
    def done(self) -> bool:
        """Whether there is a value."""
        return self.error is None and self.traceback is None and self.crash is None


class Worker:
    """A process that calls `function` (of a module's top level), by `threads` threads."""

    def __init__(self, function: Callable[[Any], Any], threads: int) -> None:
        context = multiprocessing.get_context("spawn")
        self.pipe, theirs = context.Pipe()
        arguments = (theirs, function.__module__, function.__qualname__, threads)
        self.process = context.Process(target=_work, args=arguments, daemon=True)
        self.process.start()
        theirs.close()

    def send(self, argument: Any) -> None:
        """Give it an argument; that it is dead is told by `receive`."""
        try:
            self.pipe.send(argument)
        except (BrokenPipeError, ConnectionResetError):
            return

    def receive(self) -> Answer:
        """Wait for its answer; the pipe of a dead one is at its end."""
        try:
            answer: Answer = self.pipe.recv()
        except (EOFError, ConnectionResetError):
            self.process.join()
            return Answer(crash=_cause_of_death(self.process.exitcode))
        return answer


def attempt(function: Callable[[Any], Any], argument: Any) -> Answer:
    """The value, or the error, or the traceback of an error that nobody expected."""
    try:
        return Answer(value=function(argument))
    except VedutaError as error:
        return Answer(error=error)
    except Exception:  # noqa: BLE001  a task's bug is the outcome; the caller tells it
        return Answer(traceback=traceback.format_exc())


def end_workers(workers: Iterable[Worker]) -> None:
    """End them at once, whatever they are at."""
    for worker in workers:
        worker.pipe.close()
        worker.process.terminate()
    for worker in workers:
        worker.process.join(timeout=2)
        if worker.process.is_alive():
            worker.process.kill()
            worker.process.join()


def _cause_of_death(code: int | None) -> str:
    if code is not None and code < 0:
        name = signal.Signals(-code).name
        memory = " (the system may have run out of memory)" if name == "SIGKILL" else ""
        return f"the worker process was ended by {name}{memory}"
    return f"the worker process ended with exit code {code}"


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
        pipe.send(attempt(function, argument))


def _end_with_parent() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
