"""Shapes and groups: curves combined, with holes, and taken apart; grouped and ungrouped.

- ``commands``: combining and grouping.
- ``simplify_commands``: the same with fewer points.
- ``chosen_shapes``: the shapes that actions mean.
"""
