"""`veduta facade IMAGE... -o OUT`."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from veduta.cli.invoked import invoked

SUMMARY = "Turn photos of facades into LoD3 buildings: floors, windows, balconies, roof"

ALSO = ("style", "houses", "glass", "width")
"""What of a summary has a line of its own."""

if TYPE_CHECKING:
    from veduta.cli.facade_call import FacadeCall
    from veduta.facade.batch import CallResult


def run(arguments: list[str]) -> int:
    """Parse the arguments, do the work, say what was found and where it is."""
    from veduta.cli.arguments import parse
    from veduta.cli.facade_call import FacadeCall

    return _run(parse(FacadeCall, "veduta facade", arguments))


def _run(call: FacadeCall) -> int:
    if call.eyes.eyes == "learned" and len(call.images) == 1 and call.images[0].is_file():
        from veduta.facade.eyes import look_soon

        look_soon()  # while the rest is loaded: one photo is read in this process
    from veduta.facade.batch import run_call
    from veduta.run.pool import require_jobs
    from veduta.run.progress import Progress

    require_jobs(call.jobs)
    progress = Progress(quiet=call.quiet)
    result = run_call(
        call.images, call.out, call.options(), progress, force=call.force, jobs=call.jobs
    )
    _tell_failures(result)
    if not call.quiet:
        _tell_results(result)
    return result.exit_code


def _tell_failures(result: CallResult) -> None:
    from veduta.cli.main import tell_bugs

    for failure in result.failed.values():
        print(f"error: {failure.subject}: {failure.reason}", file=sys.stderr)
    tell_bugs(result.tracebacks)


def _tell_results(result: CallResult) -> None:
    from veduta.facade.arrangement import wall_line
    from veduta.facade.house_folders import beside_found
    from veduta.facade.label_pictures import labels_note
    from veduta.facade.report import adjusted_line, summary_line

    out = result.out
    done = [name for name in result.asked if name in result.summaries]
    for name in done:
        print(f"{name}: {summary_line(result.summaries[name])}{_state(name, result)}")
        adjusted = adjusted_line(result.summaries[name])
        summary = result.summaries[name]
        also = wall_line(summary), *(summary.get(one) for one in ALSO)
        for said in filter(None, also):
            print(f"{' ' * len(name)}  {said}")
        for folder, found in beside_found(summary):
            print(f"{' ' * len(name)}  {folder}: {summary_line(found)}")
        if adjusted:
            print(f"{' ' * len(name)}  {adjusted}: {out / name / 'report.html'}")
    for path in _edited(result):
        print(f"{out / path}: was edited and is left as it is{_rebuild(path, result)}")
    for path in _changed_back(result) if result.kind == "photo" else ():
        print(f"{out / path}: is another than the model was made from{_rebuild(path, result)}")
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
        walk = invoked("view", str(out))
        print(f"{len(done)} of {total} in {out}. Walk in it: {walk}")
        page = out / done[0] / "report.html" if total == 1 else out / "report.html"
        print(f"What was done, and why: {page}")


def _state(name: str, result: CallResult) -> str:
    """Where the numbers of a building come from, if not from this run."""
    from veduta.facade.load import DOCUMENT

    if name in result.outdated:
        return f" (was done, before {DOCUMENT} was changed)"
    if name in result.fresh:
        return ""
    if result.kind == "photo" and f"{name}/{DOCUMENT}" in result.edited:
        return f" (was rebuilt from the edited {DOCUMENT})"
    return " (was done)"


def _edited(result: CallResult) -> list[str]:
    """Edited files to tell of.

    A rebuild says nothing of the documents that it works on, nor of other houses, which may be
    rebuilt already; but of models and pictures that it could not replace.
    """
    from veduta.facade.load import DOCUMENT

    if result.kind == "photo":
        return result.edited
    own = [path for path in result.edited if path.rpartition("/")[0] in result.asked]
    return [path for path in own if not path.endswith(f"/{DOCUMENT}")]


def _changed_back(result: CallResult) -> list[str]:
    """Documents that are as Veduta wrote them, beside models of an edit that was taken back."""
    from veduta.facade.load import DOCUMENT

    paths = [f"{name}/{DOCUMENT}" for name in result.outdated]
    return [path for path in paths if path not in result.edited]


def _rebuild(path: str, result: CallResult) -> str:
    """How an edited document becomes a building again; nothing for other files."""
    from veduta.facade.load import DOCUMENT

    name, _, file = path.rpartition("/")
    if result.kind == "document":
        return ": it does not follow the document. Delete it and rebuild"
    if file != DOCUMENT or name not in result.outdated:
        return ""
    command = invoked("facade", str(result.out / path), "-o", str(result.out))
    return f"; to rebuild from it: {command}"
