"""A file that may be a photo, and what was given with it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Source:
    """A file that may be a photo; its name is what the results call it.

    mask: the file that says which of its pixels are looked at. video: the film that it is a frame
    of; all frames of one are taken with one camera.
    """

    name: str
    path: Path
    sha256: str
    mask: Path | None = None
    mask_sha256: str | None = None
    video: str | None = None
