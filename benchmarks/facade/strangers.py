"""How whole houses of strangers' photos come out, judged by eye: draws that nobody had looked at.

    python benchmarks facade/strangers [--link FOLDER] [--draft]

Three draws by one seed from what the eyes were not trained on: CMP from b0241 on, and every
fifth of `facades/street-cc0-boxes`. FOLDER gets links to the pictures of each draw, to run
`veduta facade` on (those of CMP with `--rectified`). `strangers_judged.json` says of the last draw,
looked at by one person as photo, elements and a render of the building side by side, what came out
before and after the work that the first draw led to.
"""

from __future__ import annotations

import argparse
import json
import os
import random
from collections import Counter
from pathlib import Path

from record import Row, keep_or_print

HERE = Path(__file__).parent
DATA = Path(os.environ.get("VEDUTA_DATA", HERE.parents[2] / "shared" / "data")) / "facades"
SEED = 3501
LEFT_OUT = (252, 270, 280)
"""Of CMP: faults of these were known before."""
DRAWS = {"first": (0, 8, 0, 6), "second": (8, 16, 6, 12), "third": (16, 28, 12, 20)}
"""From and to of the shuffled pictures of CMP, and of the street photos."""
VERDICTS = ("right", "usable", "wrong", "refused")


def main() -> None:
    """Link the draws, and count what was judged."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--link", type=Path, help="a folder for links to the pictures")
    parser.add_argument("--draft", action="store_true", help="keep nothing")
    call = parser.parse_args()
    draws = drawn()
    if call.link is not None:
        linked(draws, call.link)
    judged = json.loads((HERE / "strangers_judged.json").read_text("utf-8"))
    rows = [
        row_of(when, kind, [judged[p.stem] for p in draws["third"] if is_of(kind, p)])
        for kind in ("CMP", "street")
        for when in ("before", "now")
    ]
    keep_or_print("facade-strangers", rows, [LEGEND, *faults(judged)], not call.draft)


LEGEND = (
    "right: storeys, windows and sides as in the photo, but for a few small things; usable: the"
    " right house with some openings or a part missing or too many; wrong: storeys, sides or roof"
    " of another house, or a third of the openings; refused: told as no facade. A close view of a"
    " part of a front is right where it is a plane with its openings. Judged by the one who mended"
    " what the first draw showed, who had not looked at these pictures before."
)


def drawn() -> dict[str, list[Path]]:
    """The pictures of each draw."""
    cmp = [f"cmp_b{n:04d}" for n in range(241, 301) if n not in LEFT_OUT]
    photos = sorted(
        (DATA / "street-cc0-boxes/images").glob("*.jpg"), key=lambda p: int(p.stem.split("_")[1])
    )[::5]
    chance = random.Random(SEED)
    chance.shuffle(cmp)
    chance.shuffle(photos)
    return {
        name: [*(DATA / f"cmp/{one}.jpg" for one in cmp[a:b]), *photos[c:d]]
        for name, (a, b, c, d) in DRAWS.items()
    }


def linked(draws: dict[str, list[Path]], folder: Path) -> None:
    """A folder of links for each draw, by kind."""
    for name, paths in draws.items():
        for path in paths:
            place = folder / name / ("cmp" if is_of("CMP", path) else "street")
            place.mkdir(parents=True, exist_ok=True)
            link = place / path.name
            if not link.exists():
                link.symlink_to(path.resolve())


def is_of(kind: str, path: Path) -> bool:
    """Whether a picture is of CMP, or of the street photos."""
    return path.stem.startswith("cmp_") == (kind == "CMP")


def row_of(when: str, kind: str, judged: list[dict[str, str]]) -> Row:
    """How many came out how."""
    counts = Counter(one[when] for one in judged)
    row: dict[str, str | int] = {"pictures": kind, "when": when, "in all": len(judged)}
    row.update((verdict, counts[verdict]) for verdict in VERDICTS)
    return row


def faults(judged: dict[str, dict[str, str]]) -> list[str]:
    """What is still wrong, by picture."""
    return [f"{name}: {one['fault']}" for name, one in judged.items() if one.get("fault")]


if __name__ == "__main__":
    main()
