"""`veduta facade IMAGE... -o OUT`."""

from __future__ import annotations

import shlex
import sys
from typing import TYPE_CHECKING

SUMMARY = "Turn photos of facades into LoD3 buildings: floors, windows, balconies, roof"

if TYPE_CHECKING:
    from pathlib import Path

    from veduta.cli.facade_call import FacadeCall
    from veduta.facade.batch import CallResult


def run(arguments: list[str]) -> int:
    """Parse the arguments, do the work, say what was found and where it is."""
    from veduta.cli.arguments import parse
    from veduta.cli.facade_call import FacadeCall

    return _run(parse(FacadeCall, "veduta facade", arguments))


def _run(call: FacadeCall) -> int:
    from veduta.facade.batch import run_call
    from veduta.run.errors import InputError
    from veduta.run.progress import Progress

    if call.jobs is not None and call.jobs < 1:
        raise InputError("--jobs", f"is {call.jobs}", "Give 1 or more.")
    progress = Progress(quiet=call.quiet)
    result = run_call(
        call.images, call.out, call.options(), progress, force=call.force, jobs=call.jobs
    )
    _tell_failures(result)
    if not call.quiet:
        _tell_results(result)
    return result.exit_code


def _tell_failures(result: CallResult) -> None:
    from veduta.cli.main import save_traceback

    for failure in result.failed.values():
        print(f"error: {failure.subject}: {failure.reason}", file=sys.stderr)
    if result.tracebacks:
        told = [f"{name}:\n{text}" for name, text in result.tracebacks.items()]
        path = save_traceback("\n".join(told))
        print(f"Please report it with {path}", file=sys.stderr)


def _tell_results(result: CallResult) -> None:
    from veduta.facade.label_pictures import labels_note
    from veduta.facade.report import adjusted_line, summary_line

    out = result.out
    done = [name for name in result.asked if name in result.summaries]
    for name in done:
        state = "" if name in result.fresh else " (was done)"
        print(f"{name}: {summary_line(result.summaries[name])}{state}")
        adjusted = adjusted_line(result.summaries[name])
        if adjusted:
            print(f"{' ' * len(name)}  {adjusted}: {out / name / 'report.html'}")
    # A rebuild says nothing of the documents of other houses, which may be rebuilt already.
    for name in result.edited if result.kind == "photo" else ():
        print(f"{out / name}: was edited and is left as it is{_rebuild(out, name)}")
    for name in result.foreign:
        print(f"{out / name}: was not made by veduta and is left as it is")
    for name in result.left:
        print(f"{out / name}: is left from an earlier call")
    if result.labels:
        print(labels_note(result.labels, whole=False))
    if result.up_to_date:
        print(f"{out} is up to date; --force makes it anew")
    if done:
        total = len(result.asked)
        walk = shlex.join(["veduta", "view", str(out)])
        print(f"{len(done)} of {total} in {out}. Walk in it: {walk}")
        page = out / done[0] / "report.html" if total == 1 else out / "report.html"
        print(f"What was done, and why: {page}")


def _rebuild(out: Path, name: str) -> str:
    """How an edited document becomes a building again; nothing for other files."""
    from veduta.facade.load import DOCUMENT

    if name.split("/")[-1] != DOCUMENT:
        return ""
    command = shlex.join(["veduta", "facade", str(out / name), "-o", str(out)])
    return f"; to rebuild from it: {command}"
