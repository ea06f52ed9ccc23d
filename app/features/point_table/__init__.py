"""The points as numbers: a table to read, type into, copy from and paste into.

- ``commands``: the table in the window.
- ``edits``: filling, pasting and resetting.
- ``panel``: the table with its footer.  ``view``, ``model``, ``delegate``: the table for Qt.
- ``controller``: turns what is typed and pasted into changes of the document.
"""
