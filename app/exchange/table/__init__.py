"""Tables in.

- ``table``, ``source``: a table in memory, and the file it comes from.
- ``text``, ``lines``, ``layout``, ``columns``: tables of text.
- ``numpy_array``, ``json_table``: arrays of NumPy and JSON, as tables.
- ``curves``, ``thinning``: tables as curves, thinned out if asked.  ``prepared``: for the window.
- ``clipboard``: blocks of numbers on the clipboard.
"""
