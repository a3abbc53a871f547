"""Styles and structures found again in rendered fronts whose structure is known.

    python benchmarks facade/style_synthetic [STYLE ...] [--fronts 6] [--first 100] [--rows FILE]

Fronts of five styles are drawn by the rules, rendered and read as photos are, with the picture's
corners as those of the front. Counted: whether the likeliest style is the right one; of the
random choices that one can see, how many the best structure of the right style has; whether the
truth is likelier than the best that was found. All styles are compared, with none of them. Seeds
from 100 on were used for nothing else.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from real_fronts import as_real
from record import keep_or_print
from style_fronts import TrueFront, read_front, true_front
from style_rows import Row, logs_of, rows_of, told

from veduta.facade.style.grammar import ANY_FRONT
from veduta.facade.style.infer import AUTO, Candidate, StyleFound, infer_style
from veduta.facade.style.other_searches import anneal, greedy
from veduta.facade.style.search import SearchParameters, search
from veduta.facade.style.starts import climbed
from veduta.facade.style.state import SCALE

STYLES = ("haussmann", "louis-xiii", "louis-xiv", "empire", "restauration")
FIRST = 100
ALLOWED_NATS = 1.0


def main() -> None:
    """Render, read, compare, print and record."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("styles", nargs="*", default=list(STYLES))
    parser.add_argument("--fronts", type=int, default=6, help="of each style")
    parser.add_argument("--first", type=int, default=FIRST, help="the first seed")
    parser.add_argument("--steps", type=int, default=400)
    parser.add_argument("--real", action="store_true", help="with the faults of real fronts")
    parser.add_argument("--searches", type=int, default=1, help="fronts with the other searches")
    parser.add_argument("--rows", type=Path, help="where rows are kept as they come")
    parser.add_argument("--most", type=int, help="make no more than so many rows")
    parser.add_argument("--draft", action="store_true", help="keep nothing")
    call = parser.parse_args()
    seeds = range(call.first, call.first + call.fronts)
    keys = [f"{k} {s}" for k in seeds for s in call.styles]

    def make(key: str) -> Row:
        seed, style = key.split()
        others = int(seed) < call.first + call.searches
        front = true_front(style, int(seed))
        if call.real:
            front = replace(front, pixels=as_real(front.pixels, front.px_per_m, int(seed)))
        return measured(front, int(seed), call.steps, others)

    rows = rows_of(call.rows, keys, make, call.most)
    name = "facade-style-synthetic-real" if call.real else "facade-style-synthetic"
    keep_or_print(name, [*summary(rows), *told(rows)], NOTES, not call.draft)


NOTES = [
    "choices: random choices of the rules that one sees in the front; right are those that the best"
    " structure of the right style has at the same shape.",
    "gap: ln posterior of the best found of the right style less that of the truth; below -1 the"
    " search has missed something.",
    "mh, greedy, annealing: ln posterior of the best of each at equal time, from the same start,"
    " less that of the truth.",
]


def measured(front: TrueFront, seed: int, steps: int, others: bool) -> Row:
    """One front."""
    started = time.perf_counter()
    row: Row = {"style": front.style, "seed": seed}
    read = read_front(front.pixels, f"{front.style}-{seed}.png")
    if read.document is None or read.observed is None:
        return {**row, "found": f"refused: {read.reason}", "right": False}
    found = infer_style(read.document, read.observed, AUTO, SearchParameters(steps=steps))
    own = next((one for one in found.candidates if one.name == front.style), None)
    row |= {
        "found": found.candidates[0].name,
        "right": found.candidates[0].name == front.style,
        "best style": found.chosen.name,
        "chance": round(found.chances[0], 4),
        "none counts": _share_of_any(found, front.style),
        "storeys": read.document.storeys,
        "logs": logs_of(found),
    }
    if own is not None:
        row |= _structure(front, own, steps, others)
    return {**row, "seconds": round(time.perf_counter() - started, 1)}


def _share_of_any(found: StyleFound, style: str) -> float | None:
    """Of the likelihood of the best front without a style, what the right style has."""
    by_name = {one.name: one.best.log_likelihood for one in found.candidates}
    if style not in by_name or by_name.get(ANY_FRONT, 0.0) <= 0.0:
        return None
    return round(by_name[style] / by_name[ANY_FRONT], 3)


def _structure(front: TrueFront, own: Candidate, steps: int, others: bool) -> Row:
    """How near the best structure of the right style is to the truth."""
    rng = np.random.default_rng(7)
    posterior = own.posterior
    searched = own.searched
    if searched is None:
        searched = search(posterior, [own.best], rng, SearchParameters(steps=steps))
    truth_state = front.state.with_attributes(**{SCALE: front.width_m / posterior.grammar.width_m})
    truth = posterior.score(truth_state, rng)
    best = searched.best
    right = sum(
        best.state.choices.get(path) == taken for path, taken in front.state.choices.items()
    )
    row: Row = {
        "choices": len(front.state.choices),
        "right choices": right,
    }
    if truth is None:
        return row
    level = truth.log_posterior
    row |= {
        "gap": round(best.log_posterior - level, 2),
        "truth's likelihood": round(truth.log_likelihood, 1),
        "best's likelihood": round(best.log_likelihood, 1),
        "acceptance": round(searched.chains[0].acceptance, 3),
    }
    if not others:
        return row
    start = climbed(posterior, posterior.grammar.start(), rng) or own.best
    seconds = 0.5 * searched.seconds
    timed = SearchParameters(seconds=seconds, steps=10**9)
    row |= {
        "mh": round(search(posterior, [start], rng, timed).best.log_posterior - level, 1),
        "greedy": round(greedy(posterior, start, rng, seconds).log_posterior - level, 1),
        "annealing": round(anneal(posterior, start, rng, seconds).log_posterior - level, 1),
    }
    return row


def summary(rows: Sequence[Row]) -> list[Row]:
    """A line for each style, and one for all."""
    names = list(dict.fromkeys(str(row["style"]) for row in rows))
    return [_line(name, [row for row in rows if row["style"] == name]) for name in names] + [
        _line("all", rows)
    ]


def _line(name: str, rows: Sequence[Row]) -> Row:
    choices = sum(_number(row, "choices") for row in rows)
    gaps = [float(str(row["gap"])) for row in rows if "gap" in row]
    reached = [gap >= -ALLOWED_NATS for gap in gaps]
    return {
        "style": name,
        "fronts": len(rows),
        "right": round(float(np.mean([bool(row["right"]) for row in rows])), 3),
        "choices": choices,
        "right choices": round(sum(_number(r, "right choices") for r in rows) / max(1, choices), 3),
        "truth not above by 1 nat": round(float(np.mean(reached)), 3) if reached else None,
        **{key: _median(rows, key) for key in ("gap", "mh", "greedy", "annealing", "seconds")},
    }


def _number(row: Row, key: str) -> int:
    return int(str(row.get(key, 0)))


def _median(rows: Sequence[Row], key: str) -> float | None:
    values = [float(str(row[key])) for row in rows if row.get(key) is not None]
    return round(float(np.median(values)), 2) if values else None


if __name__ == "__main__":
    main()
