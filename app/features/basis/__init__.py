"""Basis functions over t, and the t-rail at their foot.

- ``commands``: the pane, connected to the session; actions of the t-rail.
- ``pane``: the functions with their header.  ``panel``: the gestures on them.  ``hits``: what lies under the
  pointer.  ``tick_edit``: a t typed at its tick.
- ``scene``: what is drawn.  ``layers``: functions, t-rail and scrub line, painted.
  ``function_lines``: functions in pixels.  ``crest_names``: a number at each crest.
"""
