"""Curves as a whole, their segments, shapes and groups.

- ``commands``: new, insert points, split, reverse, close, delete segments.
- ``join_commands``: join and merge ends.
- ``arrange_commands``: order in front and behind, Combine and Break Apart, Group and Ungroup.
"""
