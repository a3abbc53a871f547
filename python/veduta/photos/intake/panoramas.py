"""Panoramas all around (equirectangular) as photos: views to eight sides, that overlap.

The engine maps photos of lenses; a panorama has none. Each is cut into level views whose focal
length is then known, which also tell up: those who make panoramas level them. The views of one
panorama are a rig: they were seen from one place, turned against each other as they were cut.
"""

from __future__ import annotations

import json
import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path, PurePosixPath

import cv2
import numpy as np
from numpy.typing import NDArray
from PIL import Image

from veduta.imaging.exif import focal_px_from_mm35
from veduta.imaging.heic import heic_formats
from veduta.imaging.read import FORMATS, read_image
from veduta.photos.intake.call import Call
from veduta.photos.intake.masks import read_mask
from veduta.photos.intake.source import Mount, Source, View
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
BODY = "panorama"
"""What the camera of panoramas is called that are not in a folder of a rig."""
_EQUIRECTANGULAR = re.compile(rb"ProjectionType\s*(?:=\s*[\"']|>)\s*equirectangular", re.IGNORECASE)
_LONGEST_XMP = 1 << 20
_TOLD = "told.json"


@dataclass(frozen=True)
class Panorama:
    """A file that shows all around."""

    source: Source
    width_px: int

    @property
    def side_px(self) -> int:
        """Of its views."""
        return min(LARGEST_PX, self.width_px // 4)

    @property
    def stem(self) -> str:
        """What its views are called after; in a rig with the folder of its camera."""
        return str(PurePosixPath(self.source.name).with_suffix(""))


def panoramas_among(sources: Sequence[Source], *, asked: bool) -> list[Panorama]:
    """Those that say so in their XMP, or are twice as wide as high where that is asked for.

    All photos of a camera of a rig are alike: where one of them says so, its others are, too.
    """
    known = (*FORMATS, *heic_formats())
    wide: list[tuple[Panorama, bool]] = []
    for source in sources:
        try:
            with Image.open(source.path, formats=known) as image:
                (width, height), packet = image.size, image.info.get("xmp")
        except (OSError, ValueError, SyntaxError, Image.DecompressionBombError):
            continue
        told = isinstance(packet, bytes) and bool(_EQUIRECTANGULAR.search(packet[:_LONGEST_XMP]))
        if width == 2 * height:
            wide.append((Panorama(source, width), told or asked))
    cameras = {one.source.mount.camera for one, told in wide if told and one.source.mount}
    return [
        one
        for one, told in wide
        if told or (one.source.mount is not None and one.source.mount.camera in cameras)
    ]


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
    keyed = [(one.source.name, one.source.sha256, one.source.mask_sha256) for one in found]
    folder = stages.views(keyed)
    if not folder.exists():
        with writing_to(stages.out), atomic_folder(folder) as temporary:
            for number, panorama in enumerate(found):
                progress("panoramas", number / len(found))
                _write_views(panorama, temporary)
            told = [panorama.source.name for panorama in found]
            (temporary / _TOLD).write_text(json.dumps(told), encoding="utf-8")
    names = {panorama.source.name for panorama in found}
    bodies = _bodies(found)
    views = [view for one in found for view in _views(one, folder, bodies[one.source.name])]
    taken = [source for source in call.sources if source.name not in names]
    note = f"{len(found)} panoramas were cut into {VIEWS} level views each, from one place each"
    return replace(call, sources=(*taken, *views), notes=(*call.notes, note))


def cam_from_panorama(number: int) -> NDArray[np.float64]:
    """(3, 4) of a view from its panorama, whose x is right, y down, and z to its middle."""
    turn = 2.0 * np.pi * number / VIEWS
    c, s = np.cos(turn), np.sin(turn)
    return np.array([[c, 0.0, -s, 0.0], [0.0, 1.0, 0.0, 0.0], [s, 0.0, c, 0.0]])


def focal_of(side_px: int) -> float:
    """The focal length (px) of views with that side, as their EXIF tells it."""
    return focal_px_from_mm35(FOCAL_MM35, side_px, side_px)


def pixel_in_view(
    pixel: tuple[float, float], size_px: tuple[int, int], side_px: int
) -> tuple[int, tuple[float, float]] | None:
    """The view in whose middle a pixel of a panorama lies nearest, and its pixel there.

    None where no view reaches: above and below.
    """
    longitude = (pixel[0] / size_px[0] - 0.5) * 2.0 * np.pi
    latitude = (0.5 - pixel[1] / size_px[1]) * np.pi
    number = round(longitude / (2.0 * np.pi / VIEWS)) % VIEWS
    beside = longitude - 2.0 * np.pi * number / VIEWS
    focal, half = focal_of(side_px), side_px / 2.0
    across = half + focal * float(np.tan(beside))
    down = half - focal * float(np.tan(latitude) / np.cos(beside))
    return (number, (across, down)) if 0.0 <= down <= side_px else None


def _bodies(found: Sequence[Panorama]) -> Mapping[str, str]:
    """The camera of each panorama by its name: of a rig its folder, else by the size of views."""
    sides = Counter(one.side_px for one in found if one.source.mount is None)
    bodies = {}
    for one in found:
        if one.source.mount is not None:
            bodies[one.source.name] = one.source.mount.camera
        else:
            bodies[one.source.name] = BODY if len(sides) == 1 else f"{BODY} {one.side_px}"
    return bodies


def _views(panorama: Panorama, folder: Path, body: str) -> Iterator[Source]:
    source, size_px = panorama.source, (panorama.width_px, panorama.width_px // 2)
    frame = panorama.stem.casefold() if source.mount is None else source.mount.frame
    for number in range(VIEWS):
        name = f"{panorama.stem}_view{number}.jpg"
        path = folder / name
        mask = path.with_suffix(".png") if source.mask else None
        yield Source(
            name,
            path,
            file_digest(path),
            mask,
            None if mask is None else file_digest(mask),
            mount=Mount(f"{body}/view{number}", frame),
            view=View(source.name, size_px, body, number),
        )


def _require_names(panoramas: Sequence[Panorama]) -> None:
    known: dict[str, str] = {}
    for panorama in panoramas:
        name = panorama.source.name
        other = known.setdefault(panorama.stem.casefold(), name)
        if other != name:
            fault = f"is a panorama whose views would be called as those of {other}"
            raise InputError(panorama.source.path, fault, "Rename one of them.")


def _write_views(panorama: Panorama, folder: Path) -> None:
    photo = read_image(panorama.source.path)
    side = panorama.side_px
    with Image.open(panorama.source.path, formats=(*FORMATS, *heic_formats())) as image:
        tags = image.getexif()
    exif = Image.Exif()
    if 0x8825 in tags:
        exif[0x8825] = tags.get_ifd(0x8825)
    if 306 in tags:
        exif[306] = tags[306]
    exif[0x8769] = {0xA405: FOCAL_MM35}
    (folder / panorama.stem).parent.mkdir(exist_ok=True)
    for number, pixels in enumerate(views_of(photo.pixels, side)):
        name = f"{panorama.stem}_view{number}.jpg"
        Image.fromarray(pixels).save(folder / name, quality=95, exif=exif)
    if panorama.source.mask is None:
        return
    size_px = (photo.pixels.shape[1], photo.pixels.shape[0])
    shown = read_mask(panorama.source.mask, panorama.source.name, size_px)
    grey = np.repeat(255 * shown[..., None].astype(np.uint8), 3, axis=2)
    for number, pixels in enumerate(views_of(grey, side)):
        whole = Image.fromarray(np.where(pixels < 255, 0, 255).astype(np.uint8))
        whole.save(folder / f"{panorama.stem}_view{number}.png")


def views_of(pixels: NDArray[np.uint8], side_px: int) -> Iterator[NDArray[np.uint8]]:
    """(side, side, 3) to `VIEWS` sides of (h, 2h, 3), the first to the middle of the panorama."""
    height, width = pixels.shape[:2]
    focal = focal_of(side_px)
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
