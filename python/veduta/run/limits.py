"""Readers of foreign formats in a process of their own, with limits of memory and time.

Some libraries take gigabytes, or hours, for a file of two kilobytes, and end the whole process when
there is no more memory. Here that ends a process that does nothing else, and the file is named.
Where a header says how much there is, that is checked before: pictures, whose headers tell all,
need no other process (`docs/files.md` says how each kind is read).
"""

from __future__ import annotations

import atexit
import importlib
import os
import resource
import threading
import time
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

from veduta.run.errors import InputError
from veduta.run.threads import available_cores
from veduta.run.worker import Answer, Told, Worker, end_workers

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
    folder: str
    """That the asking process stands in."""


class ReaderFault(RuntimeError):
    """A bug in a reader, with its traceback from the other process."""


def limited(
    function: Callable[[A], T],
    argument: A,
    subject: str | Path,
    remedy: str,
    limits: Limits | None = None,
    hear: Callable[[float], None] | None = None,
) -> T:
    """What a function of a module's top level gives for an argument, in a process of its own.

    Both must be such that they can be sent there. InputError of the function passes through; where
    it takes more memory or time, or ends the process, InputError names the subject. The process
    stays for the next call: to start one takes as long as to read a few files. `hear` is called
    with the share of the work that is done, as often as the function calls `run.worker.tell`; what
    it raises (Ctrl-C) ends the work.
    """
    allowed = limits or Limits()
    request = _Request(
        function.__module__, function.__qualname__, argument, allowed, str(Path.cwd())
    )
    with _one_at_a_time:
        value: T = _asked(request, subject, remedy, hear)
    return value


_one_at_a_time = threading.Lock()
_kept: dict[int, Worker] = {}
"""The process that reads, by the process that asks it: none is used by another's child."""


def _asked(
    request: _Request, subject: str | Path, remedy: str, hear: Callable[[float], None] | None
) -> Any:
    allowed = request.limits
    worker = _kept.pop(os.getpid(), None)
    if worker is None or worker.process.poll() is not None:
        worker = Worker(within, available_cores())
    try:
        worker.send(request)
        ends = time.monotonic() + 5 * allowed.seconds
        answer: Answer | Told = Told(0.0)
        while isinstance(answer, Told):
            if not worker.pipe.poll(max(0.0, ends - time.monotonic())):
                raise InputError(subject, f"takes more than {allowed.seconds} s to read", remedy)
            answer = worker.hear()
            if hear is not None and isinstance(answer, Told):
                hear(answer.share)
    except BaseException:  # also Ctrl-C: what it is at is not waited for
        end_workers([worker])
        raise
    if answer.crash is not None:
        end_workers([worker])
    else:
        _kept[os.getpid()] = worker
    return _value(answer, subject, remedy, allowed)


def end_readers() -> None:
    """End the process that waits for a next file; it ends by itself with the one that asks, too."""
    worker = _kept.pop(os.getpid(), None)
    if worker is not None:
        end_workers([worker])


atexit.register(end_readers)


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
    """Call the function of a request under its limits; in the process that reads one by one."""
    limits = request.limits
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    os.chdir(request.folder)
    function = getattr(importlib.import_module(request.module), request.name)
    used = resource.getrusage(resource.RUSAGE_SELF)
    _limit(resource.RLIMIT_DATA, _used_bytes() + limits.memory_mb * 1_000_000)
    _limit(resource.RLIMIT_CPU, int(used.ru_utime + used.ru_stime) + limits.seconds)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # libraries complain of files; that is the reader's
            return function(request.argument)
    finally:
        for kind in (resource.RLIMIT_DATA, resource.RLIMIT_CPU):
            _limit(kind, resource.getrlimit(kind)[1])


def _limit(kind: int, value: int) -> None:
    """The soft limit, which the next request changes; the hard one stays."""
    hard = resource.getrlimit(kind)[1]
    asked = value if hard == resource.RLIM_INFINITY or value == hard else min(value, hard)
    resource.setrlimit(kind, (asked, hard))


def _used_bytes() -> int:
    """What counts against the limit of data already."""
    for line in Path("/proc/self/status").read_text("ascii").splitlines():
        if line.startswith("VmData:"):
            return int(line.split()[1]) * 1024
    return 0
