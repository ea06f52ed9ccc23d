"""Features: one package for each capability, with its commands and its panel. None imports another.

- ``point_table``: the points as numbers.  ``curve_list``: the curves.  ``curve_settings``: the active one in
  numbers and rules.  ``history``: undo, as a list.  ``reference_image``: the picture to trace.
- ``overlays``: what is drawn over the curve, and its ghosts.
- ``recovery``: backups of unsaved work, and what a crash left behind.
- ``file_on_disk``: the document's file while it is open: changed, gone, or open elsewhere.
"""
