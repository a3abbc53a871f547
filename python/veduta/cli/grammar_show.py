"""`veduta grammar sample | tree`: looking at what rules make."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

from veduta.run.errors import InputError

PICTURES = (".png", ".jpg", ".jpeg")
DRAWINGS = (".svg", ".txt")
MAX_DEPTH = 1000


def sample(arguments: list[str]) -> int:
    """Random derivations on one lot, in a picture."""
    from veduta.cli.arguments import parse
    from veduta.cli.grammar_call import SampleCall
    from veduta.grammar.options import GrammarOptions
    from veduta.run.progress import Progress

    call = parse(SampleCall, "veduta grammar sample", arguments)

    from veduta.grammar.derivation import parse as parse_rules
    from veduta.grammar.given import check_options, read_attributes
    from veduta.grammar.one_lot import find_lot
    from veduta.grammar.sampling import MAX_SAMPLES, draw_samples, picture_cells, sheet_of
    from veduta.grammar.sheet import encoded

    _require_suffix("-o", call.out, PICTURES)
    if not 1 <= call.count <= MAX_SAMPLES:
        raise InputError(
            f"--count {call.count}", f"is not from 1 to {MAX_SAMPLES}", "Give another."
        )
    rules = parse_rules(call.rules, style=call.derive.style, start=call.derive.start)
    given = read_attributes(call.attr)
    options = GrammarOptions(
        derive=call.derive, limits=call.limits, lots=call.read, attributes=given
    )
    options = check_options(rules.core, rules.path, options)
    lot, beside = find_lot(call.lots, call.lot, call.read, call.derive.seed)
    samples = draw_samples(rules, lot, options, call.count, beside)
    cells = picture_cells(samples, call.sheet, Progress(quiet=call.quiet))
    sheet = sheet_of(rules.path.stem, lot, samples, cells, call.sheet)
    _write(call.out, encoded(sheet, call.out.suffix.lower()))
    if not call.quiet:
        for cell in cells:
            print(f"{cell.title}: {cell.prior}")
        print(call.out)
    return 0


def tree(arguments: list[str]) -> int:
    """The derivation on one lot, as text or as a drawing."""
    from veduta.cli.arguments import parse
    from veduta.cli.grammar_call import TreeCall
    from veduta.grammar.options import GrammarOptions

    call = parse(TreeCall, "veduta grammar tree", arguments)

    from veduta.grammar.derivation import parse as parse_rules
    from veduta.grammar.edits import EditFault, parse_path, read_edits
    from veduta.grammar.given import check_options, read_attributes
    from veduta.grammar.one_lot import derive_lot, find_lot
    from veduta.grammar.tree_rows import tree_rows
    from veduta.grammar.tree_svg import tree_svg
    from veduta.grammar.tree_text import heading, tree_text

    if call.out is not None:
        _require_suffix("-o", call.out, DRAWINGS)
    if not 0 <= call.depth <= MAX_DEPTH:
        raise InputError(f"--depth {call.depth}", f"is not from 0 to {MAX_DEPTH}", "Give another.")
    try:
        path, _ = parse_path(call.at)
    except EditFault as fault:
        raise InputError("--at", str(fault), "Take one from the tree, or / for all.") from fault
    rules = parse_rules(call.rules, style=call.derive.style, start=call.derive.start)
    given = read_attributes(call.attr)
    options = GrammarOptions(
        derive=call.derive, limits=call.limits, lots=call.read, attributes=given
    )
    options = check_options(rules.core, rules.path, options)
    edits = {} if call.edits is None else read_edits(call.edits)
    lot, beside = find_lot(call.lots, call.lot, call.read, call.derive.seed)
    beside = tuple(replace(other, edits=edits.get(other.id, ())) for other in beside)
    own = edits.get(lot.id, ())
    derivation = derive_lot(rules, lot, options, call.derive.seed, own, beside)
    start = derivation.shape(path)
    if start is None:
        raise InputError(
            f"--at {call.at}", "is no shape of this tree", "Look at the tree above it."
        )
    rows = tree_rows(start, call.depth)
    head = heading(f"{rules.path.stem} on the lot {lot.name}", call.derive.seed, derivation)
    if call.out is None:
        sys.stdout.write(f"{head}\n{tree_text(rows)}")
    elif call.out.suffix.lower() == ".svg":
        _write(call.out, tree_svg(head.splitlines()[0], rows).encode())
    else:
        _write(call.out, f"{head}\n{tree_text(rows)}".encode())
    return 0


def _require_suffix(name: str, path: Path, known: tuple[str, ...]) -> None:
    if path.suffix.lower() not in known:
        raise InputError(f"{name} {path}", "is of no known kind", f"End it in {', '.join(known)}.")


def _write(path: Path, content: bytes) -> None:
    """The file whole or not at all."""
    from veduta.run.atomic import write_bytes

    try:
        write_bytes(path, content)
    except OSError as error:
        told = f"cannot be written ({error.strerror})"
        raise InputError(path, told, "Give another place.") from error
