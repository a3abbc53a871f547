"""Work in a second process, piece by piece, while this one goes on with other work."""

from __future__ import annotations

from collections.abc import Callable
from types import TracebackType
from typing import Generic, Self, TypeVar

from veduta.run.threads import available_cores
from veduta.run.worker import Worker, end_workers

A = TypeVar("A")
T = TypeVar("T")


class Beside(Generic[A, T]):
    """Calls `function` (of a module's top level) on what is given, where a core is free for it.

    The process starts at once, and imports what it needs while the argument is still made. A
    context manager: at its end the process is ended, whatever it is at. What a dead process, or
    an error in it, leaves undone is done in this process, so that errors are those of a plain call.
    """

    def __init__(self, function: Callable[[A], T]) -> None:
        self._function = function
        self._given: list[A] = []
        self._workers = [Worker(function, threads=1)] if available_cores() > 1 else []

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        end_workers(self._workers)

    def give(self, argument: A) -> None:
        """Begin the work on an argument; the argument must stay as it is until the work is done.

        What was given before has been taken: each of the two waits for the other otherwise.
        """
        self._given = [argument]
        for worker in self._workers:
            worker.send(argument)

    def take(self) -> T:
        """Wait for the work on the given argument, and return what it came to; once."""
        (argument,) = self._given
        self._given = []
        for worker in self._workers:
            answer = worker.receive()
            if answer.done:
                value: T = answer.value
                return value
        return self._function(argument)
