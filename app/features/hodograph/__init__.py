"""The hodograph: a derivative of the curve, drawn as a curve.

- ``commands``: keeps it in step with the curve.  ``panel``: the plot, with buttons for the order.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
