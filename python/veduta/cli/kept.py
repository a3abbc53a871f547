"""What is said of files that stay as they are."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path


def tell_kept(
    out: Path, edited: Sequence[str], foreign: Sequence[str], *, up_to_date: bool
) -> None:
    """Name the files in OUT that the user changed or put there, and say if all was there before."""
    for path in edited:
        print(f"{out / path}: was edited and is left as it is")
    for path in foreign:
        print(f"{out / path}: was not made by veduta and is left as it is")
    if up_to_date:
        print(f"{out} is up to date; --force makes it anew")
