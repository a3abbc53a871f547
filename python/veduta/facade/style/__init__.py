"""Which style a front has, and which structure of it: its rules as a stochastic grammar."""

from veduta.facade.style.infer import StyleFound, require_style
from veduta.facade.style.step import find_style
from veduta.facade.style.told import style_pictures, style_tables
from veduta.facade.style.write import write_style

__all__ = [
    "StyleFound",
    "find_style",
    "require_style",
    "style_pictures",
    "style_tables",
    "write_style",
]
