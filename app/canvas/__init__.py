"""The canvas: the curve, its points and handles, drawn and grabbed.

Everything that is painted is a `Layer` of the scene; the file of a layer holds all about painting it.
To add a layer: write a file with a class of ``plotting.layers.Layer``, and create and render it in ``scene``.

- ``canvas``: the widget, with the tools.  ``scene``: its layers.  ``fitting``: the visible part of the plane.
- ``hit_test``: the point, handle, curve or filled area under the pointer.
- ``curve_layer``: the active curve, its control polygon and the preview of the pen.  ``point_layer``: its
  points and handles.
- ``other_curves_layer``, ``other_points_layer``: the other curves of the document; selected points of those
  that are edited together with the active one.
- ``point_marks``: marks of points by kind and colour, and how dense points are drawn.  ``handle_marks``:
  handles of different sizes.
- ``shape_painting``: shapes in their styles, with fills, ends and dashes.
- ``grid_layer``: grid, unit and guides.  ``image_layer``: the picture to trace.
- ``figure_layer``: figures, ghosts and other versions of the curve.  ``legend``: their explanation.
- ``marks_layer``: marks of a gesture: rubber band, box with grips, snap targets, ruler.
- ``motion_layer``: moving dots with trails and arrows.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
