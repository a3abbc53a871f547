"""A file that may be a photo, and what was given with it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Mount:
    """Which camera of a rig took a photo, and at which moment: those of one frame at the same."""

    camera: str
    frame: str


@dataclass(frozen=True)
class Source:
    """A file that may be a photo; its name is what the results call it.

    mask: the file that says which of its pixels are looked at. video: the film that it is a frame
    of; all frames of one are taken with one camera. mount: where the camera is one of a rig.
    """

    name: str
    path: Path
    sha256: str
    mask: Path | None = None
    mask_sha256: str | None = None
    video: str | None = None
    mount: Mount | None = None
