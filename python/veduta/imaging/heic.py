"""HEIC photos of telephones: pi-heif decodes them.

Its sister pillow-heif is not used: its wheels hold an encoder under the GPL.
"""

from __future__ import annotations

from functools import cache

HEIC_SUFFIXES = (".heic", ".heif", ".hif")


@cache
def heic_formats() -> tuple[str, ...]:
    """What Pillow can open beside its own formats."""
    import pi_heif

    pi_heif.register_heif_opener()
    return ("HEIF",)
