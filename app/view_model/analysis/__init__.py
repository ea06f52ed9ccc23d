"""Analysis of a curve: overlays, plots and tables as arrays to draw and words.

- ``settings``: what is switched on and how; no part of the document.
- ``overlay``, ``overlays``: what can be drawn over the curve: the record, and one file for each or two.
  ``picture``: the figures of those that are switched on, live or once things have settled.
- ``figures``: lines, arrows, marks and areas of the plane, each in a style that has a meaning.
- ``scene``, ``samples``: the curve with what overlays share; its derivatives where a drawing needs them.
  ``errors``: errors of points and parameters.
- ``ghost``, ``ghosts``: the same points under other rules: which there are, and their curves.
- ``plot``, ``plots``: what can be plotted over t: the record, and a file for one or more.
  ``plotted``: those that are switched on.  ``plot_lines``, ``plot_samples``: their data, and at which t.
- ``hodograph``: c' and c'' in the plane.
- ``joints``: how smooth the curve is at each joint, in numbers and words.
- ``legend``: which of all this needs a line of explanation.  ``wording``: numbers in sentences.
- ``laboratory_settings``, ``laboratory``: the curve computed with few digits, by several methods.
- ``laboratory_words``: what of that is to be seen, in a sentence.
- ``cost``: what solving a system costs against the basis form, counted and measured.
- ``wiggle``, ``cures``: why the curve swings out at one t, and what would calm it.
- ``teaching``: when the numbers deserve a word of warning.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
