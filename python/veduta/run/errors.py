"""The errors that Veduta raises for people to read."""

from __future__ import annotations

import errno
from pathlib import Path

NO_ROOM = frozenset({errno.ENOSPC, errno.EDQUOT, errno.EFBIG})
"""What the system says where a file has no room."""


class VedutaError(Exception):
    """Base of all errors that Veduta raises on purpose."""


class InputError(VedutaError):
    """Something that the user gave cannot be used.

    Carries the file (or the option), what is wrong with it, and what to do.
    """

    def __init__(self, subject: str | Path, fault: str, remedy: str) -> None:
        self.subject = str(subject)
        self.fault = fault
        self.remedy = remedy
        super().__init__(f"{self.subject}: {fault}. {remedy}")

    def __reduce__(self) -> tuple[type[InputError], tuple[str, str, str]]:
        # The default reduce would call the constructor with one argument, which
        # breaks the way back from a worker process.
        return (type(self), (self.subject, self.fault, self.remedy))


class UnwritableError(InputError):
    """The system refuses to write the results: a full disk, a quota, permissions."""

    @classmethod
    def of(
        cls, error: OSError, subject: str | Path = "the output", then: str = ""
    ) -> UnwritableError:
        """What the system said, and what to do. then: what else is to be known of that place."""
        cure = "Make room there" if error.errno in NO_ROOM else "Mend that"
        fault = f"cannot be written ({error.strerror or error})"
        return cls(subject, fault, f"{cure}{then}.")


class NotFoundError(VedutaError):
    """The record is readable, but what the step looks for is not in it.

    `what` names the thing that was looked for, `evidence` the measured reason.
    """

    def __init__(self, what: str, evidence: str, remedy: str) -> None:
        self.what = what
        self.evidence = evidence
        self.remedy = remedy
        super().__init__(f"{what} not found: {evidence}. {remedy}")

    def __reduce__(self) -> tuple[type[NotFoundError], tuple[str, str, str]]:
        return (type(self), (self.what, self.evidence, self.remedy))


class UnfinishedError(VedutaError):
    """The run was stopped (Ctrl-C, SIGTERM); what is finished is on disk."""
