"""What a verb tells of its work while it does it: steps, measures, notes, pictures, tables."""

from __future__ import annotations

import io
import json
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from pydantic import JsonValue

from veduta.run.atomic import atomic_folder
from veduta.run.digests import result_key
from veduta.run.errors import InputError
from veduta.run.options import Options
from veduta.run.outputs import writing_to
from veduta.run.page import Bars, Picture, Table
from veduta.run.progress import StepProgress
from veduta.run.report import StepRecord, timed_step

T = TypeVar("T")
_JPEG_QUALITY = 88


@dataclass
class Work:
    """The recorder of one run, and the folder in which its files are made.

    folder: what is written here appears in OUT at the end, all at once. stages: what a killed run
    goes on from; it is dropped when the run has ended.
    """

    folder: Path
    stages: Path
    command: str
    version: str
    options: Options
    progress: StepProgress
    steps: list[StepRecord] = field(default_factory=list)
    measures: dict[str, JsonValue] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    doubts: list[str] = field(default_factory=list)
    pictures: list[Picture] = field(default_factory=list)
    tables: list[Table] = field(default_factory=list)
    charts: list[Bars] = field(default_factory=list)
    files: list[tuple[str, str]] = field(default_factory=list)
    facts: list[tuple[str, str]] = field(default_factory=list)
    summary: str = ""
    """The line at the top of the page, and at the end of what the terminal says."""

    @contextmanager
    def step(self, name: str) -> Iterator[StepRecord]:
        """A step of the recipe: its time, counts and rejections go into the report."""
        self.progress(name, 0.0)
        with timed_step(self.steps, name) as record:
            yield record

    def measure(self, name: str, value: JsonValue) -> None:
        """A figure of the result, under a name that says its unit."""
        self.measures[name] = value

    def note(self, text: str) -> None:
        """What was assumed or left out, and why."""
        self.notes.append(text)

    def doubt(self, text: str) -> None:
        """What may be wrong with the result: the terminal says it, too."""
        self.doubts.append(text)

    def picture(
        self, title: str, note: str, pixels: NDArray[np.uint8], *, wide: bool = False
    ) -> None:
        """A picture of the page. pixels: (h, w, 3) uint8 sRGB."""
        file = io.BytesIO()
        Image.fromarray(pixels).save(file, "JPEG", quality=_JPEG_QUALITY)
        self.pictures.append(Picture(title, note, file.getvalue(), "image/jpeg", wide=wide))

    def table(self, table: Table) -> None:
        """A table of the page."""
        self.tables.append(table)

    def bars(self, bars: Bars) -> None:
        """A chart of the page."""
        self.charts.append(bars)

    def fact(self, name: str, value: str) -> None:
        """One of the few figures at the top of the page."""
        self.facts.append((name, value))

    def file(self, name: str, meaning: str) -> None:
        """A file of the result, as the page lists it."""
        self.files.append((name, meaning))

    def kept(
        self,
        name: str,
        inputs: JsonValue,
        make: Callable[[], T],
        save: Callable[[T, Path], None],
        load: Callable[[Path], T],
    ) -> T:
        """A result that a killed run need not make again.

        inputs: all that it depends on besides the version: digests, options of the step.
        save, load: write it to a folder, and read it from there.
        """
        place = self._place(name, inputs)
        if place.is_dir():
            return load(place)
        result = make()
        with writing_to(self.folder), atomic_folder(place) as folder:
            save(result, folder)
        return result

    def kept_again(self, name: str, inputs: JsonValue, load: Callable[[Path], T]) -> T:
        """The same from disk alone, once it was made: what it was made of need not stay in memory.

        InputError where it is no longer there.
        """
        place = self._place(name, inputs)
        if not place.is_dir():
            fault = f"has lost {name} while it was in use"
            raise InputError(self.stages, fault, "Leave the folder alone and call again.")
        return load(place)

    def _place(self, name: str, inputs: JsonValue) -> Path:
        key = result_key(name, self.version, Options(), [self.command, inputs])
        return self.stages / f"{name}-{key[:24]}"

    def kept_arrays(
        self, name: str, inputs: JsonValue, make: Callable[[], dict[str, NDArray[Any]]]
    ) -> dict[str, NDArray[Any]]:
        """The same for a few arrays by name."""
        return self.kept(name, inputs, make, _save_arrays, _load_arrays)


def _save_arrays(arrays: dict[str, NDArray[Any]], folder: Path) -> None:
    for name, values in arrays.items():
        np.save(folder / f"{name}.npy", values, allow_pickle=False)
    (folder / "names.json").write_text(json.dumps(list(arrays)), encoding="utf-8")


def _load_arrays(folder: Path) -> dict[str, NDArray[Any]]:
    names = json.loads((folder / "names.json").read_text(encoding="utf-8"))
    return {name: np.load(folder / f"{name}.npy", allow_pickle=False) for name in names}
