"""What a call with `--style` keeps of the style until it is written: tables, pictures, files."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from veduta.run.page import Picture, Table

FOLDER = "style"


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
