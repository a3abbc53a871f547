"""The head of an exported page: what a reader that runs no script makes of it."""

from __future__ import annotations

import io
from html.parser import HTMLParser
from pathlib import Path

import pytest
from PIL import Image

from veduta.place.manifest import Place, Start
from veduta.run.errors import InputError
from veduta.studio.card import CARD_PX, CardPicture, card_picture, checked_address, page_of

PAGE = (
    '<!doctype html>\n<html lang="en">\n  <head>\n    <meta charset="utf-8" />\n'
    '    <meta name="description" content="general" />\n    <title>Veduta</title>\n'
    "  </head>\n  <body></body>\n</html>\n"
)


class _Head(HTMLParser):
    """Collects the title and the fields of a page."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.fields: list[tuple[str, str]] = []
        self.title = ""
        self._in_title = False
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = dict(attrs)
        self._in_title = tag == "title"
        name = given.get("name") or given.get("property")
        if tag == "meta" and name is not None:
            self.fields.append((name, given["content"] or ""))

    def handle_data(self, data: str) -> None:
        if self._in_title:
            self.title += data
            self._in_title = False


def place(**words: str) -> Place:
    return Place(parts=[], start=Start(eye=(0, 0, 0), target=(0, 1, 0)), **words)  # type: ignore[arg-type]


def test_the_words_of_the_place_are_read_without_a_script() -> None:
    told = place(
        title='The "square" <1900> & \\1',
        description="Two\nlines",
        author="Museum",
        licence="CC0-1.0",
    )
    head = _Head(
        page_of(PAGE, told, address="https://example.org/a/", picture=CardPicture(b"", (400, 210)))
    )
    fields = dict(head.fields)
    assert head.title == 'The "square" <1900> & \\1 · Veduta'
    assert fields["og:title"] == told.title
    assert fields["description"] == fields["og:description"] == "Two\nlines"
    assert (fields["author"], fields["license"]) == ("Museum", "CC0-1.0")
    assert fields["og:url"] == "https://example.org/a/"
    assert fields["og:image"] == "https://example.org/a/card.jpg"
    assert (fields["og:image:width"], fields["og:image:height"]) == ("400", "210")
    assert fields["twitter:card"] == "summary"
    assert len(head.fields) == len(fields)


def test_nothing_is_claimed_of_a_place_without_words() -> None:
    fields = dict(_Head(page_of(PAGE, place(), address=None, picture=None)).fields)
    assert "author" not in fields
    assert "og:image" not in fields
    assert "og:url" not in fields


@pytest.mark.parametrize(
    ("size", "made"),
    [
        ((2000, 3000), CARD_PX),
        ((1200, 630), CARD_PX),
        ((400, 2000), (400, 210)),
        ((1600, 300), (571, 300)),
    ],
)
def test_the_picture_fills_the_card_from_its_middle_and_is_not_enlarged(
    size: tuple[int, int], made: tuple[int, int], tmp_path: Path
) -> None:
    image = Image.new("RGB", size, (200, 30, 30))
    middle = tuple(side // 2 for side in size)
    image.paste((30, 30, 200), (middle[0] - 20, middle[1] - 20, middle[0] + 20, middle[1] + 20))
    image.save(tmp_path / "view.png")
    told = card_picture(tmp_path / "view.png")
    card = Image.open(io.BytesIO(told.content))
    assert card.size == told.size_px == made
    assert told.is_small == (made != CARD_PX)
    pixel = card.getpixel((made[0] // 2, made[1] // 2))
    assert isinstance(pixel, tuple)
    assert pixel[2] > 150 > pixel[0]


def test_a_picture_that_is_none_is_named(tmp_path: Path) -> None:
    (tmp_path / "view.png").write_bytes(b"no picture")
    with pytest.raises(InputError, match=r"view\.png"):
        card_picture(tmp_path / "view.png")


@pytest.mark.parametrize(
    "address", ["example.org", "ftp://example.org/", "https://", "http://[::1/"]
)
def test_an_address_that_is_none_is_refused(address: str) -> None:
    with pytest.raises(InputError, match="--address"):
        checked_address(address)


def test_an_address_ends_in_a_slash() -> None:
    assert checked_address("https://example.org/a?b#c") == "https://example.org/a/"
