"""Which feet stand on the ground, and when (figure 13 of the paper)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import binary_closing, binary_opening, gaussian_filter1d

from veduta.fauna.motion.figure import Floats

Chart = NDArray[np.bool_]


@dataclass(frozen=True)
class FeetLooks:
    """When a foot stands: it goes back under the body as fast as the ground does, and is low."""

    slowest: float = 0.2
    """It goes back by this share of the ground's speed at least: harmonics round off the moments in
    which a foot comes down and goes up, and in their middle it has little speed.
    """
    lift: float = 0.8
    """And is lower than this share of what it is lifted to: fitted feet are not sharp."""
    low: float = 0.02
    """Or than so many lengths over its lowest."""
    gap: float = 0.07
    """Gaps and steps shorter than this share of a cycle are none."""


def feet_down(
    places: Floats, frame_s: float, looks: FeetLooks, *, cyclic: bool, ground: float | None = None
) -> Chart:
    """(t, f) whether each foot stands.

    places: (t, f, 2) of the feet from the body's root, x forwards, y up, in lengths; cyclic: the
    last row is followed by the first one. ground: how fast it goes back under the body (lengths/s),
    where the pictures show that; None: as the feet tell.
    """
    mode: Literal["wrap", "nearest"] = "wrap" if cyclic else "nearest"
    smooth = gaussian_filter1d(places, max(0.5, 0.012 * len(places)), axis=0, mode=mode)
    speed = _change(smooth[..., 0], cyclic=cyclic) / frame_s
    if ground is None:
        ground = ground_speed(places, frame_s, cyclic=cyclic)
    high = smooth[..., 1] - smooth[..., 1].min(axis=0)
    allowed = np.maximum(looks.lift * high.max(axis=0), looks.low)
    down = (speed < -looks.slowest * ground) & (high < allowed)
    width = max(1, round(looks.gap * len(places)))
    return _without_short(down, width, cyclic=cyclic)


def ground_speed(places: Floats, frame_s: float, *, cyclic: bool) -> float:
    """How fast the ground goes back under the body (lengths/s): as feet mostly do that go back.

    A foot that stands goes with the ground, at one speed; what is much slower turns round.
    """
    speed = -_change(places[..., 0], cyclic=cyclic) / frame_s
    back = speed[speed > 0.3 * max(float(np.percentile(speed, 95)), 1e-9)]
    return float(np.median(back)) if len(back) else 0.0


def step_of(down: Chart) -> tuple[float, float] | None:
    """Phases (0..1) at which a foot of a cyclic column (t,) comes down and goes up; None: never."""
    if down.all() or not down.any():
        return None
    before = np.roll(down, 1)
    start = int(np.flatnonzero(down & ~before)[0])
    end = int(np.flatnonzero(np.roll(down, -start) == 0)[0]) + start
    return start / len(down), (end % len(down)) / len(down)


def gait_name(steps: list[tuple[str, float, float]]) -> str:
    """How one calls it, by how long feet stand and which ones together (after Hildebrand).

    steps: name, down and up of each foot, such as `front_leg_left`.
    """
    duties = [(up - down) % 1.0 for _, down, up in steps]
    duty = float(np.mean(duties)) if duties else 0.0
    middle = {name: (down + 0.5 * ((up - down) % 1.0)) % 1.0 for name, down, up in steps}
    front = [name for name in middle if name.startswith("front") and name.endswith("_left")]
    hind = [name for name in middle if name.startswith("hind") and name.endswith("_left")]
    if duty >= 0.5 or not front or not hind:
        return "walk"
    later = (middle[front[0]] - middle[hind[0]]) % 1.0
    if abs(later - 0.5) < 0.13:
        return "trot"
    return "pace" if min(later, 1.0 - later) < 0.13 else "run"


def _change(values: Floats, *, cyclic: bool) -> Floats:
    if cyclic:
        return np.asarray(0.5 * (np.roll(values, -1, axis=0) - np.roll(values, 1, axis=0)))
    return np.asarray(np.gradient(values, axis=0))


def _without_short(down: Chart, width: int, *, cyclic: bool) -> Chart:
    count = len(down)
    rows = np.concatenate([down, down, down]) if cyclic else np.pad(
        down, ((count, count), (0, 0)), mode="edge"
    )  # fmt: skip
    shape = np.ones((width, 1), dtype=np.bool_)
    clean = binary_opening(binary_closing(rows, shape), shape)
    return np.asarray(clean[count : 2 * count])
