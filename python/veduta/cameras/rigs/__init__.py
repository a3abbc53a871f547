"""Stereo rigs: two cameras side by side, in whichever of a few forms their calibration is."""

from veduta.cameras.rigs.calibration import RigCalibration
from veduta.cameras.rigs.reading import find_calibration

__all__ = ["RigCalibration", "find_calibration"]
