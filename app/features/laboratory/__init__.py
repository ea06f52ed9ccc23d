"""Stability laboratory: the same curve computed with few digits, by several methods.

- ``commands``: trials beside the window, and their results on the canvas and in plots.
- ``panel``: the controls, with the ``tables`` of errors and digits and the page on ``cost``.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
