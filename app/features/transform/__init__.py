"""Transforms of points and curves: move, scale, rotate, mirror, align, distribute.

- ``commands``: the actions.  ``align_commands``: those that align and distribute.
- ``panel``: the same in numbers.  ``panel_commands``: keeps it in step.  ``pivot_chooser``: nine places.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
