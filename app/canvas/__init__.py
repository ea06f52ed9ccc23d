"""The canvas: the curve, its points and handles, drawn and grabbed.

- ``canvas``: the widget, which has the tools, and stays where it is in another size.  ``scene``: its layers.
  ``fitting``: what part of the plane is shown.
- ``curve_layer``, ``point_layer``, ``point_density``, ``point_ink``, ``point_marks``,
  ``control_polygon_layer``: the curve that is edited.
- ``drawn_curves``: all curves from the back to the front.  ``looks``: how they look.
  ``shape_painting``: shapes in their styles, with fills, ends and dashes.
- ``other_curves_layer``, ``selected_curves_layer``: the other curves, and those that the file holds; those
  that are selected.  ``other_points_layer``: selected points of those that are edited with the active one.
- ``grid_layer``, ``unit_layer``, ``guides_layer``: grid, unit and guides.
- ``image_layer``, ``image_file``: a picture to trace: drawn, dark on dark paper, and read.
- ``annotations``: what explains the curve.  ``figure_layer``, ``trace_layer``: overlays and ghosts; other
  versions of the curve.  ``legend``: what they mean.
- ``motion_layer``: dots that run, their trails and arrows.
- ``marks_layer``: what a gesture shows over it: rubber band, box with grips, what was snapped to, a ruler.
- ``label_place``: where words beside a point cover least, and where its number stands.
- ``pen_layer``: the curve that the pen would make before it is pressed.
- ``hit_test``, ``line_finder``: what lies under the pointer; ``filled_areas``: insides of shapes.
- ``handle_marks``: handles, of sizes told apart.  ``point_marks``: points, by their kinds;
  ``point_stamps``: in their colours, or plain.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
