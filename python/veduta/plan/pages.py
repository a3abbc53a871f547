"""The drawings that files hold: a picture or a DXF is one, a PDF has one on each page asked for."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from veduta.imaging.read import DAMAGE, MAX_FILE_BYTES, read_image
from veduta.run.digests import file_digest
from veduta.run.errors import InputError
from veduta.run.inputs import require_file
from veduta.run.limits import limited
from veduta.run.report import counted

if TYPE_CHECKING:
    import pypdfium2

MOST_DRAWINGS = 20
"""A house has at most so many storeys: a document of more pages is no set of plans."""
RENDERED_PX = 3000
"""The longest side of a rendered page: a little more than reading works at."""
_MOST_DPI = 600.0
"""A page as small as a hand is not enlarged without end."""
_POINTS_PER_INCH = 72.0
_SIMPLER = "Export it again, simpler, or give a picture of the page."
_FORMATS = "Give a picture (JPEG, PNG, TIFF or WebP), a PDF or a DXF file."
_MAGIC = b"%PDF-"
_MAGIC_WITHIN = 1024
"""Bytes in which a PDF says that it is one: PDFium takes files with so much before it."""


@dataclass(frozen=True)
class Drawing:
    """Where the drawing of a storey is: a file, and the page of a PDF from 1 (0: a picture)."""

    path: Path
    page: int = 0

    @property
    def label(self) -> str:
        """As a report names it."""
        return drawing_label(self.path.name, self.page)


@dataclass(frozen=True)
class Scan:
    """The pixels of a drawing, (h, w, 3) uint8 sRGB, and what the file says of them.

    `dpi` is None where no resolution is known; `on_paper` says that it is that of a page of known
    size, and not a number that a program wrote into a picture.
    """

    pixels: NDArray[np.uint8]
    sha256: str
    dpi: float | None
    on_paper: bool = False
    notes: tuple[str, ...] = ()


def drawing_label(file: str, page: int) -> str:
    """`house.pdf page 2`, or the name of a picture."""
    return f"{file} page {page}" if page else file


def find_drawings(paths: Sequence[Path], pages: Sequence[int] | None = None) -> list[Drawing]:
    """The drawings of all files in their order; of PDFs these pages (from 1), or all of them.

    A DXF file is one drawing. Raises InputError where a PDF cannot be opened or lacks a page, and
    where there are more than `MOST_DRAWINGS` in all. Nothing is rendered.
    """
    found: list[Drawing] = []
    for path in paths:
        found += _of_pdf(path, pages) if is_pdf(path) else [Drawing(path)]
    if len(found) > MOST_DRAWINGS:
        raise InputError(
            found[MOST_DRAWINGS].path,
            f"would be storey {MOST_DRAWINGS + 1} of {len(found)}; a house has at most"
            f" {MOST_DRAWINGS}",
            "Name fewer drawings, or fewer --pages.",
        )
    if pages is not None and not any(one.page for one in found):
        raise InputError("--pages", "there is no PDF among the drawings", "Leave it out.")
    return found


def read_drawing(drawing: Drawing) -> Scan:
    """The pixels of a drawing; InputError where it cannot be read."""
    if drawing.page:
        return limited(rendered, drawing, drawing.path, _SIMPLER)
    photo = read_image(drawing.path, _FORMATS)
    return Scan(photo.pixels, photo.sha256, _resolution(drawing.path), notes=photo.notes)


def is_pdf(path: Path) -> bool:
    """By the file's content. False where it cannot be read: who reads it then says why."""
    try:
        require_file(path, MAX_FILE_BYTES)
        with path.open("rb") as file:
            return _MAGIC in file.read(_MAGIC_WITHIN)
    except (OSError, InputError):
        return False


def _of_pdf(path: Path, pages: Sequence[int] | None) -> list[Drawing]:
    count = limited(page_count, path, path, _SIMPLER)
    if count == 0:
        raise InputError(path, "has no pages", "Export the plan again.")
    for page in pages or ():
        if page > count:
            fault = f"has {counted(count, 'page')}, and no page {page}"
            raise InputError(path, fault, "Name others with --pages.")
    if pages is None and count > MOST_DRAWINGS:
        raise InputError(
            path,
            f"has {count} pages; each is read as a storey, and at most {MOST_DRAWINGS} are",
            "Name the pages with the plans, the lowest storey first, such as --pages 2-3,5.",
        )
    return [Drawing(path, page) for page in pages or range(1, count + 1)]


def page_count(path: Path) -> int:
    """How many pages a PDF has; to be called within limits, as `rendered` is."""
    with _opened(path) as document:
        return len(document)


def rendered(drawing: Drawing) -> Scan:
    """A page at a resolution that gives its longest side `RENDERED_PX`, or `_MOST_DPI`."""
    with _opened(drawing.path) as document:
        page = document[drawing.page - 1]
        size_pt = page.get_size()
        if not all(math.isfinite(side) and side >= 1.0 for side in size_pt):
            fault = f"page {drawing.page} has no size ({size_pt[0]:g} x {size_pt[1]:g} points)"
            raise InputError(drawing.path, fault, "Export the plan again.")
        scale = min(RENDERED_PX / max(size_pt), _MOST_DPI / _POINTS_PER_INCH)
        # Its own bytes: the bitmap's end with the document.
        pixels = page.render(scale=scale, rev_byteorder=True).to_numpy()[..., :3].copy()
    return Scan(
        np.ascontiguousarray(pixels, dtype=np.uint8),
        file_digest(drawing.path),
        dpi=scale * _POINTS_PER_INCH,
        on_paper=True,
    )


@contextmanager
def _opened(path: Path) -> Iterator[pypdfium2.PdfDocument]:
    """A PDF, closed again; what PDFium says of it is told as an InputError."""
    import pypdfium2  # not at the top: pictures need none of it

    try:
        document = pypdfium2.PdfDocument(path)
    except pypdfium2.PdfiumError as error:
        if "password" in str(error).lower() or "security" in str(error).lower():
            remedy = "Save it without a password, or give a picture of the page."
            raise InputError(path, "is an encrypted PDF", remedy) from error
        raise _damaged(path, error) from error
    try:
        yield document
    except pypdfium2.PdfiumError as error:
        raise _damaged(path, error) from error
    finally:
        document.close()


def _damaged(path: Path, error: Exception) -> InputError:
    fault = f"is a PDF that is truncated or damaged ({error})"
    return InputError(path, fault, "Export it again, or give a picture of the page.")


def _resolution(path: Path) -> float | None:
    """Pixels per inch, where a picture states them."""
    try:
        with Image.open(path) as image:
            dpi = image.info.get("dpi")
    except DAMAGE:
        return None
    if not isinstance(dpi, tuple) or not dpi:
        return None
    value = float(dpi[0])
    return value if math.isfinite(value) and value > 1.0 else None
