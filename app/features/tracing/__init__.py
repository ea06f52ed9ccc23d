"""Pictures traced: outlines of what is dark in them, as shapes.

- ``commands``: the action.  ``field``: the field on the canvas for what counts as dark.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
