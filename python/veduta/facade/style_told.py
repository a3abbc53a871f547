"""What a call with `--style` keeps of the style until it is written: tables, pictures, files."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from veduta.facade.options import StyleOptions
from veduta.run.options import flag
from veduta.run.page import Picture, Table

FOLDER = "style"
# Processor time (s) of one front with all styles compared, and with one, at 600 steps (a front of
# two houses of CMP, 17 and 4 s; others have taken twice that).
_SECONDS = {True: 30, False: 8}


@dataclass(frozen=True)
class StyleTold:
    """Tables and pictures of the report, what lies in the folder `style`, by name, and the line for
    the terminal.
    """

    tables: tuple[Table, ...]
    pictures: tuple[Picture, ...]
    files: Mapping[str, bytes]
    line: str = ""

    def write(self, folder: Path) -> None:
        """Write the files into a folder of their own."""
        into = folder / FOLDER
        into.mkdir(exist_ok=True)
        for name, content in self.files.items():
            (into / name).write_bytes(content)


def search_note(options: StyleOptions, photos: int) -> str:
    """What is said before a search begins: what it does, how long that takes, what is faster."""
    is_auto = options.style == "auto"
    what = "all styles are compared, the likeliest is" if is_auto else f"{options.style} is"
    usual = StyleOptions().style_steps
    seconds = _SECONDS[is_auto] * (0.5 + 0.5 * options.style_steps / usual)
    told = f"{seconds:.0f} s" if seconds < 90 else f"{seconds / 60:.0f} min"
    each = "" if photos == 1 else f" for each of {photos} photos"
    less = f"; {flag('style_steps')} {usual // 10} is faster, and less sure"
    return (
        f"{flag('style')} {options.style}: {what} searched: about {told} of a processor{each}"
        f"{less if options.style_steps >= usual else ''}"
    )
