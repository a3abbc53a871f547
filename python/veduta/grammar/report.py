"""What `report.json` and `report.html` say of a call of `veduta grammar derive`."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from veduta.grammar.failures import Failures
from veduta.grammar.left_out import LeftOut
from veduta.grammar.options import GrammarOptions
from veduta.grammar.otherwise import FIRST_TOLD
from veduta.grammar.reported import FILE, Sum, as_json, joined
from veduta.grammar.same_faults import told_once
from veduta.run.page import Bars, Page, Table, render
from veduta.run.report import Report, StepRecord

MAX_ROWS = 200
FILES = (
    ("place.json", "the buildings as one place: where each stands, in which CRS"),
    ("tileset.json", "the buildings as 3D Tiles 1.1"),
)


@dataclass
class Whole:
    """What was built in all blocks; `rows` are the buildings that have a file each.

    missing: why assets are not there whose names the rules compute.
    """

    count: int = 0
    polygons: int = 0
    triangles: int = 0
    dropped: Counter[str] = field(default_factory=Counter)
    classes: Counter[str] = field(default_factory=Counter)
    notes: Counter[str] = field(default_factory=Counter)
    missing: set[str] = field(default_factory=set)
    forms: Counter[str] = field(default_factory=Counter)
    rows: list[dict[str, Any]] = field(default_factory=list)
    blocks: list[tuple[str, dict[str, Any]]] = field(default_factory=list)

    def add(self, name: str, summary: dict[str, Any]) -> None:
        """Count a block in."""
        self.count += summary["built"]
        self.polygons += summary["polygons"]
        self.triangles += summary["triangles"]
        self.dropped.update(summary["dropped"])
        self.classes.update(summary["classes"])
        self.notes.update(summary["notes"])
        self.missing.update(summary["missing"])
        self.forms.update(summary["forms"])
        self.rows += summary["lots"]
        self.blocks.append((name, summary))


def derive_report(
    rules: str,
    options: GrammarOptions,
    whole: Whole,
    failures: Failures,
    notes: list[str],
    steps: list[StepRecord],
) -> tuple[Report, bytes]:
    """The report of all lots, and its page."""
    total = whole.count + len(failures)
    more = [f"{failures.untold:,} more failed, and are not named"] if failures.untold else []
    found = measures(whole, total)
    results = {lot["id"]: _result(lot) for lot in whole.rows}
    report = Report(
        verb="grammar",
        subject=rules,
        state="done" if whole.count else "failed",
        options=options.model_dump(mode="json"),
        steps=steps,
        measures={**found, "results": results},
        notes=[*notes, *more, *_notes(whole)],
        failures=told_once(failures.named),
    )
    page = Page(
        title=rules,
        summary=summary_line(found),
        facts=[(name, f"{found[name]:,}") for name in ("lots", "built", "surfaces", "triangles")],
        tables=_tables(whole, found) if whole.count else [],
        bars=[Bars("Time per step", "s", [(step.name, step.seconds) for step in steps])],
        files=files_of(whole),
    )
    return report, render(report, page)


def measures(whole: Whole, total: int) -> dict[str, Any]:
    """What was built, in numbers."""
    return {
        "lots": total,
        "built": whole.count,
        "surfaces": whole.classes.total(),
        "polygons": whole.polygons,
        "triangles": whole.triangles,
        "classes": dict(sorted(whole.classes.items())),
        "city": dict(sorted(whole.forms.items())),
        "reports": as_json(reported(whole)),
    }


def reported(whole: Whole) -> dict[str, Sum]:
    """What the rules reported, of all buildings."""
    return joined(summary["reports"] for _, summary in whole.blocks)


def files_of(whole: Whole) -> tuple[tuple[str, str], ...]:
    """The files that the page names."""
    tabled = any(summary["tabled"] for _, summary in whole.blocks)
    more = ((FILE, "what the rules reported of each building"),) if tabled else ()
    return FILES + more if whole.count else ()


def summary_line(found: Mapping[str, Any]) -> str:
    """What was built, in a line."""
    lots = f"{found['built']:,} of {found['lots']:,} lots built"
    return f"{lots}: {found['surfaces']:,} surfaces, {found['triangles']:,} triangles"


def _result(lot: Mapping[str, Any]) -> dict[str, Any]:
    told = {name: lot[name] for name in ("name", "model", "polygons", "triangles")}
    lost = [LeftOut(rule, count).told() for rule, count in lot["left_out"].items()]
    return {**told, "notes": [*lot["notes"], *lost], "left_out": lot["left_out"]}


def _notes(whole: Whole) -> list[str]:
    """What several buildings say is said once; of surfaces left out `told_of_all` says it."""
    said = whole.notes + Counter(note for lot in whole.rows for note in set(lot["notes"]))
    told = [f"{note} ({count} lots)" if count > 1 else note for note, count in said.items()]
    # The first of them are told at the terminal, and stand above.
    boxes = [f"{why} A box stands for it." for why in sorted(whole.missing)[FIRST_TOLD:]]
    return (told + boxes)[:50]


def _tables(whole: Whole, found: Mapping[str, Any]) -> list[Table]:
    lots = [_table(whole.rows)] if whole.rows else []
    return [_classes(found), *_forms(found), *_reports(whole), *lots]


def _classes(found: Mapping[str, Any]) -> Table:
    rows = [[name, count] for name, count in found["classes"].items()]
    note = "All of it is invented: a rule file is no record of what stands there."
    return Table("Surfaces", ("class", "count"), rows, note=note)


def _forms(found: Mapping[str, Any]) -> list[Table]:
    """What the buildings are in CityJSON, where it is written."""
    rows = [[*form.split(), count] for form, count in found["city"].items()]
    note = "A Solid is closed, which was checked; a MultiSurface has gaps or surfaces that overlap."
    columns = ("geometry", "level of detail", "buildings")
    return [Table("CityJSON", columns, rows, note=note)] if rows else []


def _reports(whole: Whole) -> list[Table]:
    """What the rules reported in numbers, where they did."""
    rows: list[list[float | str | None]] = [
        [key, one.buildings, *(_rounded(n) for n in (one.total, one.least, one.most))]
        for key, one in reported(whole).items()
    ]
    note = f"The sum of each building is in {FILE}."
    columns = ("key", "buildings", "sum", "least of a building", "most of a building")
    return [Table("Reported by the rules", columns, rows, note=note)] if rows else []


def _rounded(number: float) -> float:
    return float(f"{number:.6g}")


def _table(lots: Sequence[Mapping[str, Any]]) -> Table:
    rows = []
    for lot in lots[:MAX_ROWS]:
        low, high = lot["bounds"]
        size = [round(high[axis] - low[axis], 1) for axis in range(3)]
        rows.append([lot["name"], *size, sum(lot["classes"].values()), lot["triangles"]])
    more = len(lots) - len(rows)
    columns = ("lot", "east m", "north m", "up m", "surfaces", "triangles")
    return Table("Lots", columns, rows, note=f"{more:,} more in report.json" if more > 0 else "")
