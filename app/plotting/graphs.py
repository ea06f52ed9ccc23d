"""pyqtgraph, imported without the modules that the program does not use: they are a tenth of the start.

Its package imports everything, down to tables, spin boxes and processes: a hundred modules, of which a plot
that paints itself needs a few. The others are imported when a missing name of the package is requested.

pyqtgraph also has modules of its own with all names of ``QtCore``, ``QtGui`` and ``QtWidgets``, so that it
may change some (``_copy_attrs`` in its ``Qt/__init__.py``). PySide makes a class or an enumeration when it
is first requested, so that a copy of all of them is a twentieth of the start. Here these modules fetch a
name when it is requested.
"""

from __future__ import annotations

import builtins
import sys
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from importlib.util import find_spec, module_from_spec
from types import ModuleType
from typing import Any

from PySide6 import QtCore, QtGui, QtWidgets

_IMPORTED = {"Qt", "Point", "functions", "GraphicsScene", "graphicsItems.ViewBox", "widgets.GraphicsView"}
"""The modules of pyqtgraph that are imported with its package."""


def _lazy_module(source: ModuleType, name: str) -> ModuleType:
    """Return a module with the names of another, each copied when it is first requested."""
    module = ModuleType(name, source.__doc__)

    def fetch(attribute: str) -> Any:  # noqa: ANN401 - whatever the name stands for
        value = getattr(source, attribute)
        setattr(module, attribute, value)
        return value

    vars(module).update(__getattr__=fetch, __dir__=lambda: [*vars(module), *dir(source)])
    return module


@contextmanager
def _lazy_qt_modules() -> Iterator[None]:
    """Give pyqtgraph lazy modules of Qt while it is imported, and no names to copy."""
    if "pyqtgraph" in sys.modules:
        yield
        return
    listings = {source: source.__dir__ for source in (QtCore, QtGui, QtWidgets)}
    for source in listings:
        name = f"pyqtgraph.Qt.{source.__name__.rpartition('.')[2]}"
        sys.modules[name] = _lazy_module(source, name)
        vars(source)["__dir__"] = list
    try:
        yield
    finally:
        for source, listing in listings.items():
            vars(source)["__dir__"] = listing


class _Rest:
    """Imports that a package has skipped; called with a missing name, they are made up for.

    Attributes
    ----------
    skipped
        The modules, as the package names them, and the names that it imports from each; ``*`` is all.
    """

    def __init__(self, package: ModuleType) -> None:
        self._package = package
        self.skipped: list[tuple[str, Sequence[str]]] = []

    def __call__(self, name: str) -> Any:  # noqa: ANN401 - whatever the name stands for
        if not name.startswith("__"):
            skipped, self.skipped = self.skipped, []
            for module, names in skipped:
                self._import(module, names)
            if name in vars(self._package):
                return vars(self._package)[name]
        raise AttributeError(f"module {self._package.__name__!r} has no attribute {name!r}")

    def _import(self, module: str, names: Sequence[str]) -> None:
        line = f"from {self._package.__name__}.{module} import {', '.join(names)}"
        exec(line, vars(self._package))


def _import_pyqtgraph() -> None:
    """Run the package of pyqtgraph, with only the `_IMPORTED` modules."""
    spec = find_spec("pyqtgraph")
    assert spec is not None
    assert spec.loader is not None
    package = module_from_spec(spec)
    rest, nothing = _Rest(package), object()

    def import_selected(
        name: str,
        where: Mapping[str, object] | None = None,
        local: Mapping[str, object] | None = None,
        names: Sequence[str] = (),
        level: int = 0,
    ) -> ModuleType:
        if level and name and name not in _IMPORTED:
            rest.skipped.append((name, names))
            empty = ModuleType(name)
            vars(empty).update((missing, nothing) for missing in names if missing != "*")
            return empty
        return builtins.__import__(name, where, local, names, level)

    package_builtins = vars(package)["__builtins__"] = {**vars(builtins), "__import__": import_selected}
    sys.modules["pyqtgraph"] = package
    spec.loader.exec_module(package)
    package_builtins["__import__"] = builtins.__import__
    for name in [name for name, value in vars(package).items() if value is nothing]:
        delattr(package, name)
    vars(package)["__getattr__"] = rest


with _lazy_qt_modules():
    if "pyqtgraph" not in sys.modules:
        _import_pyqtgraph()
    import pyqtgraph as pg
    from pyqtgraph.graphicsItems.ViewBox.ViewBox import ChildGroup

__all__ = ["ChildGroup", "pg"]
