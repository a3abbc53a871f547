"""The web application: the built studio at `/`, the place read-only below `/place/`."""

from __future__ import annotations

import mimetypes
from pathlib import Path

from fastapi import FastAPI, Request
from starlette.responses import FileResponse, RedirectResponse, Response
from starlette.types import ASGIApp

from veduta.studio.files import VisibleFiles
from veduta.studio.guard import Guard

# The machine's own tables may lack these, or have others.
_TYPES = {
    ".glb": "model/gltf-binary",
    ".js": "text/javascript",
    ".woff2": "font/woff2",
    ".svg": "image/svg+xml",
}


def make_app(static: Path, place: Path, token: str | None) -> ASGIApp:
    """The application for one place; nothing in it writes or runs what it is sent."""
    for suffix, media_type in _TYPES.items():
        mimetypes.add_type(media_type, suffix)
    app = FastAPI(docs_url=None, redoc_url=None, openapi_url=None)

    @app.get("/")
    def page(request: Request) -> Response:
        if "place" not in request.query_params:
            return RedirectResponse("/?place=place/", status_code=307)
        return FileResponse(static / "index.html", media_type="text/html")

    app.mount("/place", VisibleFiles(directory=place), name="place")
    app.mount("/", VisibleFiles(directory=static, fixed="assets"), name="studio")
    return Guard(app, token)
