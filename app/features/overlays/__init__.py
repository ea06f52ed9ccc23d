"""Overlays and ghosts: figures over the curve that explain its shape.

- ``commands``: switches them, and keeps the figures on the canvas in step with the curve.
- ``panel``: the Analysis dock, with a switch for each, its settings and its notes.

The overlays themselves are records: ``app/view_model/analysis/overlays``.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
