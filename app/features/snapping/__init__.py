"""Snapping, and the rulers and guides that it serves.

- ``commands``: the actions.  ``guide_field``: the field on the canvas for the position of a guide.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
