"""Plots that the program paints itself: shared by the canvas, the basis panel and the plots over t.

A plot is a `ToolPlot` with layers. To paint something new, write a subclass of ``layers.Layer`` whose
``paint(painter, shown)`` draws arrays with the functions of ``drawing``; its z orders the layers.

- ``graphs``: the part of pyqtgraph that is used.  ``plot_widget``: a plot of layers, with mouse and keys.
  ``tool_plot``: a plot with tools.  ``layers``: what is painted on it.
- ``pixel_map``: from the plane to pixels and back.  ``camera``: the visible part of the plane.
  ``scrolling``: panning, wheel, trackpad, and a drag at the edge of the view.
- ``axes``, ``ticks``: axes with rulers, and the positions of their numbers.
- ``drawing``: polylines, segments and areas, straight from arrays.  ``wide_line``: an opaque line, drawn
  without Qt's stroker.  ``pens``: line styles on the screen, with dashes.
- ``stamps``: pictures that are painted once and copied.  ``text``: fonts, plates, letters with a halo.
"""
