"""The plane, without curves of a document: vectors, boxes of strokes, samples and lengths.

- ``plane``, ``sampling``: vectors of the plane; parameters all along a curve.
- ``arc_lengths``: lengths to a relative accuracy.
- ``fills``: insides of outlines.  ``stroked``: the box around a stroked line.
- ``extents``: of cubic pieces.
"""
