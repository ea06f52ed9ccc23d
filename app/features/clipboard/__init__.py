"""Cut, copy, paste, duplicate and delete: of what is highlighted, points or curves.

- ``commands``: cut and copy.  ``paste_commands``: paste.  ``highlight_commands``: duplicate and delete.
  ``derivative_commands``: the derivatives of a point.
- ``offer``: what other programs get.  ``content``: what the clipboard holds.  ``keys``: where they act.
"""
