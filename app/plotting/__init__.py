"""What the canvas and the basis panel share.

- ``pixel_map``: plane to pixels and back.
- ``drawing``: polylines, discs and text drawn fast; nothing unsafe reaches Qt.
- ``pens``, ``dashes``, ``area``: looks on the screen, dashes that run on, translucent areas.
- ``layered_plot``: a pyqtgraph plot with our own painting: layers, ranges.  ``plot_widget``: mouse and keys
  on it.  ``panning``: the drawing follows the mouse.  ``scrolling``: the wheel and the trackpad.
- ``plates``: words on little plates of paper.  ``halo``: words with paper around their letters only.
  ``fonts``: a font in the sizes that are needed.
- ``stamps``, ``colours``: many marks in one call, in the colours of the points.
"""
