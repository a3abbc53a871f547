"""`veduta drive LOG -o OUT`."""

from __future__ import annotations

SUMMARY = "Turn a street drive with laser scans and images into textured facades"


def run(arguments: list[str]) -> int:
    """Parse the arguments, do the work, say what was made and where it is."""
    from veduta.cli.arguments import parse
    from veduta.cli.drive_call import DriveCall
    from veduta.cli.told import tell_result
    from veduta.drive import run_drive
    from veduta.run.progress import Progress

    call = parse(DriveCall, "veduta drive", arguments)
    progress = Progress(quiet=call.quiet)
    result = run_drive(
        call.log, call.out, call.options(), progress, document=call.document, force=call.force
    )
    return tell_result(result, quiet=call.quiet)
