"""Analysis of a curve: overlays, plots and tables as arrays to draw and words.

- ``settings``: the overlays, plots and ghosts that are switched on; no part of the document.
- ``overlay``, ``overlays``: the record of an overlay; one file for each or two.
  ``overlay_settings``: the numbers that they are drawn with.
  ``picture``: the figures of those that are switched on, live or once things have settled.
- ``figures``: lines, arrows, marks and areas of the plane, each in a style that has a meaning.
- ``scene``: the curve with all that overlays share, such as samples of its derivatives.
  ``errors``: errors of points and parameters.
- ``ghost``, ``ghosts``: the same points under other rules: a list, and their curves.
- ``plot``, ``plots``: the record of a plot over t; a file for one or more.
  ``plotted``: those that are switched on.  ``plot_lines``, ``plot_samples``: their data and samples.
- ``hodograph``: c' and c'' in the plane.
- ``joints``: the smoothness of the curve at each joint, in numbers and words.
- ``legend``: lines of explanation.  ``wording``: numbers in sentences.
- ``laboratory_settings``, ``laboratory``: the curve computed with few digits, by several methods.
- ``laboratory_words``: its findings, in a sentence.
- ``cost``: solving a system against the basis form, counted and measured.
- ``wiggle``, ``cures``: a swing of the curve explained, and ways to calm it.
- ``teaching``: warnings about the numbers of a curve.
- ``goals``: the goals of lessons, measured on the curve.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
