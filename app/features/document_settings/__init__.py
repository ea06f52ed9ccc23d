"""Settings of a document as a whole: its unit and its grid, and those that a new one begins with.

- ``commands``: the panel in the window; unit and grid on the canvas.
- ``panel``: the form.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
