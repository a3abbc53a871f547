"""`veduta dense CAMERAS -o OUT`."""

from __future__ import annotations

SUMMARY = "Turn calibrated photos into depth maps, a point cloud and a mesh"


def run(arguments: list[str]) -> int:
    """Parse the arguments, do the work, say what was found and where it is."""
    from veduta.cli.arguments import parse
    from veduta.cli.dense_call import DenseCall
    from veduta.cli.told import tell_result
    from veduta.run.progress import Progress

    call = parse(DenseCall, "veduta dense", arguments)

    from veduta.dense.command import run_dense

    progress = Progress(quiet=call.quiet)
    result = run_dense(
        call.cameras, call.out, call.options(), progress, images=call.images, force=call.force
    )
    return tell_result(result, quiet=call.quiet)
