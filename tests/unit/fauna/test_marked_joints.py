"""Joints from a CSV as DeepLabCut writes it, and how they pull a fit."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from veduta.fauna.document.plan import load_plan
from veduta.fauna.motion.figure import figure_of
from veduta.fauna.options import FootageOptions
from veduta.fauna.pins_recipe import pins_of
from veduta.fauna.read.annotated import read_annotated
from veduta.fauna.read.basis import FitLooks, spline_basis
from veduta.fauna.read.fit import Fit
from veduta.fauna.read.footage import Footage
from veduta.fauna.read.joints import read_joints, written_joints
from veduta.fauna.read.silhouettes import Silhouettes
from veduta.fauna.read.windows import windows_of
from veduta.fauna.recipe import Record
from veduta.run.errors import InputError
from veduta.run.progress import Progress
from veduta.run.verb import VerbCall, Work, run_verb

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


def test_an_index_of_three_columns_and_one_of_several_animals_are_read(tmp_path: Path) -> None:
    path = tmp_path / "joints.csv"
    path.write_text(
        "scorer,,,me,me,me,me\nindividuals,,,a,a,b,b\nbodyparts,,,nose,nose,nose,nose\n"
        "coords,,,x,y,x,y\nlabeled-data,dogs,img1.png,1,2,3,4\n"
    )
    with pytest.raises(InputError, match="several animals: a, b"):
        read_joints(path, 2, NAMES, ())
    with pytest.raises(InputError, match="has no animal 'c'"):
        read_joints(path, 2, NAMES, (), "c")
    found = read_joints(path, 2, NAMES, (), "b")
    np.testing.assert_array_equal(found.px["nose"], [[np.nan, np.nan], [3.0, 4.0]])


def test_joints_that_are_written_are_read_again(tmp_path: Path) -> None:
    places = np.array([[1.5, 2.25], [np.nan, np.nan], [7.0, 8.0]])
    path = tmp_path / "joints.csv"
    trust = np.array([1.0, 0.0, 1.0])
    path.write_text(written_joints({"nose": places}, {"nose": trust}, np.array([0, 2, 4])))
    found = read_joints(path, 5, NAMES, ())
    np.testing.assert_array_equal(found.px["nose"][[0, 2, 4]], places)


def test_what_was_carried_is_written_and_no_mark_when_it_is_read_again(tmp_path: Path) -> None:
    places = np.array([[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]])
    path = tmp_path / "joints.csv"
    path.write_text(
        written_joints({"nose": places}, {"nose": np.array([1.0, 0.99, 0.2])}, np.arange(3))
    )
    assert "3.00,4.00,0.53" in path.read_text()
    found = read_joints(path, 3, NAMES, ())
    np.testing.assert_array_equal(np.isfinite(found.px["nose"][:, 0]), [True, False, False])


def _annotated(**changed: object) -> str:
    joints = [[0, 0]] * 37
    joints[33], joints[8] = [540, 1000], [300, 400]
    seen = [number in (33, 8) for number in range(37)]
    entry = {"image_path": "a/Full-Resolution/dog/00002.jpg", "joints": joints, "visibility": seen}
    return json.dumps([entry | changed])


@pytest.mark.parametrize("folder", ["Full-Resolution", "480p"])
def test_annotations_are_of_their_pictures_whatever_those_are_called(
    tmp_path: Path, folder: str
) -> None:
    path = tmp_path / "dog.json"
    path.write_text(_annotated(image_path=f"a/{folder}/dog/00002.jpg"))
    found = read_annotated(path, 4, NAMES)
    np.testing.assert_allclose(found.px["nose"][2], [1000.0, 540.0])
    np.testing.assert_allclose(found.px["elbow_right"][2], [400.0, 300.0])
    assert np.isnan(found.px["nose"][[0, 1, 3]]).all()


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("{}", "is no list"),
        ("[", "is no JSON"),
        ("[{}]", "without its joints"),
        (_annotated(image_path="dog.jpg"), "cannot be used"),
        (_annotated(image_path="dog9.jpg"), "of frame 9, of 4"),
        (_annotated(visibility=[False] * 37), "no joint of the body plan"),
    ],
)
def test_annotations_of_another_layout_are_refused(tmp_path: Path, text: str, fault: str) -> None:
    path = tmp_path / "dog.json"
    path.write_text(text)
    with pytest.raises(InputError, match=fault):
        read_annotated(path, 4, NAMES)


def test_places_of_larger_pictures_are_refused_until_their_height_is_told(tmp_path: Path) -> None:
    path = tmp_path / "joints.csv"
    path.write_text("bodyparts,nose,nose\ncoords,x,y\n0,150,90\n1,60,40\n2,170,100\n")
    mask = np.zeros((5, 60, 100), dtype=np.bool_)
    footage = Footage(np.zeros((5, 60, 100, 3), np.uint8), np.arange(5), 0.04, assumed=False)
    found = Silhouettes(mask, np.arange(5), np.ones(5), ())
    record = Record(tmp_path, joints=path)
    at: list[np.ndarray] = []

    def run(height: float | None) -> None:
        options = FootageOptions(joints_height=height)

        def make(work: Work) -> None:
            plan = load_plan("quadruped")
            at.append(pins_of(work, record, footage, found, plan, options).px["nose"])

        call = VerbCall("fauna", "0", "x", options, [])
        run_verb(call, tmp_path / f"out{height}", make, Progress(quiet=True))

    with pytest.raises(InputError, match=r"2 of 3 places beside the frames.*--joints-height"):
        run(None)
    run(120.0)
    np.testing.assert_allclose(at[0][0], [75.0, 45.0])
