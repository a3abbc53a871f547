"""A worker process: it calls one function on each argument that it is sent.

A worker is an interpreter of its own, never a fork (native libraries have started threads by then).
It imports the function's module and nothing of the script that is running, which `multiprocessing`
would run again in each process if its author did not guard it. A worker whose parent is gone ends
itself.
"""

from __future__ import annotations

import importlib
import os
import signal
import subprocess
import sys
import threading
import traceback
from collections.abc import Callable, Sequence
from contextlib import suppress
from multiprocessing.connection import Connection, Pipe
from typing import Any, Generic, NamedTuple, TypeVar

from veduta.run.errors import NO_ROOM, UnwritableError, VedutaError
from veduta.run.quiet import quiet_libraries
from veduta.run.threads import share_cores

A = TypeVar("A")
T = TypeVar("T")


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


class Told(NamedTuple):
    """How far a call is that has not ended: the share from 0 to 1."""

    share: float


_asking: list[Connection] = []
"""In a worker: the way to the process that waits for its answer."""


def tell(share: float) -> None:
    """Say how far the call is to who listens by `limited(..., hear=...)`; else nothing is done."""
    for connection in _asking:
        connection.send(Told(share))


class Named(Generic[A, T]):
    """A function of a module's top level by its name; the module is imported where it is called."""

    def __init__(self, module: str, name: str) -> None:
        self.__module__, self.__qualname__ = module, name

    def __call__(self, argument: A) -> T:
        """Call the function."""
        function = getattr(importlib.import_module(self.__module__), self.__qualname__)
        value: T = function(argument)
        return value


class Worker:
    """A process that calls `function`, of a module's top level and no script's, by `threads`."""

    def __init__(self, function: Callable[[Any], Any], threads: int) -> None:
        self.pipe, theirs = Pipe()
        life, self._life = os.pipe()  # the worker sees its end when this process is gone
        ends = (theirs.fileno(), life)
        path = [*map(str, sys.path)]
        start = f"import sys; sys.path[:] = {path}; from {__name__} import work; work{ends}"
        # -P: of a library's name there may be a file in the folder that one stands in.
        self.process = subprocess.Popen(
            [sys.executable, "-P", "-c", start], pass_fds=ends, stdin=subprocess.DEVNULL
        )
        theirs.close()
        os.close(life)
        self.send((function.__module__, function.__qualname__, threads))

    def send(self, argument: Any) -> None:
        """Give it an argument; that it is dead is told by `receive`."""
        try:
            self.pipe.send(argument)
        except (BrokenPipeError, ConnectionResetError):
            return

    def receive(self) -> Answer:
        """Wait for its answer; the pipe of a dead one is at its end, perhaps within an answer."""
        said = self.hear()
        while isinstance(said, Told):
            said = self.hear()
        return said

    def hear(self) -> Answer | Told:
        """Wait for the next that it says: how far it is, or its answer."""
        try:
            answer: Answer | Told = self.pipe.recv()
        except (EOFError, OSError):
            return Answer(crash=_cause_of_death(self.process.wait()))
        return answer

    def begin_end(self) -> None:
        """Ask it to end at once, whatever it is at."""
        self.pipe.close()
        os.close(self._life)
        self.process.terminate()

    def end(self) -> None:
        """Wait for its end, and force it where it does not come."""
        try:
            self.process.wait(timeout=2)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()


def attempt(function: Callable[[Any], Any], argument: Any) -> Answer:
    """The value, or the error, or the traceback of an error that nobody expected."""
    try:
        return Answer(value=function(argument))
    except VedutaError as error:
        return Answer(error=error)
    except OSError as error:
        if error.errno not in NO_ROOM:
            return Answer(traceback=traceback.format_exc())
        return Answer(error=UnwritableError.of(error))
    except Exception:  # noqa: BLE001  a task's bug is the outcome; the caller tells it
        return Answer(traceback=traceback.format_exc())


def end_workers(workers: Sequence[Worker]) -> None:
    """End them at once, whatever they are at."""
    for worker in workers:
        worker.begin_end()
    for worker in workers:
        worker.end()


def work(pipe: int, life: int) -> None:
    """The life of a worker, of its ends: a task in, its result out, until the pipe closes."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C reaches all; the parent decides
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    threading.Thread(target=_end_with_parent, args=(life,), daemon=True).start()
    connection = Connection(pipe)
    module, name, threads = connection.recv()
    _asking.append(connection)
    quiet_libraries()
    share_cores(threads)  # before the import that loads the libraries
    function = getattr(importlib.import_module(module), name)
    # Who has no more to give, or is gone before there is an answer, ends this process's work.
    with suppress(EOFError, ConnectionError):
        while True:
            connection.send(attempt(function, connection.recv()))


def _end_with_parent(life: int) -> None:
    os.read(life, 1)
    os._exit(1)


def _cause_of_death(code: int) -> str:
    if code < 0:
        name = signal.Signals(-code).name
        memory = " (the system may have run out of memory)" if name == "SIGKILL" else ""
        return f"the worker process was ended by {name}{memory}"
    return f"the worker process ended with exit code {code}"
