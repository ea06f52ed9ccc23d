"""Names of a package that are imported when they are first used (SPEC 1), listed once, in its stub.

What `lazy_loader.attach_stub` does; curvecore depends on NumPy alone.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from importlib import import_module


def late_names(package: str, file: str) -> tuple[Callable[[str], object], Callable[[], list[str]], list[str]]:
    """Return ``__getattr__``, ``__dir__`` and ``__all__`` of a package that has a stub ``__init__.pyi``.

    Each name has a line of its own there: ``from package.module import name as name``. Neither ``ast`` nor
    ``pathlib`` is asked, which take ten times as long to import as all of this.
    """
    with open(f"{file.removesuffix('.py')}.pyi", encoding="utf-8") as stub:  # noqa: PTH123 - see above
        lines = [line.split() for line in stub if line.startswith("from ")]
    module_of = {words[-1]: words[1] for words in lines}

    def getattr_of_package(name: str) -> object:
        if name not in module_of:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        value: object = getattr(import_module(module_of[name]), name)
        setattr(sys.modules[package], name, value)
        return value

    return getattr_of_package, lambda: sorted(module_of), sorted(module_of)
