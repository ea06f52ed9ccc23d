"""Plots over t, over the axis of the basis functions.

- ``commands``: switches them, and keeps them in step with curve, scrub line and the visible part of t.
- ``pane``: the plots below each other with their header, made when one is needed.
- ``layers``: what is painted, and values to heights.

The plots themselves are records: ``app/view_model/analysis/plots``.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
