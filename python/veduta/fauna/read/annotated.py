"""Joints of the annotation files of BADJA: a JSON list of frames, joints of a dog-like model."""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from veduta.fauna.motion.figure import Floats
from veduta.fauna.read.joints import MarkedJoints
from veduta.run.errors import InputError
from veduta.run.inputs import require_file

_MOST_BYTES = 50_000_000
_REMEDY = "Give a JSON list of frames with `image_path`, `joints` (row, column) and `visibility`."
_JOINTS = {
    8: "elbow_right", 9: "wrist_right", 10: "front_paw_right",
    12: "elbow_left", 13: "wrist_left", 14: "front_paw_left",
    18: "knee_right", 19: "hock_right", 20: "hind_paw_right",
    22: "knee_left", 23: "hock_left", 24: "hind_paw_left",
    28: "tail_middle", 31: "tail_end", 33: "nose", 35: "ear_tip_right", 36: "ear_tip_left",
}  # fmt: skip
"""Numbers of that model's joints, and those of the quadruped's body plan that lie there."""


def read_annotated(path: Path, frames: int, names: Sequence[str]) -> MarkedJoints:
    """The visible joints for footage of so many frames, in the pictures that were annotated (px).

    names: the joints of the body plan. A frame is told by the number in its picture's name.
    InputError where the file is of another layout, or names no joint of the plan.
    """
    try:
        require_file(path, _MOST_BYTES)
        content: Any = json.loads(path.read_text("utf-8"))
    except OSError as error:
        raise InputError(path, f"cannot be read ({error.strerror})", _REMEDY) from error
    except (UnicodeDecodeError, json.JSONDecodeError) as error:
        raise InputError(path, "is no JSON", _REMEDY) from error
    if not isinstance(content, list) or not content:
        raise InputError(path, "is no list of frames", _REMEDY)
    places: dict[str, Floats] = {}
    for entry in content:
        frame, spots, seen = _entry(path, entry)
        if frame >= frames:
            raise InputError(path, f"has joints of frame {frame}, of {frames} frames", _REMEDY)
        for number, name in _JOINTS.items():
            if name in names and number < len(spots) and seen[number]:
                track = places.setdefault(name, np.full((frames, 2), np.nan))
                track[frame] = spots[number, ::-1]
    if not places:
        raise InputError(path, "shows no joint of the body plan", "Use the plan `quadruped`.")
    unknown = {str(number) for number in range(len(spots)) if number not in _JOINTS}
    return MarkedJoints(places, tuple(sorted(unknown)))


def _entry(path: Path, entry: Any) -> tuple[int, Floats, list[bool]]:
    """A frame's number, its joints (j, 2) by row and column, and which are seen."""
    try:
        picture = str(entry["image_path"])
        spots = np.array(entry["joints"], dtype=np.float64).reshape(-1, 2)
        seen = [bool(one) for one in entry["visibility"]]
    except (TypeError, KeyError, ValueError) as error:
        raise InputError(path, "has a frame without its joints", _REMEDY) from error
    digits = re.findall(r"\d+", Path(picture).stem)
    if not digits or len(seen) != len(spots) or not np.isfinite(spots).all():
        raise InputError(path, f"has a frame that cannot be used ({picture})", _REMEDY)
    return int(digits[-1]), spots, seen
