"""The same curve by other data: exactly, or as near as can be.

- ``reshape``: other points for the same curve.
- ``convert``: the same curve as one of another family.
- ``least_squares``: curves of few points near many.
- ``segment_fit``: one segment for several.
- ``simplifying``: the points that the shape does not need left out.
- ``cubics``, ``cubic_joints``: cubic pieces as the points of a curve.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
