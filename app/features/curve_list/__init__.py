"""The list of curves: which are chosen or edited, what each is called and how it is shown.

- ``commands``: what is done to all chosen curves by actions.  ``row_edits``: what is done by rows.
- ``panel``: the list with its buttons.  ``colour_menu``: behind a swatch.
- ``view``, ``rows``, ``row_parts``, ``model``: the list for Qt.  ``entries``: what its rows show.
  ``dragging``, ``dropping``: of rows.
"""
