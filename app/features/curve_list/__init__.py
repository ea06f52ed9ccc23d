"""List of curves: selected and edited curves, their names, colours, locks and visibility.

- ``commands``: the list in the window; actions on all selected curves, and edits by rows.
- ``panel``: the list widget, the panel with its buttons and the menu of colours.
- ``rows``: painted rows and their parts.  ``row_drag``: drag of a row.
  ``model``: entries of the list, as a Qt model.
"""
