"""Why the curve goes where it goes: what the overlays, plots and tables show, as arrays to draw.

- ``settings``: what is switched on and how; no part of the document.
- ``figures``: lines, arrows, marks and areas of the plane, each in a style that has a meaning.
- ``overlays``: the figures of everything that is switched on.
- ``samples``: the curve and its derivatives at parameters that suit drawing.
- ``comb``: the curvature comb.
- ``laboratory_settings``, ``laboratory``: the curve computed with few digits, by several methods.
- ``cost``: what solving a system costs against the basis form, counted and measured.
- ``wiggle``, ``cures``: why the curve swings out at one t, and what would calm it.
- ``teaching``: when the numbers deserve a word of warning.
"""
