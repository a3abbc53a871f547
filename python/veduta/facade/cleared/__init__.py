"""The front without what stands before it: what that is, and what takes its place."""

from veduta.facade.cleared.kinds import KINDS, hidden_kinds
from veduta.facade.cleared.stored import BEFORE, BEFORE_COLOURS, before_png, load_before
from veduta.facade.cleared.surface import Cleared, clear_surface

__all__ = [
    "BEFORE",
    "BEFORE_COLOURS",
    "KINDS",
    "Cleared",
    "before_png",
    "clear_surface",
    "hidden_kinds",
    "load_before",
]
