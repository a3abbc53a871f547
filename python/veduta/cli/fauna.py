"""`veduta fauna FOOTAGE -o OUT`."""

from __future__ import annotations

SUMMARY = "Turn footage of an animal into a moving 3D animal"


def run(arguments: list[str]) -> int:
    """Parse the arguments, do the work, say what was found and where it is."""
    from veduta.cli.arguments import parse
    from veduta.cli.fauna_call import FaunaCall
    from veduta.cli.told import tell_result
    from veduta.run.progress import Progress

    call = parse(FaunaCall, "veduta fauna", arguments)

    from veduta.fauna.command import run_fauna
    from veduta.fauna.recipe import Record

    record = Record(
        call.footage, call.masks, call.background, call.place, call.path, call.plan, call.joints,
        call.markers, call.gaits, call.second_view,
    )  # fmt: skip
    progress = Progress(quiet=call.quiet)
    result = run_fauna(record, call.out, call.options(), progress, force=call.force)
    return tell_result(result, quiet=call.quiet)
