"""Readers of foreign formats in a process of their own, with limits of memory and time.

Some libraries take gigabytes, or hours, for a file of two kilobytes, and end the whole process when
there is no more memory. Here that ends a process that does nothing else, and the file is named.
"""

from __future__ import annotations

import importlib
import resource
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

from veduta.run.errors import InputError
from veduta.run.worker import Answer, Worker, end_workers

A = TypeVar("A")
T = TypeVar("T")


@dataclass(frozen=True)
class Limits:
    """What reading a file may cost.

    memory_mb: beyond what the process has when it begins (a page of 3,000 pixels and its pictures
    take a tenth of it). seconds: of one core; five times as long by the clock.
    """

    memory_mb: int = 2000
    seconds: int = 60


@dataclass(frozen=True)
class _Request:
    module: str
    name: str
    argument: Any
    limits: Limits


class ReaderFault(RuntimeError):
    """A bug in a reader, with its traceback from the other process."""


def limited(
    function: Callable[[A], T],
    argument: A,
    subject: str | Path,
    remedy: str,
    limits: Limits | None = None,
) -> T:
    """What a function of a module's top level gives for an argument, in a process of its own.

    Both must be such that they can be sent there. InputError of the function passes through; where
    it takes more memory or time, or ends the process, InputError names the subject.
    """
    allowed = limits or Limits()
    worker = Worker(within, 1)
    worker.send(_Request(function.__module__, function.__qualname__, argument, allowed))
    try:
        if not worker.pipe.poll(5 * allowed.seconds):
            raise InputError(subject, f"takes more than {allowed.seconds} s to read", remedy)
        answer = worker.receive()
    finally:
        end_workers([worker])
    value: T = _value(answer, subject, remedy, allowed)
    return value


def _value(answer: Answer, subject: str | Path, remedy: str, limits: Limits) -> Any:
    if answer.crash is not None:
        bounds = f"{limits.memory_mb} MB and {limits.seconds} s"
        fault = f"cannot be read within {bounds} ({answer.crash})"
        raise InputError(subject, fault, remedy)
    if answer.error is not None:
        raise answer.error
    if answer.traceback is not None:
        if "MemoryError" in answer.traceback.rsplit("\n", 2)[-2]:
            fault = f"takes more than {limits.memory_mb} MB of memory to read"
            raise InputError(subject, fault, remedy)
        raise ReaderFault(answer.traceback)
    return answer.value


def within(request: _Request) -> Any:
    """Call the function of a request under its limits; in the process that ends with it."""
    function = getattr(importlib.import_module(request.module), request.name)
    limits = request.limits
    memory = _used_bytes() + limits.memory_mb * 1_000_000
    resource.setrlimit(resource.RLIMIT_DATA, (memory, memory))
    used = resource.getrusage(resource.RUSAGE_SELF)
    seconds = int(used.ru_utime + used.ru_stime) + limits.seconds
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    return function(request.argument)


def _used_bytes() -> int:
    """What counts against the limit of data already."""
    for line in Path("/proc/self/status").read_text("ascii").splitlines():
        if line.startswith("VmData:"):
            return int(line.split()[1]) * 1024
    return 0
