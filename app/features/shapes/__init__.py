"""Shapes and groups: curves combined, with holes, and taken apart; grouped and ungrouped; boolean operations.

- ``commands``: combining and grouping.  ``path_commands``: union, difference and the like.
- ``clip_commands``: shapes cut by others.  ``clip_editing``: what cuts them, while it is edited.
- ``simplify_commands``: the same with fewer points.
- ``shape_work``: what is made of chosen shapes, at once or beside the window.
- ``offset_commands``: larger and smaller shapes.
- ``field``: the field on the canvas for the distance.  ``distances``: these as people type them.
- ``chosen_shapes``: the shapes that actions mean.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
