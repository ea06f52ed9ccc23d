"""pyqtgraph, imported without what nobody here asks for: a tenth of the start.

Its package imports all that it has, down to tables, spin boxes and processes: a hundred modules, of which a
plot that paints itself takes a few. What else it offers is imported when somebody asks the package for a name
that is not there.

pyqtgraph also has modules of its own with all names of ``QtCore``, ``QtGui`` and ``QtWidgets``, so that it
may change some (``_copy_attrs`` in its ``Qt/__init__.py``). PySide makes a class or an enumeration when
it is first asked for, so that a copy of all of them is a twentieth of the start. Here these modules fetch
a name when they are asked for it.
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

_TAKEN = {"Qt", "Point", "functions", "GraphicsScene", "graphicsItems.ViewBox", "widgets.GraphicsView"}
"""The modules of pyqtgraph whose names its package has from the beginning."""


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


class _Rest:
    """What a package would have imported, and has not; called with a name that it is asked for, it does.

    Attributes
    ----------
    skipped
        The modules, as the package names them, and which of their names it takes; ``*`` stands for all.
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
    """Run the package of pyqtgraph, where only what is `_TAKEN` is imported."""
    spec = find_spec("pyqtgraph")
    assert spec is not None
    assert spec.loader is not None
    package = module_from_spec(spec)
    rest, nothing = _Rest(package), object()

    def import_taken(
        name: str,
        where: Mapping[str, object] | None = None,
        local: Mapping[str, object] | None = None,
        names: Sequence[str] = (),
        level: int = 0,
    ) -> ModuleType:
        if level and name and name not in _TAKEN:
            rest.skipped.append((name, names))
            empty = ModuleType(name)
            vars(empty).update((each, nothing) for each in names if each != "*")
            return empty
        return builtins.__import__(name, where, local, names, level)

    own = vars(package)["__builtins__"] = {**vars(builtins), "__import__": import_taken}
    sys.modules["pyqtgraph"] = package
    spec.loader.exec_module(package)
    own["__import__"] = builtins.__import__
    for name in [name for name, value in vars(package).items() if value is nothing]:
        delattr(package, name)
    vars(package)["__getattr__"] = rest


with _names_when_asked_for():
    if "pyqtgraph" not in sys.modules:
        _import_pyqtgraph()
    import pyqtgraph as pg
    from pyqtgraph.graphicsItems.ViewBox.ViewBox import ChildGroup

__all__ = ["ChildGroup", "pg"]
