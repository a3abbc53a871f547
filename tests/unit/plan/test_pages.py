"""Drawings in files: pages of PDFs, in the order and with the resolution that is theirs."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pypdfium2
import pytest
from PIL import Image
from pydantic import ValidationError

from veduta.plan import pages
from veduta.plan.document import Text
from veduta.plan.options import InputOptions
from veduta.plan.pages import Drawing, find_drawings, read_drawing
from veduta.plan.scale.ratios import ratio_voters
from veduta.run.errors import InputError

A4_PT = (595.0, 842.0)
ENCRYPTED = b"""%%PDF-1.4
1 0 obj
<< /Type /Catalog /Pages 2 0 R >>
endobj
2 0 obj
<< /Type /Pages /Kids [3 0 R] /Count 1 >>
endobj
3 0 obj
<< /Type /Page /Parent 2 0 R /MediaBox [0 0 595 842] >>
endobj
4 0 obj
<< /Filter /Standard /V 1 /R 2 /P -4 /O <%s> /U <%s> >>
endobj
trailer
<< /Root 1 0 R /Encrypt 4 0 R /ID [<00112233445566778899aabbccddeeff> <00>] >>
%%%%EOF
""" % (b"5a" * 32, b"c3" * 32)
"""No password fits what it says of its password; the empty one is tried first."""


def blank_pdf(path: Path, count: int, size_pt: tuple[float, float] = A4_PT) -> Path:
    document = pypdfium2.PdfDocument.new()
    for _ in range(count):
        document.new_page(*size_pt)
    document.save(path)
    return path


def shaded_pdf(path: Path, shades: list[int]) -> Path:
    """A page for each shade of grey, 4 x 3 inches."""
    sheets = [Image.new("RGB", (400, 300), (shade, shade, shade)) for shade in shades]
    sheets[0].save(path, save_all=True, append_images=sheets[1:], resolution=100.0)
    return path


def test_each_page_is_a_drawing_and_pictures_are_one(tmp_path: Path) -> None:
    pdf = blank_pdf(tmp_path / "house.pdf", 3)
    picture = tmp_path / "attic.png"
    Image.new("L", (9, 9)).save(picture)
    labels = [one.label for one in find_drawings([pdf, picture])]
    assert labels == ["house.pdf page 1", "house.pdf page 2", "house.pdf page 3", "attic.png"]


def test_pages_are_read_in_the_order_in_which_they_are_named(tmp_path: Path) -> None:
    pdf = shaded_pdf(tmp_path / "house.pdf", [40, 120, 200])
    found = find_drawings([pdf], [3, 1])
    assert [int(read_drawing(one).pixels.mean()) for one in found] == pytest.approx(
        [200, 40], abs=2
    )


def test_a_pdf_is_known_by_its_content(tmp_path: Path) -> None:
    pdf = blank_pdf(tmp_path / "scan.png", 2)
    assert [one.page for one in find_drawings([pdf])] == [1, 2]


@pytest.mark.parametrize(
    ("size_pt", "size_px", "dpi"),
    [
        (A4_PT, (2120, 3000), 3000 / 842 * 72),
        ((3370.0, 2384.0), (3000, 2123), 3000 / 3370 * 72),
        ((36.0, 18.0), (300, 150), 600.0),
    ],
)
def test_pages_of_all_sizes_are_rendered_at_a_bounded_one(
    tmp_path: Path, size_pt: tuple[float, float], size_px: tuple[int, int], dpi: float
) -> None:
    scan = read_drawing(Drawing(blank_pdf(tmp_path / "a.pdf", 1, size_pt), 1))
    height, width = scan.pixels.shape[:2]
    assert (width, height) == pytest.approx(size_px, abs=1)
    assert scan.dpi == pytest.approx(dpi)
    assert scan.pixels.dtype == np.uint8
    assert scan.pixels.min() == 255  # a page without anything is white


def test_colours_are_not_swapped(tmp_path: Path) -> None:
    Image.new("RGB", (100, 100), (250, 120, 10)).save(tmp_path / "a.pdf")
    colour = read_drawing(Drawing(tmp_path / "a.pdf", 1)).pixels[200, 200].astype(int)
    assert colour == pytest.approx([250, 120, 10], abs=3)


def test_a_ratio_on_a_page_is_metres_per_pixel(tmp_path: Path) -> None:
    """On paper, 1 cm at 1:100 is 1 m: 842 points of an A4 page are 29.7 m."""
    scan = read_drawing(Drawing(blank_pdf(tmp_path / "a.pdf", 1), 1))
    text = Text(text="1:100", box_px=[(0, 0), (9, 0), (9, 9), (0, 9)], score=1.0)
    (voter,) = ratio_voters([text], scan.dpi, on_paper=scan.on_paper)
    (reading,) = voter.hypotheses
    assert np.exp(reading.log_mpp) * scan.pixels.shape[0] == pytest.approx(29.70, abs=0.02)
    (doubted,) = ratio_voters([text], 72.0)[0].hypotheses
    assert reading.trust > doubted.trust


def test_five_hundred_pages_are_refused_with_what_to_do(tmp_path: Path) -> None:
    pdf = blank_pdf(tmp_path / "book.pdf", 500)
    with pytest.raises(InputError, match=r"book.pdf: has 500 pages; .* such as --pages 2-3,5"):
        find_drawings([pdf])
    assert [one.page for one in find_drawings([pdf], [499, 7])] == [499, 7]
    with pytest.raises(InputError, match=r"has 500 pages, and no page 501"):
        find_drawings([pdf], [501])


def test_more_drawings_than_storeys_are_refused(tmp_path: Path) -> None:
    one = blank_pdf(tmp_path / "a.pdf", pages.MOST_DRAWINGS - 1)
    other = blank_pdf(tmp_path / "b.pdf", 2)
    with pytest.raises(InputError, match=r"b.pdf: would be storey 21 of 21"):
        find_drawings([one, other])


def test_an_encrypted_pdf_is_refused(tmp_path: Path) -> None:
    pdf = tmp_path / "secret.pdf"
    pdf.write_bytes(ENCRYPTED)
    with pytest.raises(InputError, match=r"is an encrypted PDF\. Save it without a password"):
        find_drawings([pdf])
    # The very same file without the word for it opens: it is the encryption that is refused.
    pdf.write_bytes(ENCRYPTED.replace(b"/Encrypt 4 0 R", b""))
    assert len(find_drawings([pdf])) == 1


@pytest.mark.parametrize("part", [0.02, 0.5])
def test_a_cut_pdf_is_damaged(tmp_path: Path, part: float) -> None:
    content = shaded_pdf(tmp_path / "a.pdf", [9, 99]).read_bytes()
    pdf = tmp_path / "cut.pdf"
    pdf.write_bytes(content[: int(part * len(content))])
    with pytest.raises(InputError, match=r"cut.pdf: is a PDF that is truncated or damaged"):
        read_drawing(find_drawings([pdf], [2])[0])


def test_pages_without_a_pdf_are_a_mistake(tmp_path: Path) -> None:
    picture = tmp_path / "attic.png"
    Image.new("L", (9, 9)).save(picture)
    with pytest.raises(InputError, match="--pages: there is no PDF among the drawings"):
        find_drawings([picture], [1])


def test_how_pages_are_written() -> None:
    assert InputOptions().page_numbers() is None
    assert InputOptions(pages="5,2-4").page_numbers() == [5, 2, 3, 4]
    assert len(InputOptions(pages="1-99999").page_numbers() or []) == 100
    for wrong in ("", "0", "1-", "2,,3", "a", "1 2", "4-2"):
        with pytest.raises(ValidationError):
            InputOptions(pages=wrong)
