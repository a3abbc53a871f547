"""Digests of files, and keys: what a result depends on, in 64 hexadecimal digits."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

from pydantic import JsonValue

from veduta.run.options import Options


def file_digest(path: Path) -> str:
    """The SHA-256 of a file's content."""
    with path.open("rb") as handle:
        return hashlib.file_digest(handle, "sha256").hexdigest()


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
