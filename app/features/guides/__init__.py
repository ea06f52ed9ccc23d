"""Rulers along the canvas, and guides drawn out of them.

- ``commands``: the actions.  ``field``: the field on the canvas into which the place of a guide is typed.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
