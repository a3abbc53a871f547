"""Reading midlines, and each way in which a file of them can be bad."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from veduta.fauna.document.schema import Source
from veduta.fauna.options import FaunaOptions
from veduta.fauna.read.midlines import read_midlines
from veduta.fauna.read.tracked import describe
from veduta.run.errors import InputError, NotFoundError

Write = Callable[[str], Path]


@pytest.fixture
def write(tmp_path: Path) -> Write:
    def put(text: str) -> Path:
        path = tmp_path / "lines.csv"
        path.write_text(text)
        return path

    return put


def _rows(
    frames: int = 12, points: int = 10, *, blank: int | None = None, back: bool = False
) -> str:
    lines = ["t,frame,point,mxmm,mymm"]
    for frame in range(frames):
        for point in range(points):
            x = (frame * (-2.0 if back else 2.0)) - 5.0 * point
            y = 3.0 * np.sin(0.6 * point - 0.8 * frame)
            place = "," if frame == blank else f"{x:.4f},{y:.4f}"
            lines.append(f"{0.02 * frame:.2f},{frame},{point},{place}")
    return "\n".join(lines) + "\n"


SOURCE = Source(file="lines.csv", sha256="", frames=12, used=12)


def test_columns_units_and_blank_frames(write: Write) -> None:
    tracked = read_midlines(write(_rows(blank=3)))
    assert tracked.unit == "m"
    assert tracked.points.shape == (11, 10, 2)
    assert tracked.points[0, 1, 0] == pytest.approx(-0.005)
    assert tracked.frame_s == pytest.approx(0.02)
    assert tracked.left_out == ("frame 3: points are missing",)


def test_it_goes_head_first(write: Write) -> None:
    for back in (False, True):
        found = describe(read_midlines(write(_rows(back=back))), "a", SOURCE, FaunaOptions())
        ahead = found.axes[:, 0] - found.axes[:, -1]
        assert (np.sign(ahead[:, 0]) == (-1 if back else 1)).all()


def test_rows_may_stand_in_any_order(write: Write) -> None:
    head, *rows = _rows().splitlines()
    mixed = write("\n".join([head, *rows[::-1]]))
    assert np.allclose(read_midlines(mixed).points, read_midlines(write(_rows())).points)


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("", "no rows"),
        ("t,frame,point,mxmm\n0,1,1,2\n", "no column y"),
        ("time,likelihood,nose_x,nose_y\n0,1,1,2\n", "no column frame"),
        ("t,frame,point,x_mm,y_px\n0,1,1,2,3\n", "different units"),
        ("t,frame,point,x,y\n0,1,1,2,3\n0,1,2,2\n", "different lengths"),
        ("t,frame,point,x,y\n0,,1,2,3\n", "without the number"),
        (_rows(points=3), "only 3 points"),
        (_rows().rsplit("\n", 2)[0] + "\n", "has not 10 points"),
    ],
)
def test_bad_files_are_refused(write: Write, text: str, fault: str) -> None:
    with pytest.raises(InputError, match=fault):
        read_midlines(write(text))


def test_a_missing_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="cannot be read"):
        read_midlines(tmp_path / "none.csv")


def test_too_few_frames_are_no_motion(write: Write) -> None:
    with pytest.raises(NotFoundError, match="only 3 frames"):
        describe(read_midlines(write(_rows(frames=3))), "a", SOURCE, FaunaOptions())


def test_frames_with_a_cut_axis_are_named(write: Write) -> None:
    tracked = read_midlines(write(_rows()))
    points = tracked.points.copy()
    points[4] = points[4, :1] + 0.4 * (points[4] - points[4, :1])
    cut = type(tracked)(**{**tracked.__dict__, "points": points})
    found = describe(cut, "a", SOURCE, FaunaOptions()).animal
    assert found.source.used == 11
    assert found.source.left_out == ["frame 4: its axis is 40% of the usual length"]


def test_widths_that_are_not_everywhere_are_carried_on(write: Write) -> None:
    tracked = read_midlines(write(_rows()))
    half = np.full((len(tracked.points), 9), 0.02)
    half[:, :2] = np.nan
    some = replace(tracked, half_widths=half)
    body = describe(some, "a", SOURCE, FaunaOptions()).animal.body
    assert body.widths == "measured"
    assert len({round(piece.half_width, 6) for piece in body.slices}) == 1


def test_widths_that_are_nowhere_are_told_once(write: Write) -> None:
    tracked = read_midlines(write(_rows()))
    none = replace(tracked, half_widths=np.full((len(tracked.points), 9), np.nan))
    found = describe(none, "a", SOURCE, FaunaOptions())
    bare = describe(tracked, "a", SOURCE, FaunaOptions())
    assert found.animal.doubts == bare.animal.doubts
    assert any("no widths" in doubt for doubt in found.animal.doubts)
    assert found.animal.body == bare.animal.body
