"""Imports as Python does them, without PySide's look at each."""

from __future__ import annotations

import builtins


def spare_sources() -> None:
    """Give Python's import back, which PySide replaces; nobody here asks for ``__feature__``.

    PySide's own costs as much again as an import that finds its module there, some 7,000 times at the start,
    and reads and searches the source of each module that comes after it, 650 of them, to learn whether it may
    use Qt under other names (``shibokensupport/feature.py``). That is an eighth of the start. A module that
    PySide has not looked at uses Qt under its usual names.
    """
    names = vars(builtins)
    names["__import__"] = names.get("__orig_import__", builtins.__import__)
