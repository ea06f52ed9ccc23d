"""Tables in.

- ``table``, ``source``: a table in memory, and the file it comes from, also as curves.
- ``text``, ``lines``, ``layout``, ``columns``: tables of text.
- ``numpy_array``, ``json_table``: arrays of NumPy and JSON, as tables.
- ``curves``, ``thinning``: tables as curves, thinned out if asked.  ``prepared``: for the window.
- ``family_word``: what a cell says of a curve's family.
- ``clipboard``: blocks of numbers on the clipboard.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
