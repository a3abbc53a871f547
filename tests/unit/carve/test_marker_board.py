"""A printed board of markers gives pose and metres: rendered photos with known cameras."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest
from object_on_a_board import SIZE, small_body, write_photos

from veduta.cameras import Board, cameras_of_board
from veduta.carve.command import run_carve
from veduta.carve.options import (
    CarveOptions,
    ColourOptions,
    PoseOptions,
    TextureOptions,
    VolumeOptions,
)
from veduta.carve.read.unposed import bare_cameras
from veduta.cli.main import main
from veduta.run.errors import InputError
from veduta.run.progress import Progress

BOARD = Board("a4")
QUIET = Progress(quiet=True)


def _options(**poses: object) -> CarveOptions:
    return CarveOptions(
        poses=PoseOptions.model_validate({"board": "a4", **poses}),
        volume=VolumeOptions(levels=6),
        colour=ColourOptions(carve=False),
        texture=TextureOptions(no_texture=True),
    )


@pytest.mark.parametrize("sheet", ["a4", "a3", "letter"])
def test_markers_lie_on_the_sheet_and_apart(sheet: str) -> None:
    board = Board(sheet)  # type: ignore[arg-type]
    low, high = board.corners_m.min(axis=1), board.corners_m.max(axis=1)
    assert (np.abs(board.corners_m[..., :2]) < np.array(board.size_m) / 2.0 - 0.01).all()
    gaps = np.maximum(low[:, None] - high[None], low[None] - high[:, None])[..., :2].max(axis=2)
    assert gaps[~np.eye(len(low), dtype=bool)].min() > 0.004
    assert min(board.free_m) > 0.1


def test_cameras_come_out_in_metres(tmp_path: Path) -> None:
    truth = write_photos(tmp_path / "piece", 8, BOARD, masks=False)
    found = cameras_of_board(bare_cameras(tmp_path / "piece").cameras, BOARD)
    assert found.cameras.scale == "metres"
    assert not found.left_out
    assert found.error_px < 0.8
    for one, true in zip(found.cameras.cameras, truth, strict=True):
        assert one.focal_px[0] == pytest.approx(true.focal_px[0], rel=0.01)
        assert one.centre() == pytest.approx(true.centre(), abs=0.004)
        spots, _ = one.project(small_body().vertices)
        assert np.abs(spots - true.project(small_body().vertices)[0]).max() < 1.0


@pytest.mark.parametrize("masks", [True, False])
def test_the_verb_measures_a_piece(tmp_path: Path, masks: bool) -> None:
    """Without masks the object is what the sheet's print is not."""
    write_photos(tmp_path / "piece", 12, BOARD, masks=masks)
    result = run_carve(tmp_path / "piece", tmp_path / "out", _options(), QUIET)
    size = np.ptp(small_body().vertices, axis=0)
    import trimesh

    made = trimesh.load_mesh(tmp_path / "out/object.ply", process=False)
    assert np.ptp(made.vertices, axis=0)[:2] == pytest.approx(size[:2], abs=0.003)
    assert result.measures["silhouette_iou_mean"] > 0.93
    assert "INSERT" in (tmp_path / "out/object.sql").read_text()


def test_a_stretched_print_stretches_the_piece(tmp_path: Path) -> None:
    write_photos(tmp_path / "piece", 6, BOARD, masks=True)
    bare = bare_cameras(tmp_path / "piece").cameras
    plain, wide = (cameras_of_board(bare, Board("a4", one)).cameras for one in (1.0, 1.02))
    assert wide.centres == pytest.approx(1.02 * plain.centres, rel=1e-3)


def test_photos_without_a_board(tmp_path: Path) -> None:
    (tmp_path / "piece").mkdir()
    for number in range(4):
        cv2.imwrite(str(tmp_path / f"piece/{number}.png"), np.full((*SIZE[::-1], 3), 90, np.uint8))
    with pytest.raises(InputError, match="0 of 4 photos show") as raised:
        run_carve(tmp_path / "piece", tmp_path / "out", _options(), QUIET)
    assert "--print-board" in raised.value.remedy


def test_photos_of_several_sizes(tmp_path: Path) -> None:
    (tmp_path / "piece").mkdir()
    for number in range(4):
        cv2.imwrite(str(tmp_path / f"piece/{number}.png"), np.zeros((90 + number, 90, 3), np.uint8))
    with pytest.raises(InputError, match="several sizes"):
        run_carve(tmp_path / "piece", tmp_path / "out", _options(), QUIET)


def test_a_board_and_a_turntable_are_one_too_many(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="together with --turntable"):
        run_carve(tmp_path, tmp_path / "out", _options(turntable=True), QUIET)


def test_the_board_is_printed_at_its_size(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "board.pdf"
    assert main(["carve", "--print-board", str(path), "--board", "a3"]) == 0
    assert "Print it at 100 %" in capsys.readouterr().out
    data = path.read_bytes()
    box = data[data.index(b"/MediaBox [") + 11 :].split(b"]")[0].split()
    assert [float(one) for one in box[2:]] == pytest.approx(
        [297 / 25.4 * 72, 420 / 25.4 * 72], abs=0.2
    )
    assert main(["carve", "--print-board", str(path)]) == 2
    assert "exists" in capsys.readouterr().err
    assert main(["carve", "--print-board", str(tmp_path / "board.png")]) == 2
