"""What the verb is asked to do: drawings to read, or a document to rebuild the house from."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from pydantic import JsonValue

from veduta.imaging.read import MAX_FILE_BYTES
from veduta.plan.load import DOCUMENT, MAX_BYTES
from veduta.run.digests import input_digest
from veduta.run.edited import refuse_other_json
from veduta.run.errors import InputError
from veduta.run.names import real_path

Kind = Literal["drawings", "document"]
_OTHER_JSON = {
    "place.json": "says where the house stands",
    "report.json": "says how the work went",
}


@dataclass(frozen=True)
class Call:
    """The inputs of one call: drawings from the lowest storey up, or one document."""

    kind: Kind
    paths: tuple[Path, ...]
    digests: tuple[str, ...]

    @property
    def subject(self) -> str:
        """What the report is about."""
        return ", ".join(path.name for path in self.paths)

    @property
    def identity(self) -> list[JsonValue]:
        """What a key is made of: the names are written into the result."""
        return [[path.name, digest] for path, digest in zip(self.paths, self.digests, strict=True)]

    def is_in_place(self, out: Path) -> bool:
        """Whether the document is the one of OUT itself."""
        return self.kind == "document" and real_path(self.paths[0]) == real_path(out / DOCUMENT)


def plan_call(paths: Sequence[Path]) -> Call:
    """The inputs, with their digests; InputError where they do not go together."""
    if not paths:
        raise InputError("IMAGE", "no drawing is named", f"Name a drawing, or a {DOCUMENT}.")
    documents = [path for path in paths if path.suffix.lower() == ".json"]
    if documents and len(paths) > 1:
        raise InputError(
            documents[0], "is a document among other inputs", "Give drawings, or one document."
        )
    if documents:
        refuse_other_json(
            documents[0], _OTHER_JSON, "a plan", lambda path: f"Give {path.with_name(DOCUMENT)}"
        )
    kind: Kind = "document" if documents else "drawings"
    bound = MAX_BYTES if documents else MAX_FILE_BYTES
    return Call(kind, tuple(paths), tuple(input_digest(path, bound) for path in paths))
