"""`veduta view`: show a place in the browser."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from veduta.studio.server import Address

SUMMARY = "Show a place in the browser"


def run(argv: list[str]) -> int:
    """Parse the arguments and serve until Ctrl-C; returns the exit code."""
    import tyro

    from veduta.cli.arguments import parse
    from veduta.studio.options import ViewOptions
    from veduta.studio.server import serve

    options = parse(
        ViewOptions,
        "veduta view",
        argv,
        description=f"{SUMMARY}: serves the studio from this machine until Ctrl-C.",
        config=(tyro.conf.PositionalRequiredArgs, tyro.conf.FlagCreatePairsOff),
    )
    serve(options, _announce)
    print("Stopped.")
    return 0


def _announce(address: Address) -> None:
    print(f"Veduta studio: {address.url}", flush=True)
    if address.token is not None:
        print("Others can reach this address; the token in it is their key.", flush=True)
    print("Ctrl-C ends it.", flush=True)
