"""Which style a front has, and which structure of it: its rules as a stochastic grammar."""

from veduta.facade.style.infer import require_style
from veduta.facade.style.step import find_style

__all__ = ["find_style", "require_style"]
