"""Imports without PySide's search for ``__feature__`` in the source of every module."""

from __future__ import annotations

import sys
from types import ModuleType


def spare_sources() -> None:
    """Have PySide read no source of a module that is imported from now on.

    PySide replaces Python's import: it finds, reads and searches the source of each module that comes after
    it, 650 of them at the start of the editor, to learn whether it may use Qt under other names
    (``_mod_uses_pyside`` in ``shibokensupport/feature.py`` of PySide6 6.6 and later). That is a tenth of the
    start. All are taken for modules that use Qt, under its usual names; one that says ``from __feature__``
    has said so before PySide asks.
    """
    feature = sys.modules.get("shibokensupport.feature")
    if hasattr(feature, "_mod_uses_pyside"):
        vars(feature)["_mod_uses_pyside"] = _takes_usual_names


def _takes_usual_names(_module: ModuleType) -> bool:
    return True
