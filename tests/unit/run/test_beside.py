"""Work in a second process: its value, its errors, its death, one core, and its end."""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Callable
from typing import Any

import pytest

from veduta.run import beside
from veduta.run.beside import Beside
from veduta.run.errors import InputError
from veduta.run.worker import Named, Worker


def square(number: int) -> tuple[int, int]:
    return number * number, os.getpid()


def refuse(number: int) -> int:
    raise InputError(str(number), "is a number", "Give none.")


def break_down(number: int) -> float:
    return number / 0


def die_alone(parent: int) -> int:
    """Its process's number; a process that is not the given one kills itself."""
    if os.getpid() != parent:
        os.kill(os.getpid(), signal.SIGKILL)
    return os.getpid()


def sleep(seconds: float) -> None:
    time.sleep(seconds)


@pytest.fixture(autouse=True)
def two_cores(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(beside, "available_cores", lambda: 2)


def test_each_value_comes_from_one_other_process() -> None:
    with Beside(square) as work:
        found = []
        for number in (3, 4):
            work.give(number)
            found.append(work.take())
    assert [value for value, _ in found] == [9, 16]
    (process,) = {process for _, process in found}
    assert process != os.getpid()


def test_a_function_may_be_given_by_its_name() -> None:
    with Beside(Named[int, tuple[int, int]](__name__, "square")) as work:
        work.give(3)
        value, process = work.take()
    assert value == 9
    assert process != os.getpid()
    assert Named[int, tuple[int, int]](__name__, "square")(4) == (16, os.getpid())


def test_with_one_core_it_is_done_in_this_process(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(beside, "available_cores", lambda: 1)
    with Beside(square) as work:
        work.give(3)
        assert work.take() == (9, os.getpid())


def test_what_a_dead_process_leaves_is_done_in_this_one() -> None:
    with Beside(die_alone) as work:
        work.give(os.getpid())
        assert work.take() == os.getpid()


def test_an_answer_that_breaks_off_is_that_of_a_dead_process(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    class Broken:
        def recv(self) -> None:
            raise OSError("got end of file during message")

        def close(self) -> None:
            pass

    with Beside(square) as work:
        work.give(3)
        (worker,) = work._workers
        worker.process.kill()
        monkeypatch.setattr(worker, "pipe", Broken())
        assert work.take() == (9, os.getpid())


def test_errors_are_those_of_a_plain_call() -> None:
    with Beside(refuse) as work:
        work.give(7)
        with pytest.raises(InputError, match="7: is a number"):
            work.take()
    with Beside(break_down) as other:
        other.give(7)
        with pytest.raises(ZeroDivisionError):
            other.take()


def test_an_error_meanwhile_ends_the_process(monkeypatch: pytest.MonkeyPatch) -> None:
    workers = list[Worker]()

    def known(function: Callable[[Any], Any], threads: int) -> Worker:
        workers.append(Worker(function, threads))
        return workers[-1]

    monkeypatch.setattr(beside, "Worker", known)
    start = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        _stopped_meanwhile()
    (worker,) = workers
    assert worker.process.returncode is not None
    assert time.monotonic() - start < 30.0


def _stopped_meanwhile() -> None:
    with Beside(sleep) as work:
        work.give(60.0)
        raise KeyboardInterrupt
