"""Qt itself, below everything that uses it: remedies, and styles of a document in Qt's terms.

- ``overrides``: overrides that report their exceptions, and keys of a widget.
- ``labels``: text of others as it is written, not as HTML.
- ``strokes``: pens and fill rules of styles, for the screen and for pictures.

`spare_sources` spares imports the search through the source of every module.
"""

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
