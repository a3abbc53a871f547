"""`veduta carve DIR -o OUT`."""

from __future__ import annotations

SUMMARY = "Turn photos with silhouettes into a closed, coloured object"


def run(arguments: list[str]) -> int:
    """Parse the arguments, do the work, say what was found and where it is."""
    from veduta.carve import run_carve
    from veduta.cli.arguments import parse
    from veduta.cli.carve_call import CarveCall
    from veduta.cli.told import tell_result
    from veduta.run.progress import Progress

    call = parse(CarveCall, "veduta carve", arguments)
    progress = Progress(quiet=call.quiet)
    result = run_carve(call.record, call.out, call.options(), progress, force=call.force)
    return tell_result(result, quiet=call.quiet)
