"""HEIC photos of telephones, where `pillow-heif` is installed (`pip install veduta[heic]`).

It is optional, for its wheels hold an encoder under another licence than all the rest.
"""

from __future__ import annotations

import importlib
from functools import cache

HEIC_SUFFIXES = (".heic", ".heif", ".hif")
NOT_READ = (
    "is a HEIC photo, which is not read: install pillow-heif (pip install veduta[heic]), or save it"
    " as JPEG"
)


@cache
def heic_formats() -> tuple[str, ...]:
    """What Pillow can open beside its own formats: HEIF, or nothing."""
    try:
        plugin = importlib.import_module("pillow_heif")
    except ImportError:
        return ()
    plugin.register_heif_opener()
    return ("HEIF",)


def heic_suffixes() -> tuple[str, ...]:
    """Suffixes of HEIC photos, if they are read."""
    return HEIC_SUFFIXES if heic_formats() else ()
