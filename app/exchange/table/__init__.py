"""Tables, read as curves.

- ``source``: the file of a table, and the curves that options make of it; the way in for everybody else.
- ``table``: tables in memory.  ``text``: tables of text, from bytes to numbers.  ``columns``: their roles.
- ``curves``: tables as curves.  ``thinning``: as few rows as a tolerance takes.
- ``clipboard``: blocks of numbers on the clipboard.

Arrays of NumPy, JSON, GPX and some paths of robots become tables in ``formats``.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
