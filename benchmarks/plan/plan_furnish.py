"""How synthetic houses are furnished: overlaps, doors that are shut, the same again, time.

    python benchmarks plan/plan_furnish [--seeds A..B]

The houses are `veduta.synthetic.plans` as perfect documents (seeds 10000 to 10099 unless told);
only a run over all of these is kept. Asked for: no overlap, all doors reachable in all houses, the
same seed gives the same house, a house of ten rooms in under 3 s.
"""

from __future__ import annotations

import argparse
import statistics
import time
from collections import Counter

from plan_documents import document_of
from plan_furnish_checks import doors_shut, overlaps
from plan_sets import seeds
from record import Row, keep_or_print

from veduta.plan.furnish.catalogue.read import builtin_catalogue
from veduta.plan.furnish.furnish import FurnishedRoom, furnish
from veduta.synthetic.plans.layout import make_house
from veduta.synthetic.plans.sets import FIRST_TEST_SEED

SEEDS = range(FIRST_TEST_SEED, FIRST_TEST_SEED + 100)
SLAB_M = 0.25
NOTES = (
    "Checked from the documents alone (plan_furnish_checks.py): boxes of things against each other"
    " and against walls; doors by a disc of 25 cm on cells of 2 cm, against the empty house.",
    "Seconds are of one process, placing alone, without reading plans and building models; beside"
    " other work. On a quiet machine on 2026-11-25 they were 0.20 in the median, 0.58 at most.",
    "Critical things without a place: a bed in a bedroom, a toilet in a bathroom and the like.",
)


def main() -> None:
    """Furnish each house twice, check it, and print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=seeds, default=SEEDS)
    chosen = parser.parse_args().seeds
    catalogue = builtin_catalogue()
    clashes: list[str] = []
    shut: list[str] = []
    different: list[int] = []
    done: list[FurnishedRoom] = []
    times: list[tuple[int, float]] = []
    for seed in chosen:
        document = document_of(make_house(seed))
        start = time.process_time()
        first, rooms = furnish(document, catalogue, seed, SLAB_M)
        times.append((len(rooms), time.process_time() - start))
        second, _ = furnish(document, catalogue, seed, SLAB_M)
        done += rooms
        if first.model_dump_json() != second.model_dump_json():
            different.append(seed)
        for storey in first.storeys:
            clashes += [f"{seed} {storey.name}: {a} and {b}" for a, b in overlaps(storey)]
            shut += [f"{seed} {storey.name}: {door}" for door in doors_shut(storey)]
    for line in (*clashes, *shut):
        print(line)
    rows = [*_rows(len(chosen), clashes, shut, different, times), *_by_use(done, catalogue.wanted)]
    keep_or_print("plan-furnish", rows, NOTES, list(chosen) == list(SEEDS))


def _rows(
    houses: int, clashes: list[str], shut: list[str], different: list[int],
    times: list[tuple[int, float]],
) -> list[Row]:  # fmt: skip
    per_ten = [10.0 * seconds / rooms for rooms, seconds in times]
    return [
        {
            "what": "all", "houses": houses, "rooms": sum(rooms for rooms, _ in times),
            "overlaps": len(clashes), "doors shut": len(shut), "not the same": len(different),
            "s per ten rooms": statistics.median(per_ten), "most": max(per_ten),
        }
    ]  # fmt: skip


def _by_use(done: list[FurnishedRoom], wanted) -> list[Row]:  # type: ignore[no-untyped-def]
    critical = {(one.use, one.type) for one in wanted if one.critical}
    rows: list[Row] = []
    for use, count in sorted(Counter(room.room.use for room in done).items()):
        own = [room for room in done if room.room.use == use]
        missing = Counter(kind for room in own for kind in room.missing if (use, kind) in critical)
        rows.append(
            {
                "what": use, "rooms": count,
                "things": round(statistics.mean(len(room.stood) for room in own), 1),
                "critical without a place": ", ".join(f"{n} {k}" for k, n in missing.items()),
            }
        )  # fmt: skip
    return rows


if __name__ == "__main__":
    main()
