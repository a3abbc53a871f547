"""`veduta photos DIR -o OUT`."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from veduta.cli.invoked import invoked
from veduta.run.errors import InputError

SUMMARY = "Turn photos of a place into cameras where they were taken, and points in space"
MOST_NAMED = 10

if TYPE_CHECKING:
    from veduta.photos.pipeline import PhotosResult


def run(arguments: list[str]) -> int:
    """Parse the arguments, do the work, say what was found and where it is."""
    from veduta.cli.arguments import parse
    from veduta.cli.photos_call import PhotosCall
    from veduta.run.pool import require_jobs
    from veduta.run.progress import Progress

    _require_one_folder(arguments)
    call = parse(PhotosCall, "veduta photos", arguments)
    require_jobs(call.jobs)

    from veduta.photos.pipeline import run_photos

    progress = Progress(quiet=call.quiet)
    result = run_photos(
        call.photos,
        call.out,
        call.options(),
        progress,
        given=call.given(),
        force=call.force,
        jobs=call.jobs,
    )
    if result.failure:
        print(f"error: {result.failure.subject}: {result.failure.reason}", file=sys.stderr)
    if not call.quiet:
        _tell(result)
    return result.exit_code


def _require_one_folder(arguments: list[str]) -> None:
    """InputError where photos are named one by one, or in several folders."""
    first = [*arguments[:2], "-", "-"]
    if not first[0].startswith("-") and not first[1].startswith("-"):
        fault = "is given beside another: the verb takes one folder, and all photos in it"
        raise InputError(first[1], fault, "Put the photos into one folder, and name that.")


def _tell(result: PhotosResult) -> None:
    from veduta.cli.kept import tell_kept
    from veduta.photos.report import summary_line

    out = result.out
    for name, reason in result.left[:MOST_NAMED]:
        print(f"{name}: left out: {reason}")
    if len(result.left) > MOST_NAMED:
        print(f"and {len(result.left) - MOST_NAMED} more left out: {out / 'report.html'}")
    tell_kept(out, result.edited, result.foreign, up_to_date=result.up_to_date)
    if result.failure is None:
        for mark in result.measures.get("gcp_unknown", ())[:MOST_NAMED]:
            print(f"control points, {mark}")
        print(summary_line(result.measures))
        for alarm in result.measures.get("alarms", ()):
            print(f"note: {alarm}")
        for refused in result.measures.get("georef_refused", ()):
            print(f"not laid into the world by {refused}")
        print(f"Look at it: {invoked('view', str(out))}")
    print(f"What was done, and why: {out / 'report.html'}")
