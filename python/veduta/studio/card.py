"""What the page of an exported place says to those who run no script.

A messenger or a search engine that shows a card for a link reads the head of the page as it is sent.
The words of the place are written into it, by the Open Graph protocol (ogp.me), with a picture where
there is one.
"""

from __future__ import annotations

import html
import re
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import urlsplit

from PIL import Image, ImageOps
from pydantic import Field

from veduta.imaging.encode import jpeg_bytes
from veduta.imaging.read import read_image
from veduta.place.manifest import Place
from veduta.run.errors import InputError
from veduta.run.options import Options

CARD = "card.jpg"
CARD_PX = (1200, 630)
"""Width and height: what most services show whole."""
_QUALITY = 86
_LARGE_PX = 600
"""Cards across the page show pictures of this width and more; others stand beside the words."""
GENERAL = "A measured, walkable place made with Veduta"
_TITLE = re.compile(r"<title>[^<]*</title>")
_DESCRIPTION = re.compile(r'<meta name="description"[^>]*>\s*')


class CardOptions(Options):
    """What a link to the exported place is shown with."""

    picture: Path | None = Field(
        default=None,
        description="picture for the card of a link, such as one saved in the studio (with --web)",
    )
    address: str | None = Field(
        default=None,
        description="where the folder will be served, https://...: cards need it for the picture "
        "(with --web)",
    )


def checked_address(address: str) -> str:
    """The address of the folder, ending in a slash; InputError where it is none."""
    try:
        parts = urlsplit(address)
        found = parts.scheme in ("http", "https") and parts.hostname is not None
    except ValueError:
        found = False
    if not found:
        raise InputError(
            f"--address {address}",
            "is no address of a page",
            "Write it whole: https://example.org/place/",
        )
    bare = address.split("#")[0].split("?")[0]
    return bare if bare.endswith("/") else f"{bare}/"


@dataclass(frozen=True)
class CardPicture:
    """The picture of a card as JPEG, and its width and height (px)."""

    content: bytes
    size_px: tuple[int, int]

    @property
    def is_small(self) -> bool:
        """Whether services show larger ones."""
        return self.size_px < CARD_PX


def card_picture(path: Path) -> CardPicture:
    """What of the picture has the shape of `CARD_PX`, from its middle; never enlarged."""
    image = Image.fromarray(read_image(path).pixels)
    share = min(1.0, *(own / side for own, side in zip(image.size, CARD_PX, strict=True)))
    width, height = (max(1, round(share * side)) for side in CARD_PX)
    fitted = ImageOps.fit(image, (width, height), Image.Resampling.LANCZOS)
    return CardPicture(jpeg_bytes(fitted, _QUALITY), (width, height))


def page_of(page: str, place: Place, *, address: str | None, picture: CardPicture | None) -> str:
    """The studio's page with the words of the place in its head.

    address: of the folder, as `checked_address` has it. picture: what lies in the folder as `CARD`.
    """
    title = place.title or "A place made with Veduta"
    description = place.description or GENERAL
    rows = [("name", "description", description)]
    if place.author:
        rows.append(("name", "author", place.author))
    if place.licence:
        rows.append(("name", "license", place.licence))
    rows += [
        ("property", "og:type", "website"),
        ("property", "og:title", title),
        ("property", "og:description", description),
    ]
    if address is not None:
        rows.append(("property", "og:url", address))
    if picture is not None:
        width, height = picture.size_px
        large = width >= _LARGE_PX
        rows += [
            ("property", "og:image", f"{address or ''}{CARD}"),
            ("property", "og:image:width", str(width)),
            ("property", "og:image:height", str(height)),
            ("property", "og:image:alt", title),
            ("name", "twitter:card", "summary_large_image" if large else "summary"),
        ]
    said = "\n    ".join(
        f'<meta {kind}="{field}" content="{html.escape(words)}" />' for kind, field, words in rows
    )
    head = f"<title>{html.escape(title)} · Veduta</title>\n    {said}"
    bare = _DESCRIPTION.sub("", page, count=1)
    return _TITLE.sub(lambda _: head, bare, count=1)
