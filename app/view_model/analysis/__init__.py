"""Analysis of a curve: overlays, plots and tables as arrays to draw and words.

- ``settings``: the overlays, plots, ghosts and experiments that are switched on; no part of the document.
- ``overlay``, ``overlays``: the record of an overlay, with all it is made of; one file for each or two.
  ``picture``: the figures of those that are switched on, live or once things have settled.
- ``ghost``, ``ghost_views``: the same points under other rules: a list, and their curves.
- ``legend``: lines of explanation on the canvas.
- ``plot``, ``plots``: the record of a plot over t, and its data; a file for one or more.
  ``plot_samples``: the plots that are switched on, computed.
- ``hodograph``: c' and c'' in the plane.
- ``joints``: the smoothness of the curve at each joint, in numbers and words.
- ``laboratory``: the curve computed with few digits, by several methods, and the cost of solving a system.
- ``wiggle``: a swing of the curve explained, and ways to calm it.
- ``warnings``: warnings about the numbers of a curve.
- ``goals``: the goals of lessons, measured on the curve.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
