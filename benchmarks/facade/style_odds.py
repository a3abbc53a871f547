"""Fit what the odds of styles are made with: a temperature, and how likely none of them is.

    python benchmarks facade/style_odds --renders ROWS --none ROWS [--check ROWS]
        [--check-none ROWS] [--draft]

ROWS are files that `style_synthetic.py --real --rows` (seeds below 100) and `style_photos.py
cmp-seen --rows` wrote: the likelihood and prior mass of each candidate. A render counts twice: with
its own style among the candidates, which then is right, and without it, when none of them is.
Pictures of CMP are taken to have none of the styles, which is not true of all of them. Fitted are
the temperature, by the chance that renders give to their own style among the styles, and the three
numbers of `infer.log_odds_of_none`, by the chance of what is right, each group weighing as much as
the others that have the same answer. No Parisian set is among them. Checked are other renders and
pictures of CMP that nothing was fitted to.
"""

from __future__ import annotations

import argparse
import json
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from logistic import likeliest
from numpy.typing import NDArray
from record import Row, keep_or_print

from veduta.facade.style.infer import USUAL, InferParameters, log_odds_of_none

NONE, ANY = "none", "any"
TEMPERATURES = np.geomspace(1.0, 60.0, 40).round(2).tolist()
RIDGE = 0.01
Float = NDArray[np.float64]


@dataclass(frozen=True)
class Case:
    """The styles of a front by name: ln likelihood (deformed) and ln evidence; the likelihood of
    the best front without one, the most that labels of cells can have; and what is right.
    """

    styles: dict[str, tuple[float, float]]
    none: float
    most: float
    right: str

    @property
    def best(self) -> str:
        """The style with most evidence."""
        return max(self.styles, key=lambda name: self.styles[name][1])

    @property
    def signs(self) -> Float:
        """(3,) what the odds of none are a sum of."""
        style = self.styles[self.best][0]
        return np.array([1.0, -(style - self.none) / self.most, -style / self.most])

    def chances(self, own: InferParameters) -> dict[str, float]:
        """As `infer.ranked` has them."""
        style = self.styles[self.best][0]
        log_odds = log_odds_of_none(style, self.none, self.most, own)
        none = 1.0 / (1.0 + len(self.styles) * math.exp(-log_odds))
        logs = {name: one[1] / own.temperature for name, one in self.styles.items()}
        total = np.logaddexp.reduce(list(logs.values()))
        told = {name: (1.0 - none) * float(np.exp(log - total)) for name, log in logs.items()}
        return {**told, NONE: none}


def main() -> None:
    """Fit, print and record."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--renders", type=Path, required=True)
    parser.add_argument("--none", type=Path, required=True)
    parser.add_argument("--check", type=Path, help="renders that nothing is fitted to")
    parser.add_argument("--check-none", type=Path, help="the same of pictures of CMP")
    parser.add_argument("--draft", action="store_true", help="keep nothing")
    call = parser.parse_args()
    own, without = rendered(call.renders)
    none = photographed(call.none)
    fitted = fit(own, without, none)
    groups = {
        "renders, fitted to": own,
        "the same without their style": without,
        "CMP, fitted to": none,
    }
    if call.check:
        groups |= dict(
            zip(
                ("other renders", "the same without their style,"),
                rendered(call.check),
                strict=True,
            )
        )
    if call.check_none:
        groups["CMP, others"] = photographed(call.check_none)
    rows = [_row(name, cases, fitted) for name, cases in groups.items() if cases]
    notes = [
        f"The fit: temperature {fitted.temperature}, none {fitted.none_offset:.1f},"
        f" {fitted.none_worse:.1f}, {fitted.none_apart:.1f}, of {len(own)} renders and"
        f" {len(none)} pictures of CMP. The step has {USUAL.temperature},"
        f" {USUAL.none_offset:.1f}, {USUAL.none_worse:.1f}, {USUAL.none_apart:.1f}.",
        "style: of the styles alone, the own one is the likeliest. right: so is what is right with"
        " none of them as likely before as each; even: with it as likely as all of them together.",
    ]
    keep_or_print("facade-style-odds", rows, notes, not call.draft)


def _logs(path: Path) -> list[tuple[str, dict[str, list[float]]]]:
    rows = [json.loads(line) for line in path.read_text("utf-8").splitlines()]
    return [(key, json.loads(row["logs"])) for key, row in rows if "logs" in row]


def _case(logs: dict[str, list[float]], right: str, left_out: str = "") -> Case | None:
    styles = {
        name: (values[4] + values[5], values[4] + values[5] + values[1])
        for name, values in logs.items()
        if name not in (NONE, ANY, left_out)
    }
    if NONE not in logs or not styles:
        return None
    return Case(styles, logs[NONE][4] + logs[NONE][5], logs[ANY][0], right)


def rendered(path: Path) -> tuple[list[Case], list[Case]]:
    """Renders with their own style among the candidates, and without it."""
    found = [(key.split()[1], logs) for key, logs in dict(_logs(path)).items()]
    own = [_case(logs, style) for style, logs in found if style in logs]
    without = [_case(logs, NONE, style) for style, logs in found]
    return [c for c in own if c is not None], [c for c in without if c is not None]


def told_now(logs: str) -> list[tuple[str, float]]:
    """What the step tells by its present odds of a front whose likelihoods were kept, as JSON."""
    case = _case(json.loads(logs), NONE)
    return [] if case is None else sorted(case.chances(USUAL).items(), key=lambda one: -one[1])


def photographed(path: Path) -> list[Case]:
    """Pictures that have none of the styles."""
    found = [_case(logs, NONE) for logs in dict(_logs(path)).values()]
    return [case for case in found if case is not None]


def fit(own: Sequence[Case], without: Sequence[Case], none: Sequence[Case]) -> InferParameters:
    """Temperature, and the odds of none, by the likeliest logistic model (Newton's method)."""
    temperature = max(TEMPERATURES, key=lambda one: _among_styles(own, one))
    groups = ((own, 0.0, 2.0), (without, 1.0, 1.0), (none, 1.0, 1.0))
    signs = np.array([case.signs for cases, _, _ in groups for case in cases])
    right = np.concatenate([np.full(len(cases), is_none) for cases, is_none, _ in groups])
    weight = np.concatenate([np.full(len(c), 10.0 * w / max(1, len(c))) for c, _, w in groups])
    at = likeliest(signs, right, weight, RIDGE, 100)
    offset, worse, apart = at.round(1).tolist()
    return replace(
        USUAL,
        temperature=temperature,
        none_offset=offset,
        none_worse=worse,
        none_apart=apart,
    )


def _among_styles(own: Sequence[Case], temperature: float) -> float:
    """Mean logarithm of the chance of the own style among the styles.

    As if one front more than there are had the second style for its own: where all are told rightly
    no temperature would be low enough.
    """
    wrong = 1.0 / (len(own) + 2.0)
    logs = []
    for case in own:
        every = np.array([one[1] for one in case.styles.values()]) / temperature
        total = float(np.logaddexp.reduce(every))
        right = case.styles[case.right][1] / temperature - total
        others = [one[1] for name, one in case.styles.items() if name != case.right]
        logs.append((1.0 - wrong) * right + wrong * (max(others) / temperature - total))
    return float(np.mean(logs))


def _row(name: str, cases: Sequence[Case], own: InferParameters) -> Row:
    told = [case.chances(own) for case in cases]
    best = [max(chances, key=lambda one: chances[one]) for chances in told]
    has_style = [case for case in cases if case.right != NONE]
    even = []
    for case in cases:
        style = case.styles[case.best][0]
        is_none = log_odds_of_none(style, case.none, case.most, own) > 0.0
        even.append((NONE if is_none else case.best) == case.right)
    return {
        "fronts": name,
        "number": len(cases),
        "style": sum(c.best == c.right for c in has_style) if has_style else None,
        "right": sum(c.right == b for c, b in zip(cases, best, strict=True)),
        "even": sum(even),
        "mean chance of what is told": float(np.mean([max(one.values()) for one in told])),
    }


if __name__ == "__main__":
    main()
