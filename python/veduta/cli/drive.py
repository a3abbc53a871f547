"""`veduta drive LOG -o OUT`, and `veduta drive start LOG -o HTML`."""

from __future__ import annotations

START = "start"
"""Before a log, which may itself be called so: `./start` then."""
SUMMARY = "Turn a street drive with laser scans and images into textured facades"


def run(arguments: list[str]) -> int:
    """Parse the arguments, do the work, say what was made and where it is."""
    if arguments[:1] == [START]:
        return _start(arguments[1:])
    from veduta.cli.arguments import parse
    from veduta.cli.drive_call import DriveCall
    from veduta.cli.told import tell_result
    from veduta.run.progress import Progress

    call = parse(DriveCall, "veduta drive", arguments)

    from veduta.drive.command import run_drive

    progress = Progress(quiet=call.quiet)
    result = run_drive(
        call.log, call.out, call.options(), progress, document=call.document, force=call.force
    )
    return tell_result(result, quiet=call.quiet)


def _start(arguments: list[str]) -> int:
    """Write the page on which one clicks where the drive begins."""
    from veduta.cli.arguments import parse
    from veduta.cli.drive_start_call import DriveStartCall
    from veduta.drive.start_page import write_start_page
    from veduta.run.errors import InputError
    from veduta.run.names import printable

    call = parse(DriveStartCall, "veduta drive start", arguments)
    if call.out.is_dir():
        raise InputError(call.out, "is a folder", "Name a file: -o start.html.")
    if call.out.exists() and not call.force:
        raise InputError(call.out, "is there already", "Use --force, or choose another name.")
    write_start_page(call.log, call.out)
    if not call.quiet:
        print(f"{printable(str(call.out))}: open it, and click where the drive begins")
    return 0
