"""Short names of the modules in folders: `carom.fit` is the module `carom.tracks.fit`, loaded once.

`python -m carom.fit` runs it. Type checkers know the long names alone.
"""

from __future__ import annotations

import importlib
import importlib.util
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from types import ModuleType
from typing import Any

MODULES = {"carom.fit": "carom.tracks.fit"}
for _name in ("drills", "gymnasium", "matches", "pettingzoo", "plans", "pool", "potting", "rules"):
    MODULES[f"carom.{_name}"] = f"carom.games.{_name}"


class _Loader(Loader):
    """Gives the module of a long name, whose spec it has; `python -m` wants its code."""

    def __init__(self, spec: Any) -> None:
        self.spec = spec

    def create_module(self, spec: ModuleSpec) -> ModuleType:
        return importlib.import_module(self.spec.name)

    def exec_module(self, module: ModuleType) -> None:
        module.__spec__ = self.spec  # in place of that of the short name

    def get_code(self, name: str) -> Any:
        return self.spec.loader.get_code(self.spec.name)


class Finder(MetaPathFinder):
    """For `sys.meta_path`, behind the finder of files."""

    def find_spec(self, name: str, path: Any, target: Any = None) -> ModuleSpec | None:
        spec = importlib.util.find_spec(MODULES[name]) if name in MODULES else None
        return None if spec is None else ModuleSpec(name, _Loader(spec), origin=spec.origin)
