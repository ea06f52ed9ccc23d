"""Python's own imports, without PySide's search through sources."""

from __future__ import annotations

import builtins


def spare_sources() -> None:
    """Restore Python's import, which PySide replaces; the program does not use ``__feature__``.

    PySide's import doubles the time of an import of a loaded module, some 7,000 times at the start, and reads
    and searches the source of each later module to learn whether it uses Qt under other names
    (``shibokensupport/feature.py``). That is an eighth of the start. Without the search, modules use Qt under
    its usual names.
    """
    names = vars(builtins)
    names["__import__"] = names.get("__orig_import__", builtins.__import__)
