"""Whole curves: new, join, split, reverse, close, name and order.

- ``commands``: the actions; ``join_commands``: those that make one curve of several.
  ``segment_commands``: segments deleted.
"""
