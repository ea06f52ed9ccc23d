"""The canvas: the curve, its points and handles, drawn and grabbed.

- ``canvas``: the widget.
- ``curve_layer``, ``point_layer``, ``grid_layer``, ``unit_layer``, ``image_layer``: what it draws.
- ``image_file``: reads a picture to trace.
- ``hit_test``: what lies under the pointer.
"""
