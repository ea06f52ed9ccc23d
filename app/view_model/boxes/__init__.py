"""Boxes around points and curves, and what is moved or stretched by them.

- ``bounds``: the box of points or curves.  ``shape_boxes``: the box of a whole shape.
- ``stretch``: what fills another box.  ``alignment``: curves aligned by theirs.
- ``pivot``: the place that transforms are about, and what they did.
- ``copies``: copies in a circle, a row, or rows and columns.
- ``exact_boxes``: exact boxes of many curves at once.
- ``last_transform``: the last transform, read off what a step did to points.
- ``resizing``: points and curves given a width, a height or both.
"""
