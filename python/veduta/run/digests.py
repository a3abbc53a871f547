"""Digests of files, and keys: what a result depends on, in 64 hexadecimal digits."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

from pydantic import JsonValue

from veduta.run.errors import InputError
from veduta.run.inputs import require_file
from veduta.run.options import Options


def file_digest(path: Path) -> str:
    """The SHA-256 of a file's content."""
    with path.open("rb") as handle:
        return hashlib.file_digest(handle, "sha256").hexdigest()


def input_digest(
    path: Path, max_bytes: int | None = None, if_missing: str = "Check its name."
) -> str:
    """The digest of a file that a person has named, of at most `max_bytes`.

    InputError where it is no file, too large, not there (`if_missing` says what to do then), or may
    not be read.
    """
    try:
        require_file(path, max_bytes)
        return file_digest(path)
    except FileNotFoundError as error:
        raise InputError(path, "does not exist", if_missing) from error
    except OSError as error:
        fault = f"cannot be read ({error.strerror})"
        raise InputError(path, fault, "Check its permissions.") from error


def bytes_digest(content: bytes) -> str:
    """The SHA-256 of what a file is to hold."""
    return hashlib.sha256(content).hexdigest()


def result_key(step: str, version: str, options: Options, inputs: JsonValue) -> str:
    """The key of a result: it changes with the step's version, any option and any input.

    `inputs` holds the inputs' digests, in the order in which they matter.
    """
    content = {
        "step": step,
        "version": version,
        "options": options.model_dump(mode="json"),
        "inputs": inputs,
    }
    canonical = json.dumps(content, sort_keys=True, separators=(",", ":"), ensure_ascii=False)
    return hashlib.sha256(canonical.encode()).hexdigest()
