"""The built-in assets by name: `builtin/window-casement@1`.

`@0` is the finest level of detail and what a name without a level means; `@1` is for across the
street, `@2` for afar.
"""

from __future__ import annotations

import functools
from collections.abc import Callable

from veduta.grammar.assets import windows
from veduta.grammar.assets.asset import Asset

PREFIX = "builtin/"
LEVELS = 3
Maker = Callable[[str, int], Asset]
MAKERS: dict[str, Maker] = {
    "window-casement": windows.casement,
    "window-french": windows.door,
    "window-sash": windows.sash,
    "window-arched": windows.arched,
    "window-lancet": windows.lancet,
    "window-fixed": windows.fixed,
    "window-ribbon": windows.ribbon,
}


def builtin_names() -> list[str]:
    """All names, without levels."""
    return [PREFIX + name for name in MAKERS]


@functools.lru_cache(maxsize=512)
def builtin(name: str) -> Asset | None:
    """The asset of this name; None where there is none."""
    plain, _, level = name.removeprefix(PREFIX).partition("@")
    maker = MAKERS.get(plain)
    if not name.startswith(PREFIX) or maker is None or level not in ("", "0", "1", "2"):
        return None
    return maker(name, int(level or 0))
