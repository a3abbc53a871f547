"""Calibrated photos become depth maps, a cloud and a mesh: `veduta dense`."""

from veduta.dense.command import run_dense
from veduta.dense.options import DenseOptions

__all__ = ["DenseOptions", "run_dense"]
