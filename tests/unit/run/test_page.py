"""The HTML report: self-contained, and nothing of a file's text is taken for markup."""

from __future__ import annotations

from html.parser import HTMLParser

import pytest

from veduta.run.page import Bars, Page, Picture, Table, render
from veduta.run.report import Failure, Report, StepRecord

EVIL = "<script>alert('x')</script>"


class Reader(HTMLParser):
    """All tags, links and text."""

    def __init__(self) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.links: list[str] = []
        self.texts: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        self.links += [value or "" for name, value in attrs if name in {"src", "href"}]

    def handle_data(self, data: str) -> None:
        self.texts.append(data)


def page_text(page: Page, **fields: object) -> str:
    report = Report.model_validate(
        {"verb": "facade", "subject": EVIL, "state": "done", "options": {"a": EVIL}, **fields}
    )
    return render(report, page).decode()


def read(page: Page, **fields: object) -> Reader:
    reader = Reader()
    reader.feed(page_text(page, **fields))
    return reader


def test_text_of_files_is_escaped() -> None:
    reader = read(
        Page(
            title=EVIL,
            summary=EVIL,
            facts=[(EVIL, EVIL)],
            tables=[Table(EVIL, [EVIL], [[EVIL]], note=EVIL)],
            bars=[Bars(EVIL, EVIL, [(EVIL, 1.0)])],
        ),
        notes=[EVIL],
        failures=[Failure(subject=EVIL, kind="input", reason=EVIL)],
        steps=[StepRecord(EVIL, 1.0, {EVIL: EVIL}, [EVIL])],
    )
    assert "script" not in reader.tags
    assert sum(EVIL in text for text in reader.texts) >= 10


def test_what_is_for_experts_is_folded_after_the_rest() -> None:
    """Nothing of it stands outside of a fold; a failed report opens it."""
    tables = [Table("costs", ["x"], [[1]], note="why", for_experts=True), Table("sizes", ["y"], [])]
    steps = [StepRecord("walk")]
    for failures in ([], [Failure(subject="a", kind="input", reason="b")]):
        text = page_text(Page("a", "b", tables=tables), steps=steps, failures=failures)
        before, fold, after = text.partition("<details")
        assert ("sizes" in before, "costs" in before, "walk" in before) == (True, False, False)
        assert all(word in after for word in ("costs", "why", "walk"))
        assert after.startswith(" open>" if failures else ">")
        assert fold


@pytest.mark.parametrize(
    ("state", "failed", "told"),
    [
        ("done", 0, ("state done", "done")),
        ("done", 2, ("state partly", "done, 2 failed")),
        ("failed", 2, ("state failed", "failed")),
    ],
)
def test_a_call_with_failures_is_not_simply_done(
    state: str, failed: int, told: tuple[str, str]
) -> None:
    failures = [Failure(subject="a", kind="input", reason="b")] * failed
    text = page_text(Page("a", "b"), state=state, failures=failures)
    style, words = told
    assert f'<span class="{style}">{words}</span>' in text
    if style == "state partly":
        assert ".state.partly { background: var(--warn)" in text


def test_pictures_are_inside() -> None:
    reader = read(Page("a", "b", pictures=[Picture("c", "d", b"\x89PNG", "image/png", "c.png")]))
    assert reader.links == ["c.png", "data:image/png;base64,iVBORw=="]


def test_bars_are_to_scale() -> None:
    bars = Bars("t", "s", [("a", 2.0), ("b", 0.5), ("c", 0.0)])
    assert [bars.width(value) for _, value in bars.values] == [100, 25, 0]
    assert Bars("t", "s", [("a", 0.0)]).width(0.0) == 0


def test_what_a_file_is_has_no_backticks() -> None:
    text = page_text(Page("a", "b", files=[("walls/", "pictures, and `walls.glb` <b>")]))
    assert "pictures, and <code>walls.glb</code> &lt;b&gt;" in text
