"""Footage of an animal becomes a living 3D animal in the place (`veduta fauna`)."""

from veduta.fauna.command import run_fauna
from veduta.fauna.options import FaunaOptions
from veduta.fauna.recipe import Record

__all__ = ["FaunaOptions", "Record", "run_fauna"]
