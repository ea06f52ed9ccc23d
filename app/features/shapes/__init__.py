"""Shapes and groups: curves combined, with holes, and taken apart; grouped and ungrouped.

- ``commands``: combining and grouping.
- ``clip_commands``: shapes cut by others.  ``clip_editing``: what cuts them, while it is edited.
- ``simplify_commands``: the same with fewer points.
- ``shape_work``: what is made of chosen shapes, at once or beside the window.
- ``chosen_shapes``: the shapes that actions mean.
"""
