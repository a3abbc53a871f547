"""Readers that go wrong in all the ways that a hostile file can make them, for `test_limits`."""

from __future__ import annotations

import os

from veduta.run.errors import InputError
from veduta.run.worker import tell


def reader_and_folder(_: object) -> tuple[int, str]:
    return os.getpid(), os.getcwd()


def doubled(number: int) -> int:
    return 2 * number


def telling(shares: list[float]) -> int:
    for share in shares:
        tell(share)
    return len(shares)


def hungry(megabytes: int) -> int:
    return len(bytearray(megabytes * 1_000_000))


def endless(_: object) -> int:
    number = 0
    while True:
        number += 1


def refusing(name: str) -> None:
    raise InputError(name, "is damaged", "Mend it.")


def faulty(_: object) -> None:
    raise KeyError("no such thing")


def ending(_: object) -> None:
    os.abort()
