"""`--board`: cameras for photos that have none, from a printed board of markers that they show."""

from __future__ import annotations

from veduta.cameras import Board, CameraSet, cameras_of_board
from veduta.carve.options import PoseOptions
from veduta.run.errors import InputError
from veduta.run.page import Table
from veduta.run.work import Work


def board_of(options: PoseOptions) -> Board | None:
    """The board that the photos show; InputError where a turntable is asked for as well."""
    if options.board == "no":
        return None
    if options.turntable:
        fault = "is given together with --turntable"
        raise InputError(
            "--board", fault, "Give one: a board that turns with its object is enough."
        )
    return Board(options.board, options.ruler_mm / 100.0)


def placed_by_board(work: Work, bare: CameraSet, board: Board) -> CameraSet:
    """The photos' cameras: in metres, z out of the board."""
    with work.step("board") as step:
        found = cameras_of_board(bare.cameras, board, progress=work.progress)
        step.counts["photos"] = len(found.cameras)
        step.counts["markers"] = sum(found.markers)
        step.rejected.extend(found.left_out)
    focal = found.cameras.cameras[0].focal_px[0]
    work.measure("board_error_px", round(found.error_px, 3))
    work.measure("focal_px", round(focal, 1))
    work.note(
        f"Cameras by the board: its markers' corners are {found.error_px:.2f} px from where they"
        f" should be, and the focal length is {focal:.0f} px. Lengths are as true as the print."
    )
    rows: list[list[float | int | str | None]] = [
        [camera.name, count, round(float(camera.centre()[2]), 3)]
        for camera, count in zip(found.cameras.cameras, found.markers, strict=True)
    ]
    work.table(Table("Markers", ["photo", "markers seen", "camera's height (m)"], rows))
    return found.cameras
