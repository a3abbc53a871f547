"""The built-in assets by name: `builtin/window-casement@1`.

`@0` is the finest level of detail and what a name without a level means; `@1` is for across the
street, `@2` for afar. `builtin/dormer-arched:window@1` is a part of an asset that is more than one
thing.
"""

from __future__ import annotations

import functools
import re
from collections.abc import Callable
from dataclasses import replace

from veduta.grammar.assets import doors, hoods, plants, railings, roofs, shops, stonework, windows
from veduta.grammar.assets.asset import Asset

PREFIX = "builtin/"
LEVELS = 3
Maker = Callable[[str, int], Asset]
MAKERS: dict[str, Maker] = {
    "window-casement": windows.casement,
    "window-french": windows.door,
    "window-small-panes": windows.small_panes,
    "window-sash": windows.sash,
    "window-arched": windows.arched,
    "window-lancet": windows.lancet,
    "window-fixed": windows.fixed,
    "window-ribbon": windows.ribbon,
    "shutter": windows.shutter,
    "door-double": doors.double,
    "door-single": doors.single,
    "door-glazed": doors.glazed,
    "door-entrance": doors.entrance,
    "door-garage": doors.garage,
    "door-step": doors.step,
    "shop-front": shops.glazed,
    "shop-window": shops.window,
    "shop-door": shops.door,
    "shop-shelves": shops.shelves,
    "shop-counter": shops.counter,
    "entrance-hall": shops.hall,
    "railing-iron": railings.iron,
    "railing-bars": railings.bars,
    "railing-balustrade": railings.balustrade,
    "railing-glass": railings.glass,
    "cornice": stonework.cornice,
    "cornice-dentils": stonework.dentils,
    "string-course": stonework.string_course,
    "plinth": stonework.plinth,
    "console": stonework.console,
    "modillion": stonework.modillion,
    "block": stonework.block,
    "quoin": stonework.quoin,
    "keystone": stonework.keystone,
    "window-hood": stonework.hood,
    "window-hood-round": hoods.segmental,
    "dormer-pediment": roofs.pediment,
    "dormer-arched": roofs.arched,
    "dormer-shed": roofs.shed,
    "dormer-gabled": roofs.gabled,
    "skylight": roofs.skylight,
    "tree-broad": plants.broad,
    "tree-slim": plants.slim,
    "shrub": plants.shrub,
    "chimney-stack": roofs.stack,
    "chimney-single": roofs.single,
    "chimney-pot": roofs.one_pot,
}

DORMER = {"wall": ("stone", "cheek"), "window": ("frame", "pane"), "roof": ("zinc", "tile")}
PARTS = {name: DORMER for name in MAKERS if name.startswith("dormer-")}
"""By its surface class, the slots of each part of assets that are more than one thing."""


def parts_of(name: str) -> list[str]:
    """What may follow an asset's name after a colon."""
    return list(PARTS.get(name.removeprefix(PREFIX), ()))


def builtin_names() -> list[str]:
    """All names, without levels."""
    return [PREFIX + name for name in MAKERS]


def described(name: str) -> str:
    """One line about an asset, without its measures."""
    text = (MAKERS[name.removeprefix(PREFIX)].__doc__ or "").split("\n", maxsplit=1)[0]
    return re.sub(r",? \d[^:,]* m( by .*)?\.$", "", text).rstrip(".")


@functools.lru_cache(maxsize=512)
def builtin(name: str) -> Asset | None:
    """The asset of this name; None where there is none."""
    word, _, level = name.removeprefix(PREFIX).partition("@")
    plain, colon, part = word.partition(":")
    maker = MAKERS.get(plain)
    if not name.startswith(PREFIX) or maker is None or level not in ("", "0", "1", "2"):
        return None
    if colon:
        whole, slots = builtin(name.replace(f":{part}", "", 1)), PARTS.get(plain, {}).get(part)
        return None if whole is None or slots is None else whole.part(name, slots)
    finest = replace(maker(name, 0), in_plane=True)
    if level in ("", "0"):
        return finest
    return replace(maker(name, int(level)), given_box_m=finest.box_m, in_plane=True)
