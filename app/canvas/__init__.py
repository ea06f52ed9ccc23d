"""The canvas: the curve, its points and handles, drawn and grabbed.

- ``canvas``: the widget.
- ``curve_layer``, ``point_layer``, ``grid_layer``: what it draws.
- ``other_curves_layer``, ``corner_layer``: the curves that are not edited, and the marks of corners.
- ``hit_test``: what lies under the pointer.
"""
