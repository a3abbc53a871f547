"""`veduta demo`: a synthetic street, rebuilt from its photo, beside the truth."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from veduta.cli.invoked import invoked

SUMMARY = "Make a synthetic street, rebuild it from its photo, compare it with the truth"

if TYPE_CHECKING:
    from pathlib import Path

    from veduta.cli.demo_call import DemoCall
    from veduta.facade.compare import Comparison, Pair
    from veduta.facade.demo import DemoRecord, DemoResult


def run(arguments: list[str]) -> int:
    """Parse the arguments, make and rebuild the street, print both beside each other."""
    from veduta.cli.arguments import parse
    from veduta.cli.demo_call import DemoCall
    from veduta.run.errors import InputError
    from veduta.run.progress import Progress

    call = parse(DemoCall, "veduta demo", arguments)
    if call.walk and call.animal:
        raise InputError("--walk and --animal", "are two demos", "Make them one after the other.")
    if call.walk:
        return _walk(call)
    from veduta.facade.demo import run_demo

    result = run_demo(
        call.out, call.demo, call.street, Progress(quiet=call.quiet), force=call.force
    )
    if result.record is None:
        return _tell_failure(result)
    if not call.quiet:
        print("\n".join(_lines(result.record, result)))
    return _animal(call.out, quiet=call.quiet, force=call.force) if call.animal else 0


def _animal(out: Path, *, quiet: bool, force: bool) -> int:
    """An animal in the street, read from a film of it."""
    from veduta.cli.told import tell_result
    from veduta.fauna.demo import run_demo_animal
    from veduta.run.progress import Progress

    if not quiet:
        print(f"\nAn animal from a film of it ({out}/film):")
    return tell_result(run_demo_animal(out, Progress(quiet=quiet), force=force), quiet=quiet)


def _walk(call: DemoCall) -> int:
    """The walk through a gorge."""
    from veduta.cli.told import tell_result
    from veduta.run.progress import Progress
    from veduta.walk.demo import run_walk_demo

    done = run_walk_demo(call.out, call.demo.seed, Progress(quiet=call.quiet), force=call.force)
    if done.call.failure is not None:
        return tell_result(done.call, quiet=call.quiet)
    if call.quiet:
        return 0
    print(f"A gorge from seed {call.demo.seed}: {done.call.summary}")
    for one in done.transitions:
        found = "" if one.found_m is None else f"{one.found_m:>8.3f} m found"
        print(f"  {one.names:<14}{one.how:<8}{found}, {one.true_m:.3f} m true")
    print(f"  water     in up to {done.water:.0%} of a view")
    print(f"Why:        {call.out}/walk/report.html")
    print(f"Walk in it: {invoked('view', f'{call.out}/walk')}")
    return 0


def _tell_failure(result: DemoResult) -> int:
    """Say why the photo gave no building; the exit code is that of the verb."""
    if result.call is None:
        return 0
    for failure in result.call.failed.values():
        print(f"error: {failure.subject}: {failure.reason}", file=sys.stderr)
    return result.call.exit_code


def _lines(record: DemoRecord, result: DemoResult) -> list[str]:
    width, height = record.photo_px
    again = "" if result.call else f" (was done; --force makes it anew in {result.out})"
    return [
        f"A {record.style} facade from seed {record.seed}{again}",
        f"  photo     {result.out}/truth/street.jpg: {width} x {height} px, "
        f"{record.focal_mm35:.0f} mm, from {record.distance_m:.0f} m away",
        f"  given     {', '.join(record.given)}",
        f"  seconds   {record.seconds_photo:.1f} for the photo, "
        f"{record.seconds_rebuild:.1f} for the building",
        *_edited(result),
        "",
        *_numbers(record.comparison),
        *_windows(record.comparison),
        "",
        f"By eye:     {result.out}/comparison/comparison.png (photo, truth, found)",
        f"Why:        {result.out}/place/street/report.html",
        f"Walk in it: {invoked('view', f'{result.out}/place')}",
        f"  in a street that rules invented: {invoked('view', str(result.out))}",
        *_street(result),
    ]


def _street(result: DemoResult) -> list[str]:
    """The lots of the street that have no building."""
    failures = result.street.failures.named if result.street else []
    return [f"  not built {failure.subject}: {failure.reason}" for failure in failures]


def _edited(result: DemoResult) -> list[str]:
    """Whose numbers these are, where they are not those of the photo alone."""
    document = f"{result.out}/place/street/facade.json"
    return [f"  edited    {document}: it is compared as it is now"] if result.edited else []


def _numbers(comparison: Comparison) -> list[str]:
    def row(name: str, pair: Pair, digits: int) -> str:
        off = round(pair.found - pair.true, digits)
        mark = f"{off:>+10.{digits}f}" if off else ""
        return f"  {name:<10}{pair.found:>8.{digits}f}{pair.true:>8.{digits}f}{mark}"

    return [
        f"  {'':<10}{'found':>8}{'true':>8}{'off':>10}",
        row("storeys", comparison.storeys, 0),
        row("columns", comparison.columns, 0),
        row("width m", comparison.width_m, 2),
        row("height m", comparison.height_m, 2),
        row("windows", comparison.window_count, 0),
    ]


def _windows(comparison: Comparison) -> list[str]:
    windows = comparison.windows
    lines = [
        "",
        f"  windows   {windows.matched} of {windows.true} found: recall {windows.recall:.2f}, "
        f"precision {windows.precision:.2f} (IoU 0.5)",
    ]
    if comparison.corners_off_m:
        lines.append(
            f"  corners   {comparison.off_m(0.5):.2f} m off in the median, "
            f"{comparison.off_m(0.9):.2f} m at nine of ten"
        )
    lines.append(
        f"  pixels    {comparison.accuracy:.2f} right, of the {comparison.compared:.2f} "
        "of house and sky that were kept"
    )
    classes = ", ".join(f"{name} {value:.2f}" for name, value in comparison.class_recall.items())
    lines.append(f"  by class  {classes}")
    if windows.missed:
        lines.append(f"  missed    windows at {'; '.join(windows.missed)}")
    if windows.elsewhere:
        lines.append(f"  wrong     {windows.elsewhere} windows found beside the house")
    if windows.cut_off:
        lines.append(f"  cut off   {windows.cut_off} true windows lie outside the rectified photo")
    return lines
