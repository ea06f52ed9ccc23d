"""Shapes and groups: curves combined, with holes, and taken apart; grouped and ungrouped; boolean operations.

- ``commands``: combining and grouping.  ``path_commands``: union, difference and the like.
- ``chosen_shapes``: the shapes that actions mean.
"""
