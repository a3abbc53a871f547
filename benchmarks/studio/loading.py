"""What places cost in the browser: bytes, textures, draws, and the time to the first picture.

`python benchmarks studio/loading NAME=FOLDER ... [--mbit 1.5,10] [--result loading]` serves each
place with `veduta view`, opens it in Chromium (`visit.mjs`) and keeps
`benchmarks/results/studio-RESULT.md`. Without folders it makes places of its own, without any
data (`own_places.py`): all kinds, or those of `--own "facade,60 lots"`; `--places FOLDER` keeps
them, and takes those that are there already. With `--kept FILE` rows that are there already are
not measured again: a call that is stopped goes on. What a page counts (bytes, textures, draws,
triangles, heap) does not depend on what else the machine does; times do.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from own_places import KINDS, VEDUTA, own_places
from record import Row, record

FIRST_S = 3.0
"""The first picture at 10 Mbit/s comes within so much."""
LOTS_MOST = {"sent_MB": 6.0, "card_MB": 200.0, "draws": 400.0}
"""What 60 lots may cost."""
HERE = Path(__file__).parent
ROOT = HERE.parent.parent


@contextmanager
def served(place: Path) -> Iterator[str]:
    """The address of a place while it is served."""
    server = subprocess.Popen(
        [VEDUTA, "view", place, "--no-browser"], stdout=subprocess.PIPE, text=True
    )
    try:
        if server.stdout is None:
            raise RuntimeError("the server says nothing")
        line = server.stdout.readline()
        yield line.split()[-1]
    finally:
        server.terminate()
        server.wait()


def visit(name: str, place: Path, mbit: float, picture: Path | None) -> Row:
    """One visit; mbit: how fast the network is (Mbit/s), 0 for no limit."""
    with served(place) as address:
        call: list[str | Path] = [
            "node", HERE / "visit.mjs", ROOT / "studio", address, str(mbit)
        ]  # fmt: skip
        done = subprocess.run(
            [*call, *([picture] if picture else [])], capture_output=True, text=True, check=False
        )
    if done.returncode != 0:
        return {"place": name, "mbit_s": mbit, "state": done.stderr.strip().splitlines()[-1][:80]}
    told: dict[str, float | str] = json.loads(done.stdout)
    rounded = {key: round(one, 2) if isinstance(one, float) else one for key, one in told.items()}
    return {"place": name, "mbit_s": mbit, **rounded}


def _bounds(rows: list[Row]) -> list[str]:
    """What is wanted of these places, and which of them have it."""
    told = []
    first = {str(row["place"]): row.get("first_s") for row in rows if row["mbit_s"] == 10.0}
    if first:
        late = [
            f"{name} ({seconds} s)"
            for name, seconds in first.items()
            if not isinstance(seconds, float) or seconds > FIRST_S
        ]
        verdict = f"missed by {', '.join(late)}" if late else "reached by each"
        told.append(f"Bound: first picture at 10 Mbit/s within {FIRST_S:g} s: {verdict}.")
    lots = next((row for row in rows if row["place"] == "60 lots" and "draws" in row), None)
    if lots is not None:
        parts = [f"{column} {most:g} ({lots[column]})" for column, most in LOTS_MOST.items()]
        kept = all(float(str(lots[column])) <= most for column, most in LOTS_MOST.items())
        told.append(f"Bounds of 60 lots: {', '.join(parts)}: {'reached' if kept else 'missed'}.")
    return told


def main() -> None:
    """Measure and keep."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("places", nargs="*", metavar="NAME=FOLDER")
    parser.add_argument("--own", help=f"kinds of places to make, of {', '.join(KINDS)}")
    parser.add_argument(
        "--places", dest="places_in", type=Path, help="folder for those that are made"
    )
    parser.add_argument("--mbit", default="0", help="network speeds, commas between them")
    parser.add_argument("--result", default="loading", help="name of the result's file")
    parser.add_argument("--kept", type=Path, help="JSON of rows, to go on from")
    parser.add_argument("--pictures", type=Path, help="folder for what was seen")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        named = dict(one.split("=", 1) for one in given.places)
        kinds = [kind for kind in KINDS if given.own is None or kind in given.own]
        places = {name: Path(path) for name, path in named.items()}
        places = places or own_places(given.places_in or Path(folder), kinds)
        rows = (
            list(json.loads(given.kept.read_text())) if given.kept and given.kept.exists() else []
        )
        known = {(row["place"], row["mbit_s"]) for row in rows}
        for mbit in (float(speed) for speed in given.mbit.split(",")):
            for name, place in places.items():
                if (name, mbit) in known:
                    continue
                picture = given.pictures and given.pictures / f"{name.replace(' ', '-')}.png"
                rows.append(visit(name, place, mbit, picture))
                print(rows[-1], flush=True)
                if given.kept:
                    given.kept.write_text(json.dumps(rows, indent=1))
    rows.sort(key=lambda row: (list(places).index(str(row["place"])), row["mbit_s"]))
    how = "Chromium with SwiftShader, 700x450 at 0.4, 100 ms latency"
    record(f"studio-{given.result}", rows, [how, *_bounds(rows)])


if __name__ == "__main__":
    main()
