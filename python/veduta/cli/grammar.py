"""`veduta grammar ACTION`: rule files, and the buildings that they make."""

from __future__ import annotations

import difflib
import sys
from typing import TYPE_CHECKING

from veduta.cli.invoked import invoked

if TYPE_CHECKING:
    from veduta.grammar.pipeline import DeriveResult

SUMMARY = "Make buildings from rule files (CGA) and lots; check and format rule files"
ACTIONS = ("check", "format", "derive", "sample", "tree")
MAX_FAILURES = 20
HELP = f"""usage: veduta grammar check RULES [--lots LOTS] [--lot ID] and others of derive
       veduta grammar format RULES... [--write]
       veduta grammar derive RULES -o OUT [--lots LOTS] [--attr NAME=VALUE] [--edits FILE]
                             [--seed INT] [--start TEXT] [--style TEXT]
                             [--seconds FLOAT] [--max-depth INT] [--max-shapes INT]
                             [--max-faces INT] [--max-parts INT] [--max-work INT]
                             [--max-memory INT]
                             [--layer TEXT] [--crs TEXT] [--map ATTR=PROPERTY] [--up y|z]
                             [--roads PATH] [--terrain PATH] [--ground lowest|mean]
                             [--project DIR] [--library DIR]
                             [--separate] [--no-city] [--force] [--jobs N] [--quiet]
       veduta grammar sample RULES -o SHEET [--count N] [--lots LOTS] [--lot ID]
                             [--colours classes|real|both] [--columns INT] [--width INT]
                             [--rays INT] and others of derive
       veduta grammar tree RULES [-o FILE] [--lots LOTS] [--lot ID] [--at PATH] [--depth N]
                             and others of derive

{SUMMARY}.

  check     Check a rule file and what it imports, and try it on one lot; every fault is shown
            with its line
  format    Lay out rule files in the house style
  derive    Derive a building for each lot of a file (GeoJSON, CityJSON, GeoPackage, OBJ), or for
            a synthetic street
  sample    Show what the rules can make: random derivations in a picture
  tree      Show how a building is derived: its shapes, their choices and paths

RULES is a rule file (.cga) or, but for `format`, the name of a style that Veduta brings along
(haussmann, victorian, ...: see docs/styles.md).
`veduta grammar ACTION --help` explains the options of an action."""


def run(arguments: list[str]) -> int:
    """Find the action, and do it."""
    from veduta.run.errors import InputError

    if not arguments or arguments[0] in ("-h", "--help"):
        print(HELP)
        return 0 if arguments else 2
    action, *rest = arguments
    if action not in ACTIONS:
        near = difflib.get_close_matches(action, ACTIONS, n=1)
        hint = f"Did you mean `{near[0]}`?" if near else f"Actions: {', '.join(ACTIONS)}."
        raise InputError(action, "is not an action of veduta grammar", hint)
    if action in ("sample", "tree"):
        from veduta.cli import grammar_show

        return {"sample": grammar_show.sample, "tree": grammar_show.tree}[action](rest)
    return {"check": _check, "format": _format, "derive": _derive}[action](rest)


def _check(arguments: list[str]) -> int:
    from veduta.cli.arguments import parse
    from veduta.cli.grammar_call import CheckCall
    from veduta.grammar.options import GrammarOptions, NameOptions
    from veduta.run.report import counted

    call = parse(CheckCall, "veduta grammar check", arguments)

    from veduta.grammar.given import read_attributes
    from veduta.grammar.lot_names import read_names
    from veduta.grammar.one_lot import find_lot
    from veduta.grammar.rules import check_rules, find_rules, read_rules, with_start
    from veduta.grammar.trial import tried

    options = GrammarOptions(
        derive=call.derive,
        limits=call.limits,
        lots=call.read,
        attributes=read_attributes(call.attr),
        names=NameOptions(values=read_names(call.map)),
    )
    rules = read_rules(find_rules(call.rules), call.project, call.library)
    rules, start = with_start(rules, call.derive.start)
    options = options.starting_with(start)
    verdict = check_rules(rules, start)
    print(verdict.told, end="")
    faults: tuple[str, ...] = ()
    told: tuple[str, ...] = ()
    if not verdict.errors:
        lot, beside = find_lot(call.lots, call.lot, call.read, call.derive.seed)
        faults, told = tried(rules, options, lot, beside)
        print("".join(f"error: {fault}\n" for fault in faults), end="")
        print("".join(f"warning: {one}\n" for one in told), end="")
    errors = verdict.errors + len(faults)
    warnings = verdict.warnings + len(told)
    print(f"{call.rules}: {counted(errors, 'error')}, {counted(warnings, 'warning')}")
    return 2 if errors else 0


def _format(arguments: list[str]) -> int:
    from veduta.cli.arguments import parse
    from veduta.cli.grammar_call import FormatCall
    from veduta.grammar.layout import formatted, write_formatted
    from veduta.run.errors import InputError

    call = parse(FormatCall, "veduta grammar format", arguments)
    if not call.rules:
        raise InputError("RULES", "no rule file is named", "Name at least one.")
    if call.write:
        for path in call.rules:
            if write_formatted(path):
                print(f"{path}: rewritten")
        return 0
    if len(call.rules) > 1:
        raise InputError(
            "RULES", "several files cannot be printed at once", "Give one, or --write."
        )
    text, _ = formatted(call.rules[0])
    print(text, end="")
    return 0


def _derive(arguments: list[str]) -> int:
    from veduta.cli.arguments import parse
    from veduta.cli.grammar_call import DeriveCall
    from veduta.grammar.options import GrammarOptions, NameOptions
    from veduta.run.pool import require_jobs
    from veduta.run.progress import Progress

    call = parse(DeriveCall, "veduta grammar derive", arguments)
    require_jobs(call.jobs)

    from veduta.grammar.given import read_attributes
    from veduta.grammar.lot_names import read_names
    from veduta.grammar.pipeline import run_derive

    options = GrammarOptions(
        derive=call.derive,
        limits=call.limits,
        lots=call.read,
        output=call.output,
        attributes=read_attributes(call.attr),
        names=NameOptions(values=read_names(call.map)),
    )
    progress = Progress(quiet=call.quiet)
    result = run_derive(
        call.rules,
        call.lots,
        call.out,
        options,
        progress,
        edits_path=call.edits,
        project=call.project,
        libraries=call.library,
        force=call.force,
        jobs=call.jobs,
    )
    _tell_failures(result)
    if not call.quiet:
        _tell_result(result)
    return result.exit_code


def _tell_failures(result: DeriveResult) -> None:
    from veduta.cli.main import tell_bugs
    from veduta.grammar.same_faults import told_once

    failures = told_once(result.failures.named)
    for failure in failures[:MAX_FAILURES]:
        print(f"error: {failure.subject}: {failure.reason}", file=sys.stderr)
    more = max(len(failures) - MAX_FAILURES, 0) + result.failures.untold
    if more:
        print(f"error: {more} more: {result.out / 'report.html'}", file=sys.stderr)
    tell_bugs(result.tracebacks)


def _tell_result(result: DeriveResult) -> None:
    from veduta.cli.kept import tell_kept
    from veduta.grammar.report import measures, summary_line

    print(summary_line(measures(result.built, result.total)))
    for note in result.notes:
        print(note)
    tell_kept(result.out, result.edited, result.foreign, up_to_date=result.up_to_date)
    if result.built.count:
        print(f"Walk in it: {invoked('view', str(result.out))}")
    print(f"What was done, and why: {result.out / 'report.html'}")
