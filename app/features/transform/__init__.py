"""Transforms of points and curves: move, scale, rotate, mirror, align, distribute.

- ``commands``: the actions.  ``align_commands``: Align and Distribute.
- ``panel``: transforms in numbers, and the pivot.  ``panel_commands``: the panel in the window.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
