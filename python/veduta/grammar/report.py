"""What `report.json` and `report.html` say of a call of `veduta grammar derive`."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any

from veduta.grammar.options import GrammarOptions
from veduta.run.page import Bars, Page, Table, render
from veduta.run.report import Failure, Report, StepRecord

MAX_ROWS = 200
FILES = (
    ("place.json", "the buildings as one place: where each stands, in which CRS"),
    ("parts/NN/NAME.glb", "one building as glTF 2.0"),
)


def derive_report(
    rules: str,
    options: GrammarOptions,
    lots: Sequence[Mapping[str, Any]],
    failures: Sequence[Failure],
    notes: list[str],
    steps: list[StepRecord],
) -> tuple[Report, bytes]:
    """The report of all lots, and its page."""
    total = len(lots) + len(failures)
    found = measures(lots, total)
    report = Report(
        verb="grammar",
        subject=rules,
        state="done" if lots else "failed",
        options=options.model_dump(mode="json"),
        steps=steps,
        measures={**found, "results": {lot["id"]: _result(lot) for lot in lots}},
        notes=[*notes, *_notes(lots)],
        failures=list(failures),
    )
    page = Page(
        title=rules,
        summary=summary_line(found),
        facts=[(name, f"{found[name]:,}") for name in ("lots", "built", "surfaces", "triangles")],
        tables=[_classes(found), _table(lots)] if lots else [],
        bars=[Bars("Time per step", "s", [(step.name, step.seconds) for step in steps])],
        files=FILES[:1] if lots else (),
    )
    return report, render(report, page)


def measures(lots: Sequence[Mapping[str, Any]], total: int) -> dict[str, Any]:
    """What was built, in numbers."""
    classes: Counter[str] = Counter()
    for lot in lots:
        classes.update(lot["classes"])
    return {
        "lots": total,
        "built": len(lots),
        "surfaces": sum(classes.values()),
        "polygons": sum(lot["polygons"] for lot in lots),
        "triangles": sum(lot["triangles"] for lot in lots),
        "classes": dict(sorted(classes.items())),
    }


def summary_line(found: Mapping[str, Any]) -> str:
    """What was built, in a line."""
    lots = f"{found['built']:,} of {found['lots']:,} lots built"
    return f"{lots}: {found['surfaces']:,} surfaces, {found['triangles']:,} triangles"


def _result(lot: Mapping[str, Any]) -> dict[str, Any]:
    return {name: lot[name] for name in ("name", "model", "polygons", "triangles", "notes")}


def _notes(lots: Sequence[Mapping[str, Any]]) -> list[str]:
    """What several buildings say is said once."""
    said = Counter(note for lot in lots for note in lot["notes"])
    return [f"{note} ({count} lots)" if count > 1 else note for note, count in said.items()][:50]


def _classes(found: Mapping[str, Any]) -> Table:
    rows = [[name, count] for name, count in found["classes"].items()]
    note = "All of it is invented: a rule file is no record of what stands there."
    return Table("Surfaces", ("class", "count"), rows, note=note)


def _table(lots: Sequence[Mapping[str, Any]]) -> Table:
    rows = []
    for lot in lots[:MAX_ROWS]:
        low, high = lot["bounds"]
        size = [round(high[axis] - low[axis], 1) for axis in range(3)]
        rows.append([lot["name"], *size, sum(lot["classes"].values()), lot["triangles"]])
    more = len(lots) - len(rows)
    columns = ("lot", "east m", "north m", "up m", "surfaces", "triangles")
    return Table("Lots", columns, rows, note=f"{more:,} more in report.json" if more > 0 else "")
