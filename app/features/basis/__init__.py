"""Basis functions over t, and the t-rail below them.

- ``commands``: the pane, connected to the session; actions of the t-rail.
- ``pane``: the plot with its header.  ``panel``: the plot, its hit test, and a t typed at its tick.
- ``scene``: functions, t-rail and scrub line, painted.  ``function_lines``: functions in pixels, and a
  number at each crest.
"""
