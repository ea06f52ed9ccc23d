"""Plots that are painted by us: shared by the canvas, the basis panel and the plots over t.

- ``pixel_map``: plane to pixels and back.
- ``drawing``: polylines drawn fast; nothing unsafe reaches Qt.  ``segments``: many shapes in one call.
  ``crowds``: strokes that fill an area.  ``wide_line``: an opaque line, drawn without Qt's stroker.
- ``pens``, ``area``: line styles on the screen, with dashes that run on; translucent areas.
- ``rings``: areas cut to what is seen.
- ``graphs``: pyqtgraph itself.  ``painted_plot``: a plot of it that we paint.  ``plot_widget``: one with
  mouse and keys.  ``tool_plot``: one with tools.
- ``layers``: what is painted.  ``camera``: which part of the plane is seen, and its ranges.
  ``axes``, ``ticks``: the axes beside it, and where their numbers stand.  ``rulers``: marks on them.
- ``panning``: the drawing follows the mouse.  ``scrolling``: the wheel and the trackpad.  ``edge_scroll``: a
  drag at the edge.
- ``plates``: words on little plates of paper.  ``halo``: words with paper around their letters only.
  ``fonts``: a font in the sizes that are needed.
- ``stamps``: many marks in one call, in the colours of the points.  ``sprites``: a few marks of any looks.
  ``pictures``: what is painted beside the screen and kept.
"""
