"""Plots over t, over the axis of the basis functions.

- ``commands``: switches them, and keeps them in step with curve, scrub line and the visible part of t.
- ``panel``: their place in the window.  ``pane``: the plots with their header, made when one is wanted.
- ``canvas``: the plots below each other.  ``layers``: what is painted.  ``value_scale``: values to heights.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
