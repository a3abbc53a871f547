"""The process pool: results, errors, dead workers, memory bound, and its end."""

from __future__ import annotations

import errno
import os
import signal
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from veduta.run import pool
from veduta.run.errors import InputError, UnwritableError
from veduta.run.pool import Task, run_tasks
from veduta.run.worker import Worker


def square(number: int) -> tuple[int, int]:
    return number * number, os.getpid()


def fail(number: int) -> int:
    if number == 1:
        raise InputError("one", "is one", "Give two.")
    return 10 // number


def write(number: int) -> None:
    raise OSError(errno.ENOSPC if number else errno.EIO, "nothing goes there")


def die(number: int) -> int:
    if number == 2:
        os.kill(os.getpid(), signal.SIGKILL)
    return number


def slow(folder: str) -> int:
    time.sleep(0.05)
    running = Path(folder) / str(os.getpid())
    running.touch()
    together = len(list(Path(folder).iterdir()))
    time.sleep(0.1)
    running.unlink()
    return together


def sleep(seconds: float) -> None:
    time.sleep(seconds)


def threads(_: int) -> tuple[str, str]:
    return os.environ["RAYON_NUM_THREADS"], os.environ["OPENBLAS_NUM_THREADS"]


def tasks(values: list[int]) -> list[Task]:
    return [Task(str(value), value) for value in values]


def test_each_task_once_on_two_processes() -> None:
    outcomes = list(run_tasks(square, tasks(list(range(40))), jobs=2))
    values = [outcome.value for outcome in outcomes if outcome.value]
    assert sorted(value for value, _ in values) == [number**2 for number in range(40)]
    pids = {pid for _, pid in values}
    assert len(pids) == 2
    assert os.getpid() not in pids


def test_one_task_runs_here() -> None:
    (outcome,) = run_tasks(square, tasks([3]), jobs=2)
    assert outcome.value == (9, os.getpid())


@pytest.mark.parametrize("jobs", [1, 2])
def test_errors_come_back_with_their_task(jobs: int) -> None:
    outcomes = {o.task.name: o for o in run_tasks(fail, tasks([0, 1, 5]), jobs=jobs)}
    assert outcomes["5"].value == 2
    error = outcomes["1"].error
    assert isinstance(error, InputError)
    assert (error.subject, error.fault, error.remedy) == ("one", "is one", "Give two.")
    assert "ZeroDivisionError" in (outcomes["0"].traceback or "")


@pytest.mark.parametrize("jobs", [1, 2])
def test_a_full_disk_is_no_bug(jobs: int) -> None:
    outcomes = {o.task.name: o for o in run_tasks(write, tasks([0, 1]), jobs=jobs)}
    assert isinstance(outcomes["1"].error, UnwritableError)
    assert "nothing goes there" in str(outcomes["1"].error)
    assert "OSError" in (outcomes["0"].traceback or "")


def test_a_dead_worker_is_named_and_the_rest_go_on() -> None:
    outcomes = {o.task.name: o for o in run_tasks(die, tasks([0, 1, 2, 3, 4]), jobs=2)}
    assert "SIGKILL" in (outcomes["2"].crash or "")
    assert sorted(o.value for o in outcomes.values() if o.value is not None) == [0, 1, 3, 4]


@pytest.mark.parametrize(("memory", "most"), [(0, 2), (900 * 1024**2, 1)])
def test_memory_bounds_how_many_work_at_once(tmp_path: Path, memory: int, most: int) -> None:
    work = [Task(str(index), str(tmp_path), memory) for index in range(6)]
    together = [o.value for o in run_tasks(slow, work, jobs=2)]
    assert max(value for value in together if value) == most


def test_the_cores_are_shared_out() -> None:
    outcomes = list(run_tasks(threads, tasks([0, 1]), jobs=2))
    share = str(max(1, (os.cpu_count() or 1) // 2))
    assert {outcome.value for outcome in outcomes} == {(share, "1")}


def test_stopping_ends_the_workers(monkeypatch: pytest.MonkeyPatch) -> None:
    workers = list[Worker]()

    class Known(Worker):
        def __init__(self, function: Callable[[Any], Any], threads: int) -> None:
            super().__init__(function, threads)
            workers.append(self)

    monkeypatch.setattr(pool, "Worker", Known)
    outcomes = run_tasks(sleep, [Task("a", 0.0), Task("b", 60.0), Task("c", 60.0)], jobs=2)
    assert next(outcomes).task.name == "a"
    assert len(workers) == 2
    start = time.monotonic()
    outcomes.close()
    assert all(worker.process.returncode is not None for worker in workers)
    assert time.monotonic() - start < 5


@pytest.mark.parametrize("jobs", [1, 2])
def test_arguments_are_made_when_their_turn_comes(jobs: int) -> None:
    made: list[int] = []

    def make(number: int) -> int:
        made.append(number)
        return number + 100

    known = []
    for outcome in run_tasks(square, tasks(list(range(12))), jobs=jobs, made=make):
        assert outcome.value is not None
        known.append(outcome.value[0])
        assert len(made) <= len(known) + jobs
    assert sorted(known) == [(number + 100) ** 2 for number in range(12)]
    assert sorted(made) == list(range(12))
