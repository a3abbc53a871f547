"""Panoramas all around (equirectangular) as photos: views to eight sides, that overlap.

The engine maps photos of lenses; a panorama has none. Each is cut into level views whose focal
length is then known, which also tell up: those who make panoramas level them. The views of one
panorama are placed for themselves; that they were taken from one place is not demanded.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray
from PIL import Image

from veduta.imaging.exif import focal_px_from_mm35
from veduta.imaging.heic import heic_formats
from veduta.imaging.read import FORMATS, read_image
from veduta.photos.intake.call import Call
from veduta.photos.intake.source import Source
from veduta.photos.stages import Stages
from veduta.run.atomic import atomic_folder
from veduta.run.digests import file_digest
from veduta.run.errors import InputError
from veduta.run.outputs import writing_to
from veduta.run.progress import StepProgress, no_progress

VIEWS = 8
FOCAL_MM35 = 16
"""A whole number, for EXIF holds no other: square views are 87 degrees wide."""
LARGEST_PX = 1600
_EQUIRECTANGULAR = re.compile(rb"ProjectionType\s*(?:=\s*[\"']|>)\s*equirectangular", re.IGNORECASE)
_LONGEST_XMP = 1 << 20
_TOLD = "told.json"


@dataclass(frozen=True)
class Panorama:
    """A file that shows all around."""

    source: Source
    width_px: int


def panoramas_among(sources: Sequence[Source], *, asked: bool) -> list[Panorama]:
    """Those that say so in their XMP, or are twice as wide as high where that is asked for."""
    known = (*FORMATS, *heic_formats())
    found = []
    for source in sources:
        try:
            with Image.open(source.path, formats=known) as image:
                (width, height), packet = image.size, image.info.get("xmp")
        except (OSError, ValueError, SyntaxError, Image.DecompressionBombError):
            continue
        told = isinstance(packet, bytes) and _EQUIRECTANGULAR.search(packet[:_LONGEST_XMP])
        if width == 2 * height and (told or asked):
            found.append(Panorama(source, width))
    return found


def with_panoramas(call: Call, stages: Stages, progress: StepProgress = no_progress) -> Call:
    """The call with views in place of its panoramas; as it is where it has none.

    A killed run's views are taken over. InputError where views of two would have the same names.
    """
    found = panoramas_among(call.sources, asked=stages.options.camera.panoramas)
    if not found:
        return call
    _require_names(found)
    if call.models:
        remedy = "Give the views that the model was made of as DIR."
        raise InputError("--from-colmap", "has no use for panoramas", remedy)
    if stages.options.camera.focal_px is not None:
        remedy = "Leave it out: what is cut out of a panorama has a focal length that is known."
        raise InputError("--focal-px", f"has no use for panoramas ({found[0].source.name})", remedy)
    folder = stages.views([panorama.source.sha256 for panorama in found])
    if not folder.exists():
        with writing_to(stages.out), atomic_folder(folder) as temporary:
            for number, panorama in enumerate(found):
                progress("panoramas", number / len(found))
                _write_views(panorama, temporary)
            told = [panorama.source.name for panorama in found]
            (temporary / _TOLD).write_text(json.dumps(told), encoding="utf-8")
    names = {panorama.source.name for panorama in found}
    views = [Source(path.name, path, file_digest(path)) for path in sorted(folder.glob("*.jpg"))]
    taken = [source for source in call.sources if source.name not in names]
    note = f"{len(found)} panoramas were cut into {VIEWS} level views each"
    return replace(call, sources=(*taken, *views), notes=(*call.notes, note))


def _require_names(panoramas: Sequence[Panorama]) -> None:
    known: dict[str, str] = {}
    for panorama in panoramas:
        name = panorama.source.name
        other = known.setdefault(Path(name).stem, name)
        if other != name:
            fault = f"is a panorama whose views would be called as those of {other}"
            raise InputError(panorama.source.path, fault, "Rename one of them.")


def _write_views(panorama: Panorama, folder: Path) -> None:
    photo = read_image(panorama.source.path)
    side = min(LARGEST_PX, panorama.width_px // 4)
    with Image.open(panorama.source.path, formats=(*FORMATS, *heic_formats())) as image:
        tags = image.getexif()
    exif = Image.Exif()
    if 0x8825 in tags:
        exif[0x8825] = tags.get_ifd(0x8825)
    if 306 in tags:
        exif[306] = tags[306]
    exif[0x8769] = {0xA405: FOCAL_MM35}
    for number, pixels in enumerate(views_of(photo.pixels, side)):
        name = f"{Path(panorama.source.name).stem}_view{number}.jpg"
        Image.fromarray(pixels).save(folder / name, quality=95, exif=exif)


def views_of(pixels: NDArray[np.uint8], side_px: int) -> Iterator[NDArray[np.uint8]]:
    """(side, side, 3) to `VIEWS` sides of (h, 2h, 3), the first to the middle of the panorama."""
    height, width = pixels.shape[:2]
    focal = focal_px_from_mm35(FOCAL_MM35, side_px, side_px)
    place = (np.arange(side_px) + 0.5 - side_px / 2.0) / focal
    across, down = np.meshgrid(place, place)
    latitude = np.arctan2(-down, np.hypot(across, 1.0))
    rows = ((0.5 - latitude / np.pi) * height - 0.5).astype(np.float32)
    # One column more at each side: the seam is in the middle of some view.
    around = cv2.copyMakeBorder(pixels, 0, 0, 2, 2, cv2.BORDER_WRAP)
    for number in range(VIEWS):
        longitude = np.arctan(across) + 2.0 * np.pi * number / VIEWS
        share = (longitude / (2.0 * np.pi) + 0.5) % 1.0
        columns = (share * width - 0.5 + 2.0).astype(np.float32)
        seen = cv2.remap(around, columns, rows, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
        yield np.asarray(seen, dtype=np.uint8)
