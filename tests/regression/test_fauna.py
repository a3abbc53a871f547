"""Bounds on real animals: the worm in frames that were not seen, the lamprey's wave and states."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from veduta.fauna.motion.angles import angles_of, axis_angles, axis_of, coefficients, equal_steps
from veduta.fauna.motion.wave import swimming_wave
from veduta.fauna.read.footage import read_footage
from veduta.fauna.read.limbless import axes_in, silhouettes_in
from veduta.fauna.read.midlines import read_midlines
from veduta.fauna.read.overlap import drawn_body, overlap

pytestmark = pytest.mark.regression


def test_the_worm_of_the_even_frames_covers_that_of_the_odd_ones(veduta_data: Path) -> None:
    footage = read_footage(veduta_data / "animals" / "worm" / "celegans3.avi", None)
    silhouettes, _ = silhouettes_in(footage, None, None, "worm")
    assert len(silhouettes.rows) == 50
    axes = axes_in(silhouettes)
    half = np.median([axis.half_width for axis in axes[::2] if axis is not None], axis=0)
    scores = [
        overlap(drawn_body(axis.points, half, footage.size), mask)
        for axis, mask in zip(axes[1::2], silhouettes.masks[1::2], strict=True)
        if axis is not None
    ]
    assert len(scores) == 25
    assert 0.85 <= float(np.median(scores)) <= 0.95


def test_the_lamprey_s_states_and_wave(veduta_data: Path) -> None:
    tracked = read_midlines(veduta_data / "animals" / "lamprey" / "lampreydata.csv")
    assert len(tracked.points) == 78
    assert len(tracked.left_out) == 2
    angles = axis_angles(equal_steps(tracked.points, 101))
    again = axis_of(angles_of(coefficients(angles), 100))
    apart = np.linalg.norm(again - axis_of(angles), axis=2)
    assert 1e-5 < apart.mean() < 0.002
    assert apart.max() < 0.02
    wave = swimming_wave(angles, tracked.frame * tracked.frame_s)
    assert 3.6 < wave.frequency_hz < 4.0
    assert 0.8 < wave.share < 0.95
