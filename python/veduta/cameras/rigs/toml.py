"""walk.toml: the rig in plain words.

focal_px = [707.1, 707.1]      # or one number
centre_px = [602.4, 183.6]     # of the left camera; pixel centres at (0.5, 0.5)
baseline_m = 0.537
centre_right_px = [602.4, 183.6]   # if the right camera's differs
size_px = [1242, 375]              # if it is to be checked
"""

from __future__ import annotations

import tomllib
from pathlib import Path

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from veduta.cameras.rigs.calibration import RigCalibration
from veduta.run.errors import InputError
from veduta.run.faults import first_fault

TOML = "walk.toml"
_REMEDY = "Write focal_px, centre_px and baseline_m of a rectified rig."


class RigToml(BaseModel):
    """What walk.toml may say."""

    model_config = ConfigDict(frozen=True, extra="forbid")
    focal_px: float | tuple[float, float]
    centre_px: tuple[float, float]
    baseline_m: float = Field(gt=0.0, le=100.0, allow_inf_nan=False)
    centre_right_px: tuple[float, float] | None = None
    size_px: tuple[int, int] | None = None


def read_toml(path: Path, text: str) -> RigCalibration:
    """The rig of a walk.toml; InputError with the field that is wrong."""
    try:
        said = RigToml.model_validate(tomllib.loads(text))
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        raise InputError(path, f"is no TOML ({error})", _REMEDY) from error
    except ValidationError as error:
        raise InputError(path, first_fault(error), _REMEDY) from error
    fx, fy = said.focal_px if isinstance(said.focal_px, tuple) else (said.focal_px, said.focal_px)
    if not (fx > 0.0 and fy > 0.0):
        raise InputError(path, "focal_px is not above 0", _REMEDY)
    left, right = (
        np.array([[fx, 0.0, centre[0]], [0.0, fy, centre[1]], [0.0, 0.0, 1.0]])
        for centre in (said.centre_px, said.centre_right_px or said.centre_px)
    )
    between = np.column_stack([np.eye(3), [-said.baseline_m, 0.0, 0.0]])
    return RigCalibration(path, left, right, between, size_px=said.size_px)
