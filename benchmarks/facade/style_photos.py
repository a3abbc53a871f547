"""Which style the fronts of real photos have.

    python benchmarks facade/style_photos [ecp | cmp | cmp-seen] [--images 20] [--rows FILE]

ECP val is Haussmann, by what the set is; nothing was trained or tuned on any picture of the set.
CMP, of which pictures are taken that the eyes were not trained on, has fronts of many kinds and
towns: told is the share that is none of the styles; `cmp-seen` are some that they were trained on,
for `style_odds.py`. All styles are compared, with none of them.
"""

from __future__ import annotations

import argparse
import os
import time
from pathlib import Path

import numpy as np
from facade_truth import Labelled, cmp, ecp
from record import keep_or_print
from style_odds import told_now
from style_rows import Row, logs_of, rows_of, told

from veduta.facade.analyse import analyse
from veduta.facade.document import Source
from veduta.facade.eyes import look
from veduta.facade.options import FacadeOptions, RectifyOptions
from veduta.facade.rectify import rectify
from veduta.facade.style.infer import AUTO, infer_style
from veduta.facade.style.observed import observe
from veduta.facade.style.search import SearchParameters
from veduta.imaging.read import read_image
from veduta.run.errors import NotFoundError

HERE = Path(__file__).parent

DATA = Path(os.environ.get("VEDUTA_DATA", HERE.parents[2] / "shared" / "data"))
OPTIONS = FacadeOptions(rectify=RectifyOptions(rectified=True))
RIGHT = "haussmann"
STEPS = 60
CMP_HELD_FROM = 241


def main() -> None:
    """Read, compare, print and record."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("set", nargs="?", choices=["ecp", "cmp", "cmp-seen"], default="ecp")
    parser.add_argument("--images", type=int, default=20)
    parser.add_argument("--rows", type=Path, help="where rows are kept as they come")
    parser.add_argument("--most", type=int, help="make no more than so many rows")
    parser.add_argument("--draft", action="store_true", help="keep nothing")
    call = parser.parse_args()
    pictures = ecp(DATA, "val") if call.set == "ecp" else _of_cmp(call.set == "cmp")
    paths = {one.name: one.image for one in pictures[: call.images]}
    rows = rows_of(call.rows, paths, lambda name: measured(name, paths[name]), call.most)
    rows = [with_odds(row) for row in rows]
    right = sum(row["found"] == RIGHT for row in rows)
    best = sum(row["best style"] == RIGHT for row in rows)
    none = sum(row["found"] == "none" for row in rows)
    notes = [
        f"{none} of {len(rows)} are told as none of the styles.",
        f"{right} of {len(rows)} are told as {RIGHT}; of the styles alone, {best} have it as the"
        " best.",
        "none counts: of the likelihood of the best front without a style, what the best style"
        " has.",
    ]
    keep_or_print(f"facade-style-{call.set}", told(rows), notes, not call.draft)


def with_odds(row: Row) -> Row:
    """The row with the present odds of the likelihoods that were kept: a search knows nothing of
    them.
    """
    chances = told_now(str(row["logs"])) if "logs" in row else []
    if not chances:
        return row
    second = chances[1][0] if len(chances) > 1 else ""
    found, chance = chances[0]
    return {**row, "found": found, "chance": round(chance, 4), "second": second}


def _of_cmp(held_out: bool) -> list[Labelled]:
    """Pictures of CMP that the eyes were not trained on, or every fourth of the others."""

    def is_held(one: Labelled) -> bool:
        return int(one.name.removeprefix("cmp_b")) >= CMP_HELD_FROM

    found = [one for one in cmp(DATA) if is_held(one) is held_out]
    return found if held_out else found[::4]


def measured(name: str, path: Path) -> Row:
    """One picture."""
    started = time.perf_counter()
    photo = read_image(path)
    height, width = photo.pixels.shape[:2]
    source = Source(image=path.name, sha256=photo.sha256, width_px=width, height_px=height)
    try:
        rectified = rectify(photo, OPTIONS.rectify)
        document, _ = analyse(rectified, source, OPTIONS)
        observed = observe(look(rectified.pixels), document)
        found = infer_style(document, observed, AUTO, SearchParameters(steps=STEPS))
    except NotFoundError as error:
        return {"image": name, "found": f"refused: {error}", "best style": ""}
    by_name = {one.name: one for one in found.candidates}
    none = by_name["none"].best.log_likelihood if "none" in by_name else float("nan")
    best = found.chosen.best
    choices = [f"{t.rule} {1 + (t.alternatives[0] or 0)}" for t in best.state.choices.values()]
    return {
        "image": name,
        "found": found.candidates[0].name,
        "best style": found.chosen.name,
        "chance": round(found.chances[0], 4),
        "ln likelihood": round(best.log_likelihood, 1),
        "none counts": round(best.log_likelihood / none, 2) if none > 0.0 else None,
        "second": next((c.name for c in found.candidates if c is not found.candidates[0]), ""),
        "storeys": str(best.state.attributes.get("storeys")),
        "read storeys": document.storeys,
        "choices": ", ".join(choices),
        "acceptance": _acceptance(found.chosen.searched),
        "logs": logs_of(found),
        "seconds": round(time.perf_counter() - started, 1),
    }


def _acceptance(searched: object) -> float | None:
    chains = getattr(searched, "chains", ())
    return round(float(np.mean([chains[0].acceptance])), 3) if chains else None


if __name__ == "__main__":
    main()
