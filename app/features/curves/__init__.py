"""Whole curves: new, join, split, reverse, close, name and order.

- ``commands``: the actions; ``join_commands``: those that make one curve of several.
  ``order_commands``: what lies in front of what.
  ``segment_commands``: segments deleted.
"""
