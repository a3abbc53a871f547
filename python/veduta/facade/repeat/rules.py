"""A pattern as a rule file that people read and edit: `rules.cga`.

It stands on a lot of any size. The styles' own parts (windows, railings, shops, roofs) are
imported, in the photo's colours.
"""

from __future__ import annotations

from collections.abc import Sequence

from veduta import _core
from veduta.facade.cells import LEAST_M, metres
from veduta.facade.plan import Plan
from veduta.facade.repeat.find import find_pattern
from veduta.facade.repeat.pattern import Bay, Columns, Floor, GroundCell, Pattern
from veduta.facade.repeat.series import Run
from veduta.facade.repeat.words import (
    BALCONIES,
    BEFORE,
    DORMERS,
    FLAT_ROOF,
    GABLE,
    GROUND,
    HEAD,
    HIP,
    MANSARD,
    WALLS,
    WINDOWS,
)
from veduta.facade.rule_head import DEEP_M, LOT, RULES, SHALLOW_M, hex_colour
from veduta.facade.textures import Colours


def repeating_rules(plan: Plan, colours: Colours, photo: str) -> tuple[str, tuple[str, ...]] | None:
    """The rules of a plan in these colours, and what they leave out; None where nothing repeats.

    photo: its name, for the people who read them.
    """
    pattern = find_pattern(plan)
    if pattern is None:
        return None
    writer = _Writer(plan, pattern)
    text = "\n".join([_head(plan, colours, photo), *writer.rules()])
    return _core.grammar_format(RULES, text), pattern.notes


class _Writer:
    """The rules of one pattern, as they are written."""

    def __init__(self, plan: Plan, pattern: Pattern) -> None:
        self.plan, self.pattern = plan, pattern
        self.rows: dict[str, Columns] = {"Columns": pattern.columns}
        self.balconied = False

    def rules(self) -> list[str]:
        """All that follows the head."""
        floors = [self._floor(k, run.item) for k, run in enumerate(self.pattern.floors, start=1)]
        dormers = self._dormers()
        parts = [
            WALLS.format(rows=self._rows_of_front(), dormers="[ Dormers ] " if dormers else "")
        ]
        parts += [self._roof(), *floors]
        parts += [_row(name, columns) for name, columns in self.rows.items()]
        parts += [
            WINDOWS,
            BEFORE.format(
                dormer="Dormer(a, b)" if dormers else "NIL",
                balcony="Balcony(a, b, shallow)" if self.balconied else "NIL",
            ),
        ]
        if self.balconied:
            parts.append(BALCONIES)
        if dormers:
            parts += [dormers, DORMERS]
        if self.pattern.ground_m > 0.0:
            parts += [_ground(self.pattern.ground), GROUND]
        return parts

    def _roof(self) -> str:
        if self.plan.gable is not None:
            return GABLE if self.plan.gable.kind == "gable" else HIP
        return MANSARD if self.plan.mansard else FLAT_ROOF

    def _rows_of_front(self) -> str:
        """The cells of the front from below: the ground floor, and the floors."""
        cells = ["groundFloor : Ground"] if self.pattern.ground_m > 0.0 else []
        for number, run in enumerate(self.pattern.floors, start=1):
            cell = f"~{metres(run.item.height_m)} : Floor{number}"
            cells += [f"{{ {cell} }}*"] if run.repeats else [cell] * run.count
        return " | ".join(cells)

    def _row(self, columns: Columns | None) -> str:
        """The rule that has these columns; None for those of the front."""
        if columns is None:
            return "Columns"
        name = f"OwnColumns{len(self.rows)}"
        self.rows[name] = columns
        return name

    def _floor(self, number: int, floor: Floor) -> str:
        row = self._row(floor.own)
        first = _margin_cells((floor.own or self.pattern.columns).left_m)
        unread = "".join(f" {k + first}" for k in floor.unread)
        unread = f"{unread} " if unread else ""
        sizes = f"{metres(floor.sill_m)}, {metres(floor.high_m)}"
        windows = f'{row}("windows", {sizes}, {metres(floor.rise_m)}, "{unread}")'
        balconies = floor.balconies
        if balconies is None:
            return f"Floor{number} --> {windows}\n"
        self.balconied = True
        foot, high, beside = map(metres, (balconies.foot_m, balconies.high_m, balconies.beside_m))
        if balconies.kind == "long":
            before = f"LongBalcony({foot}, {high}, {beside})"
        else:
            before = f'{row}("balconies", {foot}, {high}, {beside}, "")'
        return f"Floor{number} --> [ {before} ] {windows}\n"

    def _dormers(self) -> str:
        dormers = self.pattern.dormers
        if dormers is None:
            return ""
        row = self._row(dormers.own)
        columns = dormers.own or self.pattern.columns
        wide = sum(bay.wide_m for bay in columns.bays) / len(columns.bays)
        beside = metres(0.5 * (dormers.wide_m - wide))
        sizes = f"{metres(dormers.up_m)}, {metres(dormers.high_m)}, {beside}"
        return f'Dormers --> t(0, scope.sy, 0) {row}("dormers", {sizes}, "")\n'


def _head(plan: Plan, colours: Colours, photo: str) -> str:
    roof = plan.mansard
    upper = plan.gable.height_m if plan.gable is not None else 0.0
    measured = None if plan.depths is None else plan.depths.median_m("balcony")
    if measured is not None and measured <= 0.0:
        measured = None  # balconies that lie back say nothing of it
    return HEAD.format(
        photo=photo.replace("*/", "* /"),
        rules=RULES,
        lot=LOT,
        width=metres(plan.width_m),
        height=metres(plan.eaves_m + upper if roof is None else roof.top_m),
        ground=metres(plan.bands[0].top_m) if plan.bands[0].floor == 0 else "0",
        setback=metres(plan.setback_m),
        lower="0" if roof is None else metres(roof.lower_m),
        upper=metres(upper) if roof is None else metres(roof.upper_m),
        angle="72" if roof is None else f"{roof.slope_deg:.4g}",
        wall=hex_colour(colours.wall),
        roof=hex_colour(colours.roof),
        shallow=metres(SHALLOW_M if measured is None else measured),
        deep=metres(DEEP_M if measured is None else measured),
    )


def _row(name: str, columns: Columns) -> str:
    """The rule of a row: `what` stands at each column, with three sizes and the columns unread."""
    cells = [f"{metres(columns.left_m)} : Beside(what)"] * _margin_cells(columns.left_m)
    for run in columns.runs:
        bay = run.item
        sizes = ", ".join(map(metres, (bay.before_m, bay.wide_m, bay.after_m)))
        call = f"Bay(what, {sizes}, a, b, c, unread, split.index)"
        cells += _repeated(run, f"~{metres(bay.width_m)} : {call}")
    cells += [f"{metres(columns.right_m)} : Beside(what)"] * _margin_cells(columns.right_m)
    return f"{name}(what, a, b, c, unread) --> split(x) {{ {' | '.join(cells)} }}\n"


def _margin_cells(wide_m: float) -> int:
    """How many cells a strip of wall beside the columns is: none where it has no width."""
    return int(wide_m > LEAST_M)


def _repeated(run: Run[Bay] | Run[GroundCell], cell: str) -> list[str]:
    return [f"{{ {cell} }}*"] if run.repeats else [cell] * run.count


def _ground(runs: Sequence[Run[GroundCell]]) -> str:
    cells: list[str] = []
    for run in runs:
        cell = run.item
        width = metres(cell.bay.width_m)
        sizes = (cell.bay.before_m, cell.bay.wide_m, cell.bay.after_m, cell.sill_m, cell.high_m)
        call = "Wall."
        if cell.kind is not None:
            call = f'GroundBay("{cell.kind}", {", ".join(map(metres, sizes))})'
        cells += _repeated(run, f"~{width} : {call}")
    return f"Ground --> split(x) {{ {' | '.join(cells)} }}\n"
