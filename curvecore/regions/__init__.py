"""Regions of the plane that cubic Bezier pieces enclose, and their boolean operations.

- ``region``: `Region`, contours with the rule that says what is inside.
- ``operations``: `union`, `intersection`, `difference`, `exclusion`, `division`, `simplified`.
- ``strokes``: outlines of strokes, larger and smaller regions.  ``strips``: their sides.
  ``miters``: tips of their corners.  ``dashes``: stretches of a pattern along lines.
  ``cutting``: lines cut where others cross them.
- ``outlines``: the pieces of many regions in one array.  ``meetings``: where these cross, touch or coincide.
- ``arrangement``: nodes, and edges between them, those that coincide as one.
- ``rays``: winding numbers beside edges and at points.
- ``assembly``: contours of chosen edges.  ``nesting``: holes and what is around them.
"""
