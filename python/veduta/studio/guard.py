"""Who may talk to the server: pages of this machine, or whoever knows the token."""

from __future__ import annotations

import ipaddress
import re
import secrets
from dataclasses import dataclass
from urllib.parse import parse_qsl, urlencode

from starlette.datastructures import Headers, MutableHeaders
from starlette.requests import cookie_parser
from starlette.responses import PlainTextResponse, RedirectResponse, Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send

COOKIE = "veduta_token"
TOKEN_BYTES = 24

# The page may not be framed, sniffed or read by other origins. The page's own content policy is
# in its HTML, so that an exported folder has it too.
_HEADERS = {
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Resource-Policy": "same-origin",
}

_PLACE = "/place/"
# What lies in a place came from anywhere: a page among it may show itself, and runs nothing.
_PLACE_POLICY = (
    "default-src 'none'; img-src 'self' data:; style-src 'unsafe-inline'; base-uri 'none'; "
    "form-action 'none'; frame-ancestors 'none'; sandbox"
)
_HOST = re.compile(r"(localhost|[0-9.]+|\[[0-9a-f:]+\])(?::[0-9]{1,5})?", re.IGNORECASE)
"""A name or an address, and perhaps a port; nothing else is a host."""


def is_loopback(host: str) -> bool:
    """Whether only this machine can reach the address."""
    if host == "localhost":
        return True
    try:
        return ipaddress.ip_address(host.strip("[]")).is_loopback
    except ValueError:
        return False


def new_token() -> str:
    """A token that cannot be guessed."""
    return secrets.token_urlsafe(TOKEN_BYTES)


@dataclass(frozen=True)
class Guard:
    """Refuses requests that may not be answered, and adds the protecting headers.

    Without a token the server listens on loopback, and only requests that name this machine as
    their host pass: a foreign page whose name was made to resolve to 127.0.0.1 does not.
    """

    app: ASGIApp
    token: str | None

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer one request, or refuse it."""
        if scope["type"] != "http":
            await self.app(scope, receive, send)
            return
        refusal = self._refusal(scope)
        answer = self.app if refusal is None else refusal

        async def send_guarded(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                if str(scope["path"]).startswith(_PLACE):
                    headers["Content-Security-Policy"] = _PLACE_POLICY
                for name, value in _HEADERS.items():
                    headers[name] = value
                headers.setdefault("Cache-Control", "no-cache")
            await send(message)

        await answer(scope, receive, send_guarded)

    def _refusal(self, scope: Scope) -> Response | None:
        headers = Headers(scope=scope)
        if self.token is None:
            if _is_here(headers):
                return None
            return PlainTextResponse("This server answers this machine only.\n", status_code=403)
        given = cookie_parser(headers.get("cookie", "")).get(COOKIE, "")
        if secrets.compare_digest(given.encode(), self.token.encode()):
            return None
        return self._admission(scope)

    def _admission(self, scope: Scope) -> Response:
        """Trade a token in the address for a cookie, so that it does not stay in the address."""
        query = parse_qsl(scope["query_string"].decode("latin-1"))
        given = dict(query).get("token", "")
        if self.token is None or not secrets.compare_digest(given.encode(), self.token.encode()):
            return PlainTextResponse(
                "Open the whole address that `veduta view` printed, with its token.\n",
                status_code=401,
            )
        rest = urlencode([(name, value) for name, value in query if name != "token"], safe="/")
        # Relative, and one slash at most: the answer must not lead to another server.
        path = "/" + scope["path"].lstrip("/\\")
        response = RedirectResponse(f"{path}?{rest}" if rest else path, status_code=303)
        response.set_cookie(COOKIE, self.token, httponly=True, samesite="strict")
        return response


def _is_here(headers: Headers) -> bool:
    """Whether the one Host header names this machine."""
    given = headers.getlist("host")
    found = _HOST.fullmatch(given[0]) if len(given) == 1 else None
    return found is not None and is_loopback(found[1].lower())
