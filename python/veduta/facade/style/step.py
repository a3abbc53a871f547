"""The step of `veduta facade --style`: look, compare, search."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from veduta.facade.document import FacadeDocument
from veduta.facade.eyes import Seen, look
from veduta.facade.options import StyleOptions
from veduta.facade.style.infer import infer_style
from veduta.facade.style.observed import observe
from veduta.facade.style.search import SearchParameters
from veduta.facade.style.told import CAVEAT, next_step, style_line, style_picture, style_tables
from veduta.facade.style.write import style_files
from veduta.facade.style_told import StyleTold
from veduta.run.errors import NotFoundError
from veduta.run.progress import StepProgress
from veduta.run.report import StepRecord, timed_step


def find_style(
    document: FacadeDocument,
    rectified: NDArray[np.uint8],
    seen: Seen | None,
    options: StyleOptions,
    steps: list[StepRecord],
    progress: StepProgress,
) -> tuple[FacadeDocument, StyleTold | None]:
    """The style of a front, and the document with a note of it; None where none was asked for.

    rectified: (h, w, 3) uint8 sRGB, the rectified photo of the document. seen: what the learned
    eyes saw of it, None where they have not looked yet.
    """
    if options.style is None:
        return document, None
    progress("style", 0.0)
    with timed_step(steps, "style") as step:
        observed = observe(seen or look(rectified), document)
        parameters = SearchParameters(steps=options.style_steps)
        try:
            found = infer_style(
                document,
                observed,
                options.style,
                parameters,
                lambda _, share: progress("style", share),
            )
        except NotFoundError as error:
            step.rejected.append(str(error))
            return _noted(document, f"style: none was found ({error})"), None
        searched = found.chosen.searched
        step.counts |= {
            "styles": len(found.candidates) - 1,
            "derived": sum(one.posterior.grammar.derived for one in found.candidates),
            "steps": 0 if searched is None else searched.steps,
        }
    told = StyleTold(
        tables=tuple(style_tables(found)),
        pictures=(style_picture(found),),
        files=style_files(found, document.source.image),
        line=f"{style_line(found)}; {CAVEAT}. {next_step(found, options.style)}",
    )
    return _noted(document, told.line), told


def _noted(document: FacadeDocument, note: str) -> FacadeDocument:
    return document.model_copy(update={"notes": [*document.notes, note]})
