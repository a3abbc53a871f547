"""`veduta carve DIR -o OUT`."""

from __future__ import annotations

SUMMARY = "Turn photos with silhouettes into a closed, coloured object"


def run(arguments: list[str]) -> int:
    """Parse the arguments, do the work, say what was found and where it is."""
    if any(word.split("=")[0] == "--print-board" for word in arguments):
        return _print_board(arguments)
    from veduta.cli.arguments import parse
    from veduta.cli.carve_call import CarveCall
    from veduta.cli.told import tell_result
    from veduta.run.progress import Progress

    call = parse(CarveCall, "veduta carve", arguments)

    from veduta.carve.command import run_carve

    progress = Progress(quiet=call.quiet)
    result = run_carve(call.record, call.out, call.options(), progress, force=call.force)
    return tell_result(result, quiet=call.quiet)


def _print_board(arguments: list[str]) -> int:
    from veduta.cameras import Board, print_board
    from veduta.cli.arguments import parse
    from veduta.cli.carve_call import BoardCall
    from veduta.run.errors import InputError
    from veduta.run.outputs import writing_to

    call = parse(BoardCall, "veduta carve", arguments)
    board = Board(call.board)
    if call.print_board.exists():
        raise InputError(call.print_board, "exists", "Name another file, or move it away.")
    if call.print_board.suffix.lower() != ".pdf":
        raise InputError(call.print_board, "is no name of a PDF", "Let it end with .pdf.")
    with writing_to(call.print_board.parent):
        print_board(board, call.print_board)
    across, along = (round(side * 1000.0) for side in board.free_m)
    markers = len(board.corners_m)
    print(f"{call.print_board}: {markers} markers around {across} x {along} mm for the object.")
    print("Print it at 100 %, measure its line of 100 mm, and lay it flat under the object.")
    return 0
