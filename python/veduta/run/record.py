"""The run record `OUT/.veduta/run.json`: what Veduta wrote into OUT, and how far it came."""

from __future__ import annotations

from pathlib import Path, PurePosixPath
from typing import Annotated, Literal

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, JsonValue, ValidationError

import veduta
from veduta.run.atomic import write_bytes
from veduta.run.errors import InputError
from veduta.run.report import Failure

PRIVATE = ".veduta"
CALL = "."
"""The item that stands for the call as a whole: the files that lie in OUT itself."""


def _inside(path: str) -> str:
    """Refuse a path that leads out of OUT: the record may come from somebody else."""
    pure = PurePosixPath(path)
    if pure.is_absolute() or ".." in pure.parts or not pure.parts or pure.parts[0] == PRIVATE:
        raise ValueError(f"{path!r} leads out of the result folder")
    return path


RelativePath = Annotated[str, AfterValidator(_inside)]


class _Record(BaseModel):
    model_config = ConfigDict(extra="forbid")


class Item(_Record):
    """One result of the run, usually of one input, in a folder of its own name."""

    key: str
    state: Literal["publishing", "done", "failed"]
    failure: Failure | None = None
    summary: dict[str, JsonValue] = Field(
        default={}, description="what the verb needs of a finished item without reading it again"
    )


class RunRecord(_Record):
    """What the last run into OUT was, and every file that Veduta wrote there."""

    schema_: Literal["veduta/run"] = Field(default="veduta/run", alias="schema")
    version: Literal[1] = 1
    veduta: str = veduta.__version__
    command: str
    key: str = Field(description="digest of inputs, options and the verb's version")
    state: Literal["unfinished", "finished"] = "unfinished"
    inputs: list[str] = Field(default=[], description="the call's items, in its order")
    items: dict[str, Item] = {}
    files: dict[RelativePath, str] = Field(
        default={}, description="SHA-256 of each file as Veduta last wrote it, by path in OUT"
    )
    pending: dict[RelativePath, str] = Field(
        default={}, description="the same for files that are being renamed into place"
    )

    def save(self, out: Path) -> None:
        """Write the record whole or not at all."""
        content = self.model_dump_json(by_alias=True, indent=1) + "\n"
        write_bytes(out / PRIVATE / "run.json", content.encode())

    def files_of(self, item: str) -> list[str]:
        """The paths in OUT of the files that belong to one item."""
        if item == CALL:
            return sorted(path for path in self.files if "/" not in path)
        return sorted(path for path in self.files if path.startswith(f"{item}/"))


def load_record(out: Path) -> RunRecord | None:
    """The record in `out`, or None where Veduta has written nothing."""
    path = out / PRIVATE / "run.json"
    try:
        return RunRecord.model_validate_json(path.read_bytes())
    except FileNotFoundError:
        return None
    except NotADirectoryError as error:
        raise InputError(out, "is not a folder", "Choose another one with -o.") from error
    except ValidationError as error:
        first = error.errors()[0]
        where = ".".join(str(part) for part in first["loc"]) or "the file"
        raise InputError(
            path,
            f"is not a run record of this version ({where}: {first['msg']})",
            "Choose another folder with -o.",
        ) from error
