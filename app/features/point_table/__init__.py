"""The points as numbers: a table to read, type into, copy from and paste into.

To add a column: add a record to ``view_model.point_columns``; the table finds it there.

- ``commands``: the table in the window; changes of the document by what is typed and pasted.
- ``edits``: filling, pasting and resetting cells.
- ``panel``: the table with its footer.  ``view``, ``model``: the table for Qt.
"""
