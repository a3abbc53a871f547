"""Metres for a set of cameras that has none: a known length tells them."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated

import numpy as np
from pydantic import Field

from veduta.cameras.camera import CameraSet
from veduta.run.errors import InputError
from veduta.run.options import Options


class ScaleOptions(Options):
    """How long the cameras' unit is."""

    metres_per_unit: Annotated[float, Field(gt=0.0, le=1e6)] | None = Field(
        default=None,
        description=(
            "metres in a unit of the cameras that have none: a length that is known, by what the"
            " result without this option gives it"
        ),
    )


def in_metres(cameras: CameraSet, options: ScaleOptions) -> CameraSet:
    """The set in metres, where the option says how; else as it is.

    InputError where it is in metres already.
    """
    factor = options.metres_per_unit
    if factor is None:
        return cameras
    if cameras.scale == "metres":
        fault = "is given, but the cameras are in metres already"
        raise InputError("--metres-per-unit", fault, "Leave it out.")
    grown = np.diag([factor, factor, factor, 1.0])
    return replace(cameras.moved(grown), scale="metres")
