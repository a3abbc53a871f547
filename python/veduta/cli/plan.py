"""`veduta plan IMAGE... -o OUT`."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from veduta.cli.invoked import invoked

REPORT = "report.html"
SUMMARY = "Turn floor plans into a house that one can walk through"

if TYPE_CHECKING:
    from veduta.plan.pipeline import PlanResult


def run(arguments: list[str]) -> int:
    """Parse the arguments, do the work, say what was found and where it is."""
    from veduta.cli.arguments import parse
    from veduta.cli.plan_call import PlanCall
    from veduta.run.progress import Progress

    call = parse(PlanCall, "veduta plan", arguments)

    from veduta.plan.photos.given import room_photos
    from veduta.plan.pipeline import run_plan

    photos = room_photos(call.photos)
    progress = Progress(quiet=call.quiet)
    result = run_plan(
        call.drawings, call.out, call.options(), progress, photos=photos, force=call.force
    )
    if result.failure:
        subject, reason = result.failure.subject, result.failure.reason
        named = reason if subject in reason else f"{subject}: {reason}"
        print(f"error: {named}", file=sys.stderr)
    if not call.quiet:
        _tell(result)
    return result.exit_code


def _tell(result: PlanResult) -> None:
    from veduta.cli.kept import tell_kept
    from veduta.plan.load import DOCUMENT
    from veduta.plan.report import summary_line

    out = result.out
    edited = [name for name in result.edited if name != DOCUMENT]
    tell_kept(out, edited, result.foreign, up_to_date=result.up_to_date)
    if result.outdated:
        command = invoked("plan", str(out / DOCUMENT), "-o", str(out))
        print(f"{out / DOCUMENT}: was edited; to rebuild from it: {command}")
    for note in result.notes:
        print(f"note: {note}")
    if result.left:
        print(
            f"Nothing was made. To build what you gave, choose another folder than {out} with -o."
        )
    elif result.failure is None and result.measures:
        print(summary_line(result.measures))
        for doubt in result.doubts:
            print(f"warning: {doubt}")
        print(f"Walk in it: {invoked('view', str(out))}")
    if REPORT not in (*result.edited, *result.foreign):
        print(f"What was done, and why: {out / REPORT}")
