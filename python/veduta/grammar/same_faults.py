"""A fault that many lots share, told once."""

from __future__ import annotations

from collections.abc import Sequence

from veduta.run.report import Failure

NAMED = 3
"""Lots that are named; of more, only the number is told."""


def told_once(failures: Sequence[Failure]) -> list[Failure]:
    """Failures of the same input with the same reason as one, in the order of the first of each.

    Its subject says how many lots there are, and names the first few.
    """
    same: dict[object, list[Failure]] = {}
    for number, failure in enumerate(failures):
        key = failure.reason if failure.kind == "input" else number
        same.setdefault(key, []).append(failure)
    return [_together(group) for group in same.values()]


def _together(group: Sequence[Failure]) -> Failure:
    first = group[0]
    subjects = list(dict.fromkeys(failure.subject for failure in group))
    if len(subjects) == 1:
        return first
    file = _file(subjects)
    names = [subject.removeprefix(file) for subject in subjects[:NAMED]]
    more = ["..."] if len(subjects) > NAMED else []
    told = f"{file}{len(group):,} lots ({', '.join(names + more)})"
    return first.model_copy(update={"subject": told})


def _file(subjects: Sequence[str]) -> str:
    """What all subjects have before the name of the lot: the path of their file."""
    begins = [subject.split(": ")[:-1] for subject in subjects]
    file = ""
    for parts in zip(*begins, strict=False):
        if len(set(parts)) > 1:
            break
        file += f"{parts[0]}: "
    return file
