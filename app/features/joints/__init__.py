"""The joint certificate: how smooth the curve is where two segments meet.

- ``commands``: keeps it in step with the curve.  ``panel``: the table of joints.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
