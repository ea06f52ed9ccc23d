"""pyqtgraph, imported without a copy of every name of Qt.

pyqtgraph has modules of its own with all names of ``QtCore``, ``QtGui`` and ``QtWidgets``, so that it
may change some (``_copy_attrs`` in its ``Qt/__init__.py``). PySide makes a class or an enumeration when
it is first asked for, so that a copy of all of them is a twentieth of the start. Here these modules fetch
a name when they are asked for it.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from types import ModuleType
from typing import Any

from PySide6 import QtCore, QtGui, QtWidgets


def _fetching(source: ModuleType, name: str) -> ModuleType:
    """Return a module that has the names of another, each from when it is first asked for."""
    module = ModuleType(name, source.__doc__)

    def fetch(what: str) -> Any:  # noqa: ANN401 - whatever the name stands for
        value = getattr(source, what)
        setattr(module, what, value)
        return value

    vars(module).update(__getattr__=fetch, __dir__=lambda: [*vars(module), *dir(source)])
    return module


@contextmanager
def _names_when_asked_for() -> Iterator[None]:
    """Give pyqtgraph such modules while it is imported, and nothing to copy."""
    if "pyqtgraph" in sys.modules:
        yield
        return
    listings = {source: source.__dir__ for source in (QtCore, QtGui, QtWidgets)}
    for source in listings:
        name = f"pyqtgraph.Qt.{source.__name__.rpartition('.')[2]}"
        sys.modules[name] = _fetching(source, name)
        vars(source)["__dir__"] = list
    try:
        yield
    finally:
        for source, listing in listings.items():
            vars(source)["__dir__"] = listing


with _names_when_asked_for():
    import pyqtgraph as pg
    from pyqtgraph.graphicsItems.ViewBox.ViewBox import ChildGroup

__all__ = ["ChildGroup", "pg"]
