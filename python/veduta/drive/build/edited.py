"""A record as an edited document has it: its path, and the images moved along with it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from veduta.drive.document.model import DriveDocument
from veduta.drive.record import DriveRecord
from veduta.run.errors import InputError


def with_document(record: DriveRecord, document: DriveDocument, path: Path) -> DriveRecord:
    """The record with the document's path: scans that are not in it are left out.

    Images move as the scan that was taken next to them. InputError where it is of another drive.
    """
    known = {sweep.name: sweep for sweep in record.sweeps}
    strange = [pose.sweep for pose in document.path if pose.sweep not in known]
    if strange:
        fault = f"has a scan {strange[0]!r} that is not in the log"
        raise InputError(path, fault, "Name the log that it was made from, with its options.")
    sweeps, moves = [], []
    for pose in document.path:
        sweep = known[pose.sweep]
        place = np.vstack([np.reshape(pose.matrix, (3, 4)), [0.0, 0.0, 0.0, 1.0]])
        off = place @ np.linalg.inv(sweep.world_from_sensor)
        moves.append(off)
        sweeps.append(replace(sweep, world_from_sensor=place))
    times = np.array([sweep.time_s for sweep in sweeps])
    shots = []
    for shot in record.shots:
        move = moves[int(np.argmin(np.abs(times - shot.time_s)))]
        shots.append(replace(shot, world_from_cam=move @ shot.world_from_cam))
    return replace(
        record, sweeps=tuple(sweeps), shots=tuple(shots), corrections=(), notes=(*document.notes,),
        path_from=document.path_from, doubts=(),
    )  # fmt: skip
