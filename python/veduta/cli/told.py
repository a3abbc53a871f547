"""What the terminal says at the end of a verb, the same for every verb of `run.verb`."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from veduta.cli.invoked import invoked
from veduta.cli.kept import tell_kept

if TYPE_CHECKING:
    from veduta.run.verb import VerbResult

REPORT = "report.html"


def tell_result(result: VerbResult, *, quiet: bool = False) -> int:
    """Say what was made, what is doubtful and where it lies; returns the exit code."""
    if result.failure is not None:
        failure = result.failure
        print(f"error: {failure.subject}: {failure.reason}", file=sys.stderr)
    if quiet:
        return result.exit_code
    tell_kept(result.out, result.edited, result.foreign, up_to_date=result.up_to_date)
    if result.failure is None:
        if result.summary:
            print(result.summary)
        for doubt in result.doubts:
            print(f"warning: {doubt}")
        print(f"Look at it: {invoked('view', str(result.out))}")
    if REPORT not in (*result.edited, *result.foreign):
        print(f"What was done, and why: {result.out / REPORT}")
    return result.exit_code
