"""Serving a place: an address, a token where others can reach it, and an end on Ctrl-C."""

from __future__ import annotations

import errno
import os
import re
import socket
import sys
import threading
import webbrowser
from collections.abc import Callable
from dataclasses import dataclass

import uvicorn

from veduta.run.errors import InputError
from veduta.studio.app import make_app
from veduta.studio.content import place_folder, studio_folder
from veduta.studio.guard import is_loopback, new_token
from veduta.studio.options import ViewOptions

# What a page writes after #: fields of `name=value` (studio/src/core/view-link.ts).
VIEW = re.compile(r"[A-Za-z0-9_.~!*'(),;:@/%+-]+=[A-Za-z0-9_.~!*'(),;:@/%+=&-]*")
# How long answers in hand may take after Ctrl-C (s).
_LAST_ANSWERS_S = 2


@dataclass(frozen=True)
class Address:
    """Where the studio is found."""

    url: str
    token: str | None


def serve(options: ViewOptions, announce: Callable[[Address], None]) -> None:
    """Serve until Ctrl-C. `announce` is called once, when the address answers."""
    place = place_folder(options.out)
    static = studio_folder()
    token = None if is_loopback(options.host) else new_token()
    with _listening_socket(options.host, options.port) as listener:
        view = view_of(options.at)
        address = _address(options.host, listener.getsockname()[1], token, view)
        announce(address)
        if not options.no_browser:
            _open_browser(address.url)
        config = uvicorn.Config(
            make_app(static, place, token),
            lifespan="off",
            log_level="warning",
            access_log=False,
            server_header=False,
            timeout_graceful_shutdown=_LAST_ANSWERS_S,
        )
        try:
            uvicorn.Server(config).run(sockets=[listener])
        except KeyboardInterrupt:
            # uvicorn has closed its connections by now; this is how a person ends the server.
            return


def _listening_socket(host: str, port: int) -> socket.socket:
    """A socket that already queues connections, so that the page may be opened at once."""
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    listener = socket.socket(family, socket.SOCK_STREAM)
    try:
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listener.bind((host.strip("[]"), port))
        listener.listen()
    except OSError as error:
        listener.close()
        raise _bind_error(error, host, port) from error
    return listener


def _bind_error(error: OSError, host: str, port: int) -> InputError:
    if error.errno == errno.EADDRINUSE:
        return InputError(
            f"--port {port}",
            "another program listens there",
            "Choose another, or 0 for a free one.",
        )
    if error.errno in (errno.EACCES, errno.EPERM):
        return InputError(
            f"--port {port}", "this user may not listen there", "Choose one above 1023, or 0."
        )
    return InputError(
        f"--host {host}",
        f"it is no address of this machine ({error.strerror})",
        "Use 127.0.0.1, or 0.0.0.0 for all of its networks.",
    )


def view_of(link: str | None) -> str:
    """What a link says of the view: `#...`, empty where none is asked for.

    InputError where there is no view in it.
    """
    if link is None:
        return ""
    _, _, view = link.rpartition("#")
    if not VIEW.fullmatch(view):
        raise InputError(
            f"--at {link}",
            "it holds no view of a place",
            "Copy the whole address of a page that shows one, with what follows #.",
        )
    return f"#{view}"


def _address(host: str, port: int, token: str | None, view: str = "") -> Address:
    """The address to open; a wildcard host is replaced by the machine's own name."""
    name = socket.gethostname() if host in ("0.0.0.0", "::") else host
    if ":" in name and not name.startswith("["):
        name = f"[{name}]"
    query = "place=place/" if token is None else f"place=place/&token={token}"
    return Address(url=f"http://{name}:{port}/?{query}{view}", token=token)


def _open_browser(url: str) -> None:
    """Open the page, but never a text browser in the terminal that shows our messages."""
    graphical = any(os.environ.get(name) for name in ("DISPLAY", "WAYLAND_DISPLAY", "BROWSER"))
    if sys.platform.startswith("linux") and not graphical:
        return
    threading.Thread(target=webbrowser.open, args=(url,), daemon=True).start()
