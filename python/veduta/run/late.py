"""Packages that bring what they offer when it is first asked for."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Mapping
from typing import Any


def on_demand(package: str, name: str, where: Mapping[str, str]) -> Any:
    """What a package offers by this name; from then on, the package has it itself.

    `where` names the module below the package that has it, or nothing for a module of that name.
    Raises AttributeError, as modules do, for a name that is not offered.
    """
    if name not in where:
        raise AttributeError(f"module {package!r} has no attribute {name!r}")
    module = importlib.import_module(f"{package}.{where[name] or name}")
    found = getattr(module, name) if where[name] else module
    setattr(sys.modules[package], name, found)
    return found
