"""Calibrated photos become depth maps, a cloud and a mesh: `veduta dense`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from veduta.run.late import on_demand

if TYPE_CHECKING:
    from veduta.dense.command import run_dense
    from veduta.dense.options import DenseOptions

__all__ = ["DenseOptions", "run_dense"]

_LATE = {
    "DenseOptions": "options",
    "run_dense": "command",
}


def __getattr__(name: str) -> Any:
    """What `_LATE` names."""
    return on_demand(__name__, name, _LATE)
