"""The canvas: the curve, its points and handles, drawn and grabbed.

- ``canvas_view``: what is shown.  ``canvas``: the widget, with the gestures on it.
- ``curve_layer``, ``point_layer``, ``grid_layer``, ``unit_layer``, ``image_layer``: what it draws.
- ``image_file``: reads a picture to trace.
- ``overlay_layer``: what a gesture shows over it: rubber band, box with grips, what was snapped to, a ruler.
- ``keys``: what keys mean, and the shapes of the pointer.
- ``other_curves_layer``, ``corner_layer``: the curves that are not edited, and the marks of corners.
- ``motion_layer``: dots that run, their trails and arrows.
- ``hit_test``: what lies under the pointer.
"""
