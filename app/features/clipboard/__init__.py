"""Cut, copy, paste, duplicate and delete: of the selected points, or else of curves.

- ``commands``: cut, copy, duplicate and delete; the derivatives of a point.  ``paste_commands``: paste.
- ``clipboard_content``: the data that other programs get.
"""
