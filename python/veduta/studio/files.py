"""Files of a folder as answers: named by their digests, and packed where that makes them smaller."""

from __future__ import annotations

import gzip
import os
from functools import lru_cache
from pathlib import Path

from fastapi.staticfiles import StaticFiles
from starlette.datastructures import Headers
from starlette.responses import FileResponse, Response
from starlette.staticfiles import NotModifiedResponse
from starlette.types import Scope

from veduta.run.digests import file_digest

PACKED = frozenset({".js", ".css", ".html", ".json", ".svg", ".glb", ".ply"})
"""Pictures are packed already."""
LEAST_BYTES = 1024
MOST_BYTES = 64 * 1024**2
"""Larger files are sent as they are: they would be held in memory."""
WORTH = 0.9
"""A packed file is sent where it is smaller than this share of the file."""
LEVEL = 5
HELD = 256
"""So many packed files are held."""
FOR_GOOD = "public, max-age=31536000, immutable"
"""Of files whose names say what they hold: another content has another name."""


class VisibleFiles(StaticFiles):
    """Files below one folder; names that begin with a dot (work, temporary) are not there.

    The base class resolves each path, links included, and refuses what leads out of the folder.
    fixed: a folder below it whose files never change under their names.
    """

    def __init__(self, *, directory: Path, fixed: str | None = None) -> None:
        super().__init__(directory=directory)
        self._fixed = None if fixed is None else os.path.realpath(directory / fixed) + os.sep

    def lookup_path(self, path: str) -> tuple[str, os.stat_result | None]:
        """Full path and status of a file, None where it may not be seen."""
        if any(name.startswith(".") for name in Path(path).parts) or "\0" in path:
            return "", None
        return super().lookup_path(path)

    def file_response(
        self,
        full_path: str | os.PathLike[str],
        stat_result: os.stat_result,
        scope: Scope,
        status_code: int = 200,
    ) -> Response:
        """The file, or that it is the one that the browser has."""
        path = Path(full_path)
        told = Headers(scope=scope)
        key = (path, stat_result.st_mtime_ns, stat_result.st_size)
        response: Response = FileResponse(path, status_code=status_code, stat_result=stat_result)
        response.headers["ETag"] = f'"{_digest(*key)}"'
        if path.suffix in PACKED:
            response.headers["Vary"] = "Accept-Encoding"
        if self._fixed is not None and str(path).startswith(self._fixed):
            response.headers["Cache-Control"] = FOR_GOOD
        if self.is_not_modified(response.headers, told):
            return NotModifiedResponse(response.headers)
        if not _may_pack(path, stat_result.st_size, told):
            return response
        packed = _packed(*key)
        if packed is None:
            return response
        kept = {
            name: value
            for name, value in response.headers.items()
            if name not in {"content-length", "accept-ranges"}
        }
        return Response(packed, status_code, kept | {"Content-Encoding": "gzip"})


def _may_pack(path: Path, size: int, told: Headers) -> bool:
    """Whether this browser takes the file packed. A part of a file is sent as it is."""
    accepts = "gzip" in told.get("accept-encoding", "") and "range" not in told
    return accepts and path.suffix in PACKED and LEAST_BYTES <= size <= MOST_BYTES


@lru_cache(maxsize=4096)
def _digest(path: Path, _changed_ns: int, _size: int) -> str:
    """Of the content; made anew when the file has changed."""
    return file_digest(path)


@lru_cache(maxsize=HELD)
def _packed(path: Path, _changed_ns: int, size: int) -> bytes | None:
    """The content packed; None where that is not worth it."""
    packed = gzip.compress(path.read_bytes(), LEVEL, mtime=0)
    return packed if len(packed) < WORTH * size else None
