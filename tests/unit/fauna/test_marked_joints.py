"""Joints from a CSV as DeepLabCut writes it, and how they pull a fit."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from veduta.fauna.document.plan import load_plan
from veduta.fauna.motion.figure import figure_of
from veduta.fauna.read.fit import Fit, FitLooks, spline_basis
from veduta.fauna.read.joints import read_joints
from veduta.fauna.read.windows import windows_of
from veduta.run.errors import InputError

NAMES = figure_of(load_plan("quadruped")).names
HEAD = """scorer,me,me,me,me,me,me
bodyparts,snout,snout,snout,left front paw,left front paw,left front paw
coords,x,y,likelihood,x,y,likelihood
"""


def test_joints_are_told_by_their_words_and_gaps_stay_gaps(tmp_path: Path) -> None:
    path = tmp_path / "joints.csv"
    path.write_text(HEAD + "0,10,20,1,30,40,1\n2,11,21,0.2,,,1\n")
    found = read_joints(path, 4, NAMES, ())
    np.testing.assert_array_equal(found.px["nose"][0], [10.0, 20.0])
    np.testing.assert_array_equal(found.px["front_toe_left"][0], [30.0, 40.0])
    assert np.isnan(found.px["nose"][1:]).all()
    assert np.isnan(found.px["front_toe_left"][2]).all()


def test_rows_are_told_by_the_names_of_pictures(tmp_path: Path) -> None:
    path = tmp_path / "joints.csv"
    path.write_text(HEAD + "labeled-data/img07.png,10,20,1,30,40,1\n")
    found = read_joints(path, 3, NAMES, ("img05.png", "img07.png", "img09.png"))
    np.testing.assert_array_equal(found.px["nose"][1], [10.0, 20.0])


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("a,b,c\n1,2,3\n", "has no rows `bodyparts`"),
        ("individuals,a,a,a,b,b,b\n" + HEAD + "0,10,20,1,30,40,1\n", "of several animals"),
        (HEAD.replace("snout", "antenna").replace("left front paw", "wing"), "names no joint"),
        (HEAD + "9,10,20,1,30,40,1\n", "has a row of frame '9'"),
        (HEAD + "0,ten,20,1,30,40,1\n", "has no number in column 2"),
    ],
)
def test_a_csv_of_another_kind_is_refused_with_the_reason(
    tmp_path: Path, text: str, fault: str
) -> None:
    path = tmp_path / "joints.csv"
    path.write_text(text)
    with pytest.raises(InputError, match=fault):
        read_joints(path, 4, NAMES, ())


def test_a_marked_joint_pulls_the_figure_to_it() -> None:
    figure = figure_of(load_plan("quadruped"), ("ear", "horn", "beard"))
    masks = np.zeros((5, 60, 90), dtype=np.bool_)
    masks[:, 15:35, 10:75] = True
    frames = np.arange(5.0)
    windows = windows_of(masks, 30)
    marked = np.tile([70.0, 12.0], (5, 1))
    marked[2] = np.nan
    windows = replace(windows, pins={"nose": marked})
    fit = Fit(figure, windows, spline_basis(frames, FitLooks()), FitLooks(), frames)
    numbers, _ = fit.improve(np.zeros(fit.size), 70.0, 0.05, 25)
    joints = windows.in_picture(fit.fitted(numbers, 70.0, 0.05).joints(), 70.0)
    nose = joints[:, figure.names.index("nose")]
    away = np.linalg.norm(nose - marked, axis=1)[[0, 1, 3, 4]]
    assert away.max() < 6.0
