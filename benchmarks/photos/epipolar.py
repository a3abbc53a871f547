"""Figure 2.7 again: the error of a fundamental matrix against the share of false matches.

    python benchmarks photos/epipolar [--no-real]

Half of the true matches of a pair are mixed with false ones, from none to 70 %, and given to each
estimator; the other half tells the mean distance from its epipolar lines. Writes a table and a
plot.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable, Sequence

import cv2
import numpy as np
import pycolmap
from epipolar_pairs import DATA, PHOTOS, Pair, Points, distances, real, synthetic
from line_plot import Line, write_plot
from record import RESULTS, Row, keep_or_print

from veduta import _core
from veduta.photos.mapping.engine import quiet_engine
from veduta.photos.matching.verify import DRAWS, MAGSAC_PX, MOST_DRAWS, SURE

SHARES = (0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7)
SYNTHETIC = 6
MOST = 300
"""True matches of a pair that are used."""
FAILED_PX = 5.0
NOTES = (
    "`mean px` is the thesis's Q_F: distances of true matches from the epipolar lines in both"
    " photos, added, over matches that the estimator did not see; the mean over the pairs, and"
    " their median, which the plot shows. A pair is `failed` beyond 5 px.",
    "False matches: points of the second photo at random. Noise of the synthetic pairs is 0.5 px.",
    "RANSAC, algorithm 3, gives each draw its own threshold, as the thesis writes; RANSAC, 3 px,"
    " one for all. LMedS: least median over 1500 draws of eight from buckets, then the normalised"
    " eight points; + M: then Huber's weights. MAGSAC++ is OpenCV's, LO-RANSAC pycolmap's (4 px,"
    " at most 1500 draws of seven: with its 10,000 it takes seconds a pair at 70 %).",
    "Beyond half of false matches their median is that of false ones: LMedS must fail there, and"
    " `veduta photos` refuses such pairs.",
    "Times are of a machine that may have had other work; the errors are not touched by that.",
)

Method = Callable[[Points, Points, int], Points | None]


def _own(name: str, limit_px: float | None = None) -> Method:
    def find(first: Points, second: Points, seed: int) -> Points | None:
        found = _core.robust_fundamental(
            first, second, name, draws=DRAWS, seed=seed, seven=False, limit_px=limit_px
        )
        return None if found is None else found[0]

    return find


def _magsac(first: Points, second: Points, seed: int) -> Points | None:
    cv2.setRNGSeed(seed)
    found = cv2.findFundamentalMat(first, second, cv2.USAC_MAGSAC, MAGSAC_PX, SURE, MOST_DRAWS)[0]
    return np.asarray(found, dtype=np.float64) if np.shape(found) == (3, 3) else None


def _engine(first: Points, second: Points, seed: int) -> Points | None:
    options = pycolmap.RANSACOptions()
    options.random_seed = seed
    options.max_num_trials = DRAWS
    found = pycolmap.estimate_fundamental_matrix(first, second, options)
    return None if found is None else np.asarray(found["F"], dtype=np.float64)


METHODS: dict[str, Method] = {
    "RANSAC, algorithm 3": _own("ransac"),
    "RANSAC, 3 px": _own("ransac", 3.0),
    "LMedS": _own("lmeds"),
    "LMedS + M": _own("lmeds-m"),
    "MAGSAC++": _magsac,
    "LO-RANSAC": _engine,
}
COLOURS = ("#999999", "#d08000", "#2878c8", "#102050", "#c02040", "#208040")


def measure(pairs: Sequence[Pair], method: Method, share: float) -> tuple[list[float], float]:
    """Q_F of each pair (px, infinite where there is no matrix), and seconds per pair."""
    errors, seconds = [], 0.0
    for number, pair in enumerate(pairs):
        rng = np.random.default_rng([number, round(100 * share)])
        order = rng.permutation(len(pair.first))[: 2 * MOST]
        told, held = order[::2], order[1::2]
        false = round(len(told) * share)
        second = pair.second[told].copy()
        second[:false] = rng.uniform((0.0, 0.0), pair.size_px, (false, 2))
        mixed = rng.permutation(len(told))
        first, second = pair.first[told][mixed], second[mixed]
        started = time.perf_counter()
        found = method(np.ascontiguousarray(first), np.ascontiguousarray(second), 1 + number)
        seconds += time.perf_counter() - started
        error = np.inf
        if found is not None:
            error = float(distances(found, pair.first[held], pair.second[held]).mean())
        errors.append(error)
    return errors, seconds / len(pairs)


def table(data: str, pairs: Sequence[Pair]) -> list[Row]:
    """A row for each method and share."""
    rows: list[Row] = []
    for name, method in METHODS.items():
        for share in SHARES:
            errors, seconds = measure(pairs, method, share)
            rows.append(
                {
                    "pairs": data,
                    "method": name,
                    "false %": round(100 * share),
                    "mean px": float(np.mean(errors)),
                    "median px": float(np.median(errors)),
                    "failed": f"{sum(error > FAILED_PX for error in errors)} of {len(errors)}",
                    "ms per pair": 1000 * seconds,
                }
            )
    return rows


def main() -> None:
    """Measure, and write the table and the plot."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--no-real", action="store_true", help="synthetic pairs alone, not kept")
    only_synthetic = parser.parse_args().no_real
    quiet_engine()
    sets = {"synthetic": [synthetic(seed) for seed in range(SYNTHETIC)]}
    if not only_synthetic:
        sets |= {name: real(name) for name in PHOTOS if (DATA / name).is_dir()}
    rows = [row for data, pairs in sets.items() for row in table(data, pairs)]
    whole = len(sets) == 1 + len(PHOTOS)
    keep_or_print("epipolar", rows, NOTES, keep=whole)
    panels = {
        f"{data}: error (px, median of pairs) by false matches (%)": [
            Line(
                name,
                colour,
                [
                    (float(str(row["false %"])), float(str(row["median px"])))
                    for row in rows
                    if row["pairs"] == data and row["method"] == name
                ],
            )
            for name, colour in zip(METHODS, COLOURS, strict=True)
        ]
        for data in sets
    }
    if whole:
        write_plot(RESULTS / "epipolar.png", panels)


if __name__ == "__main__":
    main()
