"""What CityEngine's CGA reference prints beside its examples of functions.

By the page of the reference (the last part of its address): what the examples define, and values
with what the reference gives for them, written as `str` writes it. Facts of the reference of 2022
to 2025; names and definitions are shortened. Examples that hang on files are not among them, and
pictures have no values.
"""

from __future__ import annotations

from reference_arrays import ARRAYS
from reference_page import Page
from reference_texts import TEXTS

PAGES: dict[str, Page] = ARRAYS | TEXTS
FIRST_TRY = 231
"""How many of them came out when they were tried first, before the engine was mended for any."""
