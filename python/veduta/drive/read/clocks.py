"""How far the clocks of two scanners are apart, from what both see in the line where they meet.

A vertical and a horizontal scanner at one place share a beam: to the side, level. What the one
measures along it the other measures, too, so much later as their clocks differ.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.drive.document.log import Scanner

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class ClockParameters:
    """most_s: clocks are not farther apart. every_s: steps of the search. near_m, near_rad: the
    scanners and their shared beams are so close. longest_m: ranges are cut there, so that gaps do
    not rule. least: correlation below which nothing is told. fewest_s: shorter drives tell
    nothing. most_times: of the first so many scans of each.
    """

    most_s: float = 0.5
    every_s: float = 0.005
    near_m: float = 0.3
    near_rad: float = 0.02
    longest_m: float = 40.0
    least: float = 0.5
    fewest_s: float = 5.0
    most_times: int = 20_000


def shared_beams(
    one: Scanner,
    one_beams: int,
    other: Scanner,
    other_beams: int,
    parameters: ClockParameters | None = None,
) -> tuple[int, int] | None:
    """The beams of two scanners that point the same way from about the same place; else None."""
    chosen = parameters or ClockParameters()
    mounts = [np.reshape(scanner.vehicle_from_scanner, (3, 4)) for scanner in (one, other)]
    if np.linalg.norm(mounts[0][:, 3] - mounts[1][:, 3]) > chosen.near_m:
        return None
    ways = []
    for scanner, mount, beams in zip((one, other), mounts, (one_beams, other_beams), strict=True):
        angles = scanner.first_beam_rad + np.arange(beams) * scanner.beam_step_rad
        flat = np.stack([np.cos(angles), np.sin(angles), np.zeros(beams)], axis=1)
        ways.append(flat @ mount[:, :3].T)
    alike = ways[0] @ ways[1].T
    first, second = np.unravel_index(int(np.argmax(alike)), alike.shape)
    if np.arccos(min(float(alike[first, second]), 1.0)) > chosen.near_rad:
        return None
    return int(first), int(second)


def clock_apart(
    times: Floats,
    ranges: Floats,
    other_times: Floats,
    other_ranges: Floats,
    parameters: ClockParameters | None = None,
) -> float | None:
    """Seconds to add to `times` to get those of the other, from ranges along the shared beam.

    None where the drive is too short or too little changes along the way to tell.
    """
    chosen = parameters or ClockParameters()
    series = []
    for own, values in ((times, ranges), (other_times, other_ranges)):
        kept = np.isfinite(values) & (values > 0.0)
        if kept.sum() < 20:
            return None
        series.append((own[kept], np.minimum(values[kept], chosen.longest_m)))
    begin = max(one[0][0] for one in series) + chosen.most_s
    end = min(one[0][-1] for one in series) - chosen.most_s
    if end - begin < chosen.fewest_s:
        return None
    at = np.arange(begin, end, chosen.every_s)
    fixed = _changes(np.interp(at, *series[1]))
    shifts = np.arange(-chosen.most_s, chosen.most_s + 1e-9, chosen.every_s)
    alike = np.array([fixed @ _changes(np.interp(at - shift, *series[0])) for shift in shifts])
    best = int(np.argmax(alike))
    if alike[best] < chosen.least or best in (0, len(shifts) - 1):
        return None
    before, top, after = alike[best - 1 : best + 2]
    bend = before - 2.0 * top + after
    off = 0.0 if bend >= 0.0 else 0.5 * (before - after) / bend
    return float(shifts[best] + off * chosen.every_s)


def _changes(values: Floats) -> Floats:
    centred = values - values.mean()
    return np.asarray(centred / max(float(np.linalg.norm(centred)), 1e-12), dtype=np.float64)
