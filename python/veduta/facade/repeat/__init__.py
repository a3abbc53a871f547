"""The building as rules that repeat: floors and columns of the photo on a lot of any size."""

from veduta.facade.repeat.rules import repeating_rules

__all__ = ["repeating_rules"]
