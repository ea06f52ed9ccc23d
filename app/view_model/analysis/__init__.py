"""Why the curve goes where it goes: what the overlays, plots and tables show, as arrays to draw.

- ``settings``: what is switched on and how; no part of the document.
- ``figures``: lines, arrows, marks and areas of the plane, each in a style that has a meaning.
- ``overlays``: the figures of everything that is switched on.
- ``samples``: the curve and its derivatives at parameters that suit drawing.
- ``comb``: the curvature comb.
- ``plot_lines``, ``plot_samples``, ``plots``: plots over t; ``hodograph``: c' and c'' in the plane.
- ``joints``: how smooth the curve is at each joint, in numbers and words.
"""
