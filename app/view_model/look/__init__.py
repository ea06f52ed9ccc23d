"""The look of lines and marks, and the colours of papers, curves and points.

- ``line_styles``: one vocabulary for figures, ghosts, plots and their legends.
- ``palette``: colours of papers, of curves on them and of points.
"""
