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
class View:
    """One of the views that a panorama was cut into.

    panorama: what its file is called. size_px: its width and height. body: the camera that took it;
    all panoramas of one have views of one size. number: the side that it looks to.
    """

    panorama: str
    size_px: tuple[int, int]
    body: str
    number: int


@dataclass(frozen=True)
class Source:
    """A file that may be a photo; its name is what the results call it.

    mask: the file that says which of its pixels are looked at. video: the film that it is a frame
    of; all frames of one are taken with one camera. mount: where the camera is one of a rig.
    view: where it was cut out of a panorama, which is a rig of its views.
    """

    name: str
    path: Path
    sha256: str
    mask: Path | None = None
    mask_sha256: str | None = None
    video: str | None = None
    mount: Mount | None = None
    view: View | None = None
