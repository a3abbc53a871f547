"""`veduta walk DIR -o OUT`."""

from __future__ import annotations

SUMMARY = "Turn stereo views along a path into a walk that morphs from view to view"


def run(arguments: list[str]) -> int:
    """Parse the arguments, do the work, say what was found and where it is."""
    from veduta.cli.arguments import parse
    from veduta.cli.told import tell_result
    from veduta.cli.walk_call import WalkCall
    from veduta.run.errors import InputError
    from veduta.run.progress import Progress
    from veduta.walk.options import WalkOptions

    call = parse(WalkCall, "veduta walk", arguments)

    from veduta.walk.command import Sources, run_walk
    from veduta.walk.rebuild import run_rebuild

    sources = Sources(call.calibration, call.calibrate, call.cameras)
    if call.folder.suffix == ".json":
        if call.options() != WalkOptions() or sources != Sources():
            fault = "is built from as it stands: no other option changes it"
            remedy = "Leave all but -o, --force and --quiet out, or name the pictures."
            raise InputError(call.folder, fault, remedy)
        result = run_rebuild(call.folder, call.out, Progress(quiet=call.quiet), force=call.force)
        return tell_result(result, quiet=call.quiet)
    result = run_walk(
        call.folder, call.out, call.options(), Progress(quiet=call.quiet),
        sources=sources, force=call.force,
    )  # fmt: skip
    return tell_result(result, quiet=call.quiet)
