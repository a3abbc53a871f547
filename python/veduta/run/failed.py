"""What a run tells that gave nothing: how far it came, and why it ended there."""

from __future__ import annotations

from veduta.run.options import Options
from veduta.run.page import Page, render
from veduta.run.report import Failure, Report, StepRecord, versions


def failure_report(
    verb: str,
    subject: str,
    failure: Failure,
    options: Options,
    steps: list[StepRecord],
    *,
    page: Page | None = None,
    engines: dict[str, str] | None = None,
) -> tuple[Report, bytes]:
    """The report of what failed, and its page.

    page: what there is to show of the way there; without it, that nothing was built. engines: the
    versions of what took part beside Veduta itself.
    """
    report = Report(
        verb=verb,
        subject=subject,
        state="failed",
        options=options.model_dump(mode="json"),
        steps=steps,
        failures=[failure],
        versions={**versions(), **(engines or {})},
    )
    return report, render(report, page or Page(title=subject, summary="Nothing was built."))
