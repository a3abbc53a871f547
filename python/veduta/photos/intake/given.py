"""What is given beside the folder of photos."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Given:
    """Masks, a film, a model that other software made; None where there is none.

    named: other files that the call names, such as positions, control points, a city model.
    """

    masks: Path | None = None
    video: Path | None = None
    from_colmap: Path | None = None
    named: tuple[Path, ...] = ()


NOTHING_ELSE = Given()
