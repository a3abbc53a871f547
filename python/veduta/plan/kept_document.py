"""An edited plan.json in OUT stays as it is: what it then does not say, and what it needs.

Options may make another house of it than it describes.
"""

from __future__ import annotations

import shutil
from pathlib import Path

from veduta.plan.document import PlanDocument
from veduta.plan.load import DOCUMENT, load_document
from veduta.plan.options import SiteOptions
from veduta.plan.surroundings.panorama import FILES, Pictures
from veduta.plan.surroundings.site import with_site
from veduta.run.errors import InputError

_OPTIONS = "--north, --place, --time, --panorama, --photos and --scale"
UNWRITTEN = (
    f"{DOCUMENT} was edited and stays as it is: it does not say what {_OPTIONS} do. Give them"
    " again at the next rebuild, or write them there."
)
"""The house was made with them."""
LEFT = (
    f"{DOCUMENT} was edited and stays as it is, and so does its house: it was not made anew with"
    f" what {_OPTIONS} say. Give them when you rebuild it from {DOCUMENT}, or write them there."
)
"""The house was made without them."""


def sited(document: PlanDocument, options: SiteOptions, panorama: Pictures | None) -> PlanDocument:
    """The document with where its house stands, by the options, and what is around it."""
    kind = None if panorama is None else panorama.kind
    return with_site(document, options).model_copy(update={"panorama": kind})


def says_site(path: Path, options: SiteOptions, panorama: Pictures | None) -> bool:
    """Whether the document in a file, with the pictures beside it, says what the options do.

    panorama: that of the options. A document that cannot be read says nothing.
    """
    if options == SiteOptions():
        return True
    try:
        document = load_document(path)
    except InputError:
        return False
    if panorama is None:
        return with_site(document, options) == document
    beside = {name: path.parent / name for name in panorama.files}
    same = all(
        beside[name].is_file() and beside[name].read_bytes() == content
        for name, content in panorama.files.items()
    )
    return same and sited(document, options, panorama) == document


def keep_panorama(document: PlanDocument, folder: Path, work: Path) -> None:
    """Have the pictures that the document in a folder names among the results of a rebuild.

    Whatever is no result of the rebuild is removed. A missing one is the next rebuild's to tell.
    """
    for name in () if document.panorama is None else FILES[document.panorama]:
        if (folder / name).is_file():
            shutil.copyfile(folder / name, work / name)
