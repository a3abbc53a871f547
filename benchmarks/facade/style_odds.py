"""Fit what the odds of styles are made with: a temperature, and what no style counts.

    python benchmarks facade/style_odds --renders ROWS --none ROWS [--check ROWS] [--draft]

ROWS are files that `style_synthetic.py --rows` (seeds below 100) and `style_photos.py cmp-seen
--rows` wrote: the likelihood and prior mass of each candidate. A render counts twice: with its own
style among the candidates, which then is right, and without it, when none of them is. Pictures of
CMP are taken to have none of the styles, which is not true of all of them. Fitted is the mean
logarithm of the chance of what is right; the table has how often what is told with some chance is
right, in the fit and on other renders (`--check`).
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

HERE = Path(__file__).parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

from record import Row, keep_or_print  # noqa: E402

from veduta.facade.style.infer import USUAL  # noqa: E402

NONE = "none"
TEMPERATURES = np.geomspace(1.0, 60.0, 25).round(2).tolist()
COUNTS = np.linspace(0.4, 1.0, 25).round(3).tolist()
BINS = (0.0, 0.5, 0.8, 0.95, 1.0)
Float = NDArray[np.float64]


@dataclass(frozen=True)
class Case:
    """The candidates of a front, by name: ln likelihood and ln mass; and which is right."""

    candidates: dict[str, tuple[float, float]]
    right: str

    def chances(self, temperature: float, counts: float) -> dict[str, float]:
        """As `infer.ranked` has them."""
        logs = {}
        for name, (likelihood, mass) in self.candidates.items():
            own = min(likelihood, counts * likelihood) if name == NONE else likelihood
            logs[name] = (own + mass) / temperature
        total = np.logaddexp.reduce(list(logs.values()))
        return {name: float(np.exp(log - total)) for name, log in logs.items()}


def main() -> None:
    """Fit, print and record."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--renders", type=Path, required=True)
    parser.add_argument("--none", type=Path, required=True)
    parser.add_argument("--check", type=Path, help="renders that nothing is fitted to")
    parser.add_argument("--draft", action="store_true", help="keep nothing")
    call = parser.parse_args()
    renders, none = rendered(call.renders), photographed(call.none)
    groups = [one for one in (renders[0], renders[1], none) if one]
    scored = {pair: _fit(groups, *pair) for pair in product(TEMPERATURES, COUNTS)}
    best = max(scored, key=lambda pair: scored[pair])
    used = USUAL.temperature, USUAL.none_counts
    fitted = [one for group in groups for one in group]
    rows = [*_table("fit, as before (1, 0.65)", fitted, 1.0, 0.65), *_table("fit", fitted, *best)]
    if call.check:
        own, without = rendered(call.check)
        rows += _table("other renders, as the step has them", [*own, *without], *used)
    notes = [
        f"Best: temperature {best[0]}, none counts {best[1]}, of {len(renders[0])} renders, as many"
        f" without their own style, and {len(none)} pictures of CMP, each group weighing as much.",
        f"The step has {used[0]} and {used[1]}.",
    ]
    keep_or_print("facade-style-odds", rows, notes, not call.draft)


def _logs(path: Path) -> list[tuple[str, dict[str, tuple[float, float]]]]:
    rows = [json.loads(line) for line in path.read_text("utf-8").splitlines()]
    return [(key, json.loads(row["logs"])) for key, row in rows if "logs" in row]


def rendered(path: Path) -> tuple[list[Case], list[Case]]:
    """Renders with their own style among the candidates, and without it."""
    found = [(key.split()[1], logs) for key, logs in _logs(path)]
    own = [Case(logs, style) for style, logs in found if style in logs and NONE in logs]
    without = [
        Case({name: log for name, log in logs.items() if name != style}, NONE)
        for style, logs in found
        if NONE in logs
    ]
    return own, without


def photographed(path: Path) -> list[Case]:
    """Pictures that have none of the styles."""
    return [Case(logs, NONE) for _, logs in _logs(path) if NONE in logs]


def _fit(groups: Sequence[Sequence[Case]], temperature: float, counts: float) -> float:
    """Mean logarithm of the chance of what is right, each group weighing as much."""
    means = [
        np.mean([np.log(max(c.chances(temperature, counts)[c.right], 1e-12)) for c in group])
        for group in groups
    ]
    return float(np.mean(means))


def _table(name: str, cases: Sequence[Case], temperature: float, counts: float) -> list[Row]:
    """How often what is told is right, by the chance that it is told with."""
    told = [case.chances(temperature, counts) for case in cases]
    best = [max(chances, key=lambda one: chances[one]) for chances in told]
    sure = np.array([chances[one] for chances, one in zip(told, best, strict=True)])
    right = np.array([case.right == one for case, one in zip(cases, best, strict=True)])
    rows: list[Row] = []
    for low, high in zip(BINS, BINS[1:], strict=False):
        inside = (sure > low) & (sure <= high)
        if inside.any():
            rows.append(
                {
                    "fronts": name,
                    "told with": f"{low:g} to {high:g}",
                    "number": int(inside.sum()),
                    "mean chance": float(sure[inside].mean()),
                    "right": float(right[inside].mean()),
                }
            )
    return rows


if __name__ == "__main__":
    main()
