"""Points of a curve: their kinds, corners and smooth ones, straight segments between them, more and fewer.

- ``point_kinds``: the kinds of points.  ``point_columns``: the columns of the point table.
- ``smoothness``, ``straight``: smooth points and corners, straight segments, handles retracted.
- ``appending``: points appended, curves closed, and the curve as it would be with a point more.
- ``midpoints``: a point more in the middle of segments.
- ``deleting``: points deleted with the shape kept.
"""
