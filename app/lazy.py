"""Lazy submodules (PEP 562): a module of a package is imported when it is first used.

The editor starts without what few people need, and the command line without Qt. A module that is wanted late
is asked of its package, where it is used::

    from app import panels

    panels.crash_dialog.CrashDialog(…)  # imports app/panels/crash_dialog.py, the first time

The package names it for type checkers, and nothing else::

    if TYPE_CHECKING:
        from app.panels import crash_dialog as crash_dialog
    else:
        __getattr__ = lazy_submodules(__name__)
"""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from types import ModuleType


def lazy_submodules(package: str) -> Callable[[str], ModuleType]:
    """Return the ``__getattr__`` of a package whose modules are imported when they are first used."""

    def getattr_of_package(name: str) -> ModuleType:
        try:
            return import_module(f"{package}.{name}")
        except ModuleNotFoundError as problem:
            if problem.name != f"{package}.{name}":
                raise
            raise AttributeError(f"module {package!r} has no attribute {name!r}") from None

    return getattr_of_package
