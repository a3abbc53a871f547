"""Footage of an animal becomes a living 3D animal in the place (`veduta fauna`)."""

from veduta.fauna.command import run_fauna
from veduta.fauna.options import FaunaOptions

__all__ = ["FaunaOptions", "run_fauna"]
