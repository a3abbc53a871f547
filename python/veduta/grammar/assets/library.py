"""Assets by name: built-in ones, and files beside the rule file."""

from __future__ import annotations

import difflib
from pathlib import Path

from veduta import _core
from veduta.grammar.assets.asset import Asset
from veduta.grammar.assets.catalogue import builtin, builtin_names
from veduta.run.errors import InputError


class Library:
    """What `i` may insert; `folder` is that of the rule file, below which files are looked for."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._known: dict[str, Asset] = {}

    def __getitem__(self, name: str) -> Asset:
        """The asset; InputError where there is none."""
        if name not in self._known:
            self._known[name] = self._found(name)
        return self._known[name]

    def add_to(self, rules: _core.GrammarRules, name: str) -> None:
        """Hand an asset to the engine; InputError where there is none."""
        asset = self[name]
        rules.add_asset(name, asset.points_m, asset.corners, asset.offsets)

    def _found(self, name: str) -> Asset:
        asset = builtin(name)
        if asset is not None:
            return asset
        near = difflib.get_close_matches(name, builtin_names(), n=1)
        hint = f"Did you mean `{near[0]}`?" if near else "docs/assets.md lists the built-in ones."
        raise InputError(name, "is no asset that is built in", hint)
