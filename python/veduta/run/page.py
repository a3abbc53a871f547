"""`report.html`: the report with pictures and bars, in one file that needs nothing else."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cache
from typing import Literal

from jinja2 import Environment, PackageLoader, StrictUndefined, Template, select_autoescape
from markupsafe import Markup

from veduta.run.names import given_names
from veduta.run.report import Count, Report


@dataclass(frozen=True)
class Picture:
    """An encoded image with a title; `note` says in a line what it shows.

    wide: as broad as the page, because of what is written in it.
    """

    title: str
    note: str
    data: bytes
    mime: Literal["image/jpeg", "image/png"]
    link: str | None = None
    wide: bool = False

    @property
    def url(self) -> str:
        """The image inside the page."""
        return f"data:{self.mime};base64,{base64.b64encode(self.data).decode('ascii')}"


@dataclass(frozen=True)
class Table:
    """Rows under column names; numbers are set to the right. A row may link to its own page.

    for_experts: stands folded at the end, among what nobody needs to use the result.
    """

    title: str
    columns: Sequence[str]
    rows: Sequence[Sequence[Count | None]]
    links: Sequence[str | None] = ()
    note: str = ""
    for_experts: bool = False


@dataclass(frozen=True)
class Bars:
    """A bar per label, drawn to one scale."""

    title: str
    unit: str
    values: Sequence[tuple[str, float]]

    def width(self, value: float) -> float:
        """Per cent of the longest bar."""
        longest = max((abs(other) for _, other in self.values), default=0.0)
        return 100 * abs(value) / longest if longest else 0.0


@dataclass(frozen=True)
class Page:
    """What the page shows beside the report itself."""

    title: str
    summary: str
    facts: Sequence[tuple[str, str]] = ()
    doubts: Sequence[str] = ()
    """What must be known before the result is trusted, as the terminal says it."""
    pictures: Sequence[Picture] = ()
    bars: Sequence[Bars] = ()
    tables: Sequence[Table] = ()
    files: Sequence[tuple[str, str]] = field(default=())
    """Name and meaning of each file that lies beside the page."""


def render(report: Report, page: Page) -> bytes:
    """The page as UTF-8 HTML; everything that comes from a file is escaped."""
    return given_names(_template().render(report=report, page=page)).encode()


@cache
def _template() -> Template:
    """The page without its contents; to read it takes longer than to fill it."""
    environment = Environment(
        loader=PackageLoader("veduta.run"),
        autoescape=select_autoescape(default=True, default_for_string=True),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["figure"] = _figure
    environment.filters["coded"] = _coded
    return environment.get_template("report.html.j2")


def _coded(text: str) -> Markup:
    """What stands between backticks, as it does in the docs, in the letters of a file's name."""
    pieces = enumerate(text.split("`"))
    return Markup().join(Markup("<code>{}</code>").format(p) if k % 2 else p for k, p in pieces)


def _figure(value: object) -> str:
    """A number as a person writes it: two decimals, or three digits that count; None as a dash."""
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:,.2f}" if abs(value) >= 1 or value == 0 else f"{value:.3g}"
    return f"{value:,}" if isinstance(value, int) else str(value)
