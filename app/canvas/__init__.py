"""The canvas: the curve, its points and handles, drawn and grabbed.

- ``canvas``: the widget.
- ``curve_layer``, ``point_layer``, ``grid_layer``, ``other_curves_layer``, ``corner_layer``: what it draws.
- ``hit_test``: what lies under the pointer.
"""
