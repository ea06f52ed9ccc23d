"""Keys and mouse, and what this program is.

- ``commands``: the Help menu.  ``shortcut_sheet``: all keys and gestures on one sheet over the window.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
